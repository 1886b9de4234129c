// SPDX-License-Identifier: MPL-2.0
// The solvent-excluded surface of Mol*, for peers.py:
//
//     NODE_PATH=FOLDER/node_modules node molstar.cjs BALLS.xyzr VOXEL PROBE POINTS TRIANGLES
//
// after `npm install molstar` in FOLDER. POINTS gets three floats a vertex, TRIANGLES three 32-bit indices a triangle.
'use strict';
const fs = require('fs');
const {calcMolecularSurface} = require('molstar/lib/commonjs/mol-math/geometry/molecular-surface.js');
const {getBoundary} = require('molstar/lib/commonjs/mol-math/geometry/boundary.js');
const {computeMarchingCubesMesh} = require('molstar/lib/commonjs/mol-geo/util/marching-cubes/algorithm.js');
const {Mesh} = require('molstar/lib/commonjs/mol-geo/geometry/mesh/mesh.js');
const {OrderedSet} = require('molstar/lib/commonjs/mol-data/int.js');
const {SyncRuntimeContext} = require('molstar/lib/commonjs/mol-task/execution/synchronous.js');

async function main(path, voxel, probe, points, triangles) {
    const rows = fs.readFileSync(path, 'utf8').split('\n').map(line => line.split('#')[0].trim().split(/\s+/))
                     .filter(words => words.length >= 4).map(words => words.slice(-4).map(Number));
    const column = k => Float32Array.from(rows, row => row[k]);
    const indices = OrderedSet.ofBounds(0, rows.length);
    const balls = {x: column(0), y: column(1), z: column(2), radius: column(3), indices, id: Int32Array.from(rows.keys())};
    const boundary = getBoundary(balls);
    const largest = balls.radius.reduce((a, b) => Math.max(a, b));
    const swollen = {...balls, radius: balls.radius.map(r => r + probe)};
    const props = {probeRadius: probe, resolution: voxel, probePositions: 36};
    const {field, idField, transform} =
        await calcMolecularSurface(SyncRuntimeContext, swollen, boundary, largest, boundary.box, props);
    const mesh = await computeMarchingCubesMesh({isoLevel: probe, scalarField: field, idField}).run();
    Mesh.transform(mesh, transform);
    fs.writeFileSync(points, mesh.vertexBuffer.ref.value.subarray(0, 3 * mesh.vertexCount));
    fs.writeFileSync(triangles, mesh.indexBuffer.ref.value.subarray(0, 3 * mesh.triangleCount));
}

const [path, voxel, probe, points, triangles] = process.argv.slice(2);
main(path, Number(voxel), Number(probe), points, triangles);
