// SPDX-License-Identifier: MPL-2.0
// The viewer of a .html file: unpacks the mesh that stands in the page, and shows it. build.sh makes
// viewer.min.js of this file and the parts of three.js that it uses.

import {
  AmbientLight, BackSide, BufferAttribute, BufferGeometry, Color, DataTexture, DirectionalLight, DoubleSide, DynamicDrawUsage,
  FrontSide, Frustum, Group, InstancedMesh, LinearFilter, Matrix4, Mesh, MeshStandardMaterial, PerspectiveCamera, Plane,
  Quaternion, Raycaster, SRGBColorSpace, Scene, ShaderMaterial, Sphere, Vector2, Vector3, WebGLRenderer,
} from 'three';
import { TrackballControls } from 'three/examples/jsm/controls/TrackballControls.js';

const byId = (id) => document.getElementById(id);

// ---- the mesh -------------------------------------------------------------------------------

// The bytes of the page's data: base64 of a zlib stream.
async function unpackBytes(base64) {
  const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// An array: component by component, byte by byte of all elements, each the difference from the
// element before.
function unpackArray(bytes, { offset, count, components, width }) {
  const Type = { 1: Uint8Array, 2: Uint16Array, 4: Uint32Array }[width];
  const out = new Type(count * components);
  for (let c = 0; c < components; ++c) {
    const start = offset + c * width * count;
    for (let i = 0, last = 0; i < count; ++i) {
      for (let w = 0; w < width; ++w) last += bytes[start + w * count + i] << (8 * w);
      out[i * components + c] = last; // modulo 2^(8 width)
      last = out[i * components + c];
    }
  }
  return out;
}

// A geometry with what choosing and painting it need.
// positions: three floats a vertex; source: for each vertex its place in the arrays of `level`
function makeShape(level, positions, index, source) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.computeVertexNormals();
  geometry.computeBoundingSphere();
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(positions.length).fill(1), 3));
  const at = (corner, c) => positions[3 * index[corner] + c];
  let edges = 0;
  for (let i = 0; i < index.length; ++i) {
    const next = i % 3 === 2 ? i - 2 : i + 1;
    edges += Math.hypot(at(i, 0) - at(next, 0), at(i, 1) - at(next, 1), at(i, 2) - at(next, 2));
  }
  return { level, geometry, source, triangles: index.length / 3, edge: edges / Math.max(1, index.length) };
}

// The shape of a part of a level of the file.
function unpackShape({ level, step, middle, parts }, part, arrays) {
  const [firstVertex, vertexEnd, firstTriangle, triangleEnd] = parts[part];
  const quantized = arrays[`position${level}`];
  const positions = new Float32Array(3 * (vertexEnd - firstVertex));
  for (let i = 0; i < positions.length; ++i)
    positions[i] = (quantized[3 * firstVertex + i] - 32767.5) * step + middle[i % 3];
  const index = arrays[`index${level}`].slice(3 * firstTriangle, 3 * triangleEnd).map((v) => v - firstVertex);
  const source = Uint32Array.from({ length: vertexEnd - firstVertex }, (_, i) => firstVertex + i);
  return makeShape(level, positions, index, source);
}

// Six times the volume inside triangles, about a point near them.
function volumeOf(positions, index, origin) {
  const at = (corner, c) => positions[3 * index[corner] + c] - origin[c];
  let sum = 0;
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [0, 1, 2].map((k) => [at(i + k, 0), at(i + k, 1), at(i + k, 2)]);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
      a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

// A coarser shape: the vertices in each cubic cell become one, their mean; then it is blown up to
// the volume that it had.
function clustered(shape, cell) {
  const from = shape.geometry.attributes.position.array;
  const cells = new Map();
  const sums = [], counts = [], source = [];
  const cellOf = new Uint32Array(from.length / 3);
  for (let v = 0; v < cellOf.length; ++v) {
    const key = [0, 1, 2].map((c) => Math.floor(from[3 * v + c] / cell)).join();
    if (!cells.has(key)) {
      cells.set(key, cells.size);
      sums.push(0, 0, 0);
      counts.push(0);
      source.push(shape.source[v]);
    }
    const n = cellOf[v] = cells.get(key);
    for (let c = 0; c < 3; ++c) sums[3 * n + c] += from[3 * v + c];
    ++counts[n];
  }
  const index = [];
  const corners = shape.geometry.index.array;
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [cellOf[corners[i]], cellOf[corners[i + 1]], cellOf[corners[i + 2]]];
    if (a !== b && b !== c && c !== a) index.push(a, b, c);
  }
  const positions = Float32Array.from(sums, (sum, i) => sum / counts[Math.floor(i / 3)]);
  const middle = shape.geometry.boundingSphere.center.toArray();
  const grown = Math.cbrt(volumeOf(from, corners, middle) / volumeOf(positions, index, middle));
  const scale = grown > 1 ? Math.min(grown, 1.5) : 1;
  positions.forEach((x, i) => { positions[i] = middle[i % 3] + scale * (x - middle[i % 3]); });
  return makeShape(shape.level, positions, Uint32Array.from(index), source);
}

// Adds to the shapes of a part, from fine to coarse, what is still coarser: for turning without a graphics card.
function coarsen(shapes, fewTriangles) {
  for (let cell = 2 * shapes[shapes.length - 1].edge; ; cell *= 1.2) {
    const last = shapes[shapes.length - 1];
    if (last.triangles <= fewTriangles) return;
    const next = clustered(last, cell);
    if (next.triangles === 0) return;
    if (next.triangles < 0.7 * last.triangles) shapes.push(next);
  }
}

// ---- colours --------------------------------------------------------------------------------

// Linear light of [red, green, blue], 0 to 255 in sRGB.
function light([r, g, b]) {
  const color = new Color().setRGB(r / 255, g / 255, b / 255, SRGBColorSpace);
  return [color.r, color.g, color.b];
}

// 256 colours of a scale.
function ramp(stops) {
  const out = [];
  for (let i = 0; i < 256; ++i) {
    const place = (i / 255) * (stops.length - 1);
    const k = Math.min(Math.floor(place), stops.length - 2);
    const mix = stops[k].map((v, c) => v + (place - k) * (stops[k + 1][c] - v));
    out.push(light(mix));
  }
  return out;
}

function paint({ level, geometry, source }, mode, arrays) {
  const to = geometry.attributes.color.array;
  const values = arrays[mode.array + level];
  let colorOf;
  if (mode.kind === 'scale') {
    const table = ramp(mode.stops);
    if (mode.missing) table[255] = light(mode.missing); // of vertices without a value
    colorOf = (i) => table[values[i]];
  } else if (mode.kind === 'names') {
    const table = mode.entries.map((entry) => light(entry.color));
    colorOf = (i) => table[values[i]];
  } else if (mode.kind === 'colors') {
    colorOf = (i) => light(values.subarray(3 * i, 3 * i + 3));
  } else {
    const plain = mode.kind === 'plain' ? light(mode.color) : [1, 1, 1];
    colorOf = () => plain;
  }
  source.forEach((from, i) => to.set(colorOf(from), 3 * i));
  geometry.attributes.color.needsUpdate = true;
}

const css = ([r, g, b]) => `rgb(${r},${g},${b})`;

// modes: what layers show alike; bodies: entries of what is inside
function showLegend(modes, bodies) {
  const [mode] = modes;
  const legend = byId('legend');
  legend.replaceChildren();
  const heading = (text) => {
    const line = document.createElement('h2');
    line.textContent = text;
    legend.append(line);
  };
  const titled = modes.find(({ kind, entries }) => kind === 'scale' || entries);
  if (titled) heading(titled.title);
  if (mode.kind === 'scale') {
    const bar = document.createElement('div');
    bar.className = 'bar';
    bar.style.background = `linear-gradient(to right, ${mode.stops.map(css).join(', ')})`;
    const ends = document.createElement('div');
    ends.className = 'ends';
    for (const value of [mode.low, (mode.low + mode.high) / 2, mode.high]) {
      const label = document.createElement('span');
      label.textContent = number(value, 2);
      ends.append(label);
    }
    const unit = document.createElement('div');
    unit.className = 'unit';
    unit.textContent = mode.unit;
    legend.append(bar, ends, unit);
  }
  const rows = new Map(); // each name and colour once
  for (const { entries, missing } of modes)
    for (const entry of entries ?? (missing ? [{ name: 'no value', color: missing }] : []))
      if (entry.seen !== false) rows.set([entry.name, ...entry.color].join(), entry);
  const add = (entry) => {
    const row = document.createElement('div');
    row.className = 'entry';
    const patch = document.createElement('i');
    patch.style.background = css(entry.color);
    row.append(patch, entry.name);
    legend.append(row);
  };
  rows.forEach(add);
  for (const title of new Set(bodies.map((entry) => entry.title))) {
    heading(title);
    const own = bodies.filter((entry) => entry.title === title);
    new Map(own.map((entry) => [[entry.name, ...entry.color].join(), entry])).forEach(add);
  }
}

// ---- the atoms ------------------------------------------------------------------------------

const marked = light([255, 214, 10]); // the residue that is chosen

const number = (value, digits) => value.toFixed(digits).replace('-', '\u2212');

// What the vertices belong to: the atoms and residues of the finest level, with their areas [Å²].
class Owners {
  constructor({ residues, atoms }, arrays, shapes) {
    this.residues = residues.map(([chain, name, place]) => ({ chain, name, place, area: 0 }));
    this.atoms = atoms.map(([residue, name]) => ({ residue: this.residues[residue], name, area: 0 }));
    this.of = arrays.ball;
    for (const { geometry, source } of shapes) {
      const at = geometry.attributes.position.array, index = geometry.index.array;
      const side = (i, j) => [0, 1, 2].map((c) => at[3 * j + c] - at[3 * i + c]);
      for (let t = 0; t < index.length; t += 3) {
        const [a, b, c] = index.subarray(t, t + 3);
        const u = side(a, b), v = side(a, c);
        const area = Math.hypot(u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]) / 2;
        for (const corner of [a, b, c]) {
          const atom = this.atoms[this.of[source[corner]]];
          atom.area += area / 3;
          atom.residue.area += area / 3;
        }
      }
    }
  }

  nameOf({ chain, name, place }) {
    return `${chain} ${name} ${place}`;
  }

  // The residue of a name, if it has one.
  find(name) {
    return this.residues.find((residue) => this.nameOf(residue) === name);
  }

  // Paints the vertices of a residue.
  mark({ geometry, source }, residue) {
    const to = geometry.attributes.color.array;
    source.forEach((from, i) => {
      if (this.atoms[this.of[from]].residue !== residue) return;
      for (let c = 0; c < 3; ++c) to[3 * i + c] = 0.25 * to[3 * i + c] + 0.75 * marked[c];
    });
    geometry.attributes.color.needsUpdate = true;
  }
}

// What a legend says of a vertex.
function valueText(mode, vertex, arrays) {
  const value = arrays[mode.array]?.[vertex];
  if (mode.kind === 'names') return mode.entries[value].name;
  if (mode.kind !== 'scale') return '';
  if (mode.missing && value === 255) return 'no value';
  const low = mode.low, high = mode.high;
  const digits = Math.max(0, 2 - Math.floor(Math.log10(high - low)));
  return `${number(low + ((high - low) * value) / (mode.missing ? 254 : 255), digits)} ${mode.unit}`;
}

// ---- the copies -----------------------------------------------------------------------------

const ambient = 0.9, direct = 2.4, lampPlace = [-0.5, 0.8, 1]; // over the eye's shoulder

// For turning without a graphics card: light at vertices, and nothing to be done for a pixel.
const quickShader = {
  vertexColors: true,
  clipping: true,
  uniforms: { opacity: { value: 1 } },
  vertexShader: `varying vec3 shade;
    #include <clipping_planes_pars_vertex>
    void main() {
      vec4 place = vec4(position, 1.0);
      vec3 outward = normal, light = color;
      #ifdef USE_INSTANCING
        place = instanceMatrix * place;
        outward = mat3(instanceMatrix) * outward;
      #endif
      #ifdef USE_INSTANCING_COLOR
        light *= instanceColor;
      #endif
      vec4 mvPosition = modelViewMatrix * place;
      #include <clipping_planes_vertex>
      outward = normalize(normalMatrix * outward);
      if (dot(outward, mvPosition.xyz) > 0.0) outward = -outward; // a wall that is seen from behind
      float lamp = max(0.0, dot(outward, normalize(vec3(${lampPlace}))));
      light *= (${ambient} + ${direct} * lamp) / ${Math.PI};
      shade = 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055; // sRGB
      gl_Position = projectionMatrix * mvPosition;
    }`,
  fragmentShader: `varying vec3 shade;
    uniform float opacity;
    #include <clipping_planes_pars_fragment>
    void main() {
      #include <clipping_planes_fragment>
      gl_FragColor = vec4(shade, opacity);
    }`,
};

// Copies as one mesh, each by a shape of its part. Its triangles can be put in order, since light that
// goes through several walls has to go through the farthest first.
class Joined {
  constructor(list, shapeOf) {
    this.pieces = list.map(({ part, matrix, color }) => ({ shape: shapeOf(part), matrix, color }));
    const sum = (count) => this.pieces.reduce((all, { shape }) => all + count(shape.geometry), 0);
    const positions = new Float32Array(3 * sum(({ attributes }) => attributes.position.count));
    this.corners = new Uint32Array(sum(({ index }) => index.count));
    const corner = new Vector3();
    let vertices = 0, corners = 0;
    for (const { shape: { geometry }, matrix } of this.pieces) {
      for (const v of geometry.index.array) this.corners[corners++] = vertices + v;
      for (let v = 0; v < geometry.attributes.position.count; ++v)
        corner.fromBufferAttribute(geometry.attributes.position, v).applyMatrix4(matrix).toArray(positions, 3 * vertices++);
    }
    this.mesh = new Mesh(makeShape('', positions, this.corners.slice(), []).geometry);
  }

  paint(colored) {
    const to = this.mesh.geometry.attributes.color;
    let at = 0;
    for (const { shape, color } of this.pieces) {
      const own = colored ? color.toArray() : [1, 1, 1];
      shape.geometry.attributes.color.array.forEach((value, i) => { to.array[at++] = value * own[i % 3]; });
    }
    to.needsUpdate = true;
  }

  // Puts the triangles in order along a direction, as their middles lie, by counting.
  sort([x, y, z]) {
    const at = this.mesh.geometry.attributes.position.array, { corners } = this, count = corners.length / 3;
    const along = new Float32Array(at.length / 3);
    for (let v = 0; v < along.length; ++v) along[v] = x * at[3 * v] + y * at[3 * v + 1] + z * at[3 * v + 2];
    const sums = new Float32Array(count), places = new Uint16Array(count), ends = new Uint32Array(65537);
    let low = Infinity, high = -Infinity;
    for (let t = 0; t < count; ++t) {
      const sum = sums[t] = along[corners[3 * t]] + along[corners[3 * t + 1]] + along[corners[3 * t + 2]];
      if (sum < low) low = sum;
      if (sum > high) high = sum;
    }
    const scale = 65535 / (high - low || 1);
    for (let t = 0; t < count; ++t) {
      places[t] = (sums[t] - low) * scale;
      ++ends[places[t] + 1];
    }
    for (let k = 0; k < 65536; ++k) ends[k + 1] += ends[k];
    const { index } = this.mesh.geometry, to = index.array;
    for (let t = 0; t < count; ++t) {
      const place = 3 * ends[places[t]]++;
      to[place] = corners[3 * t];
      to[place + 1] = corners[3 * t + 1];
      to[place + 2] = corners[3 * t + 2];
    }
    index.needsUpdate = true;
  }
}

// What is drawn: the copies of parts, each by one of the shapes of its part.
class Copies {
  constructor(header, arrays, material) {
    const still = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
    const list = header.copies.length > 0 ? header.copies :
      header.levels[0].parts.map((_, part) => [part, still, [255, 255, 255]]);
    this.group = new Group();
    this.material = material;
    this.quick = new ShaderMaterial(quickShader);
    this.joined = [];
    this.insides = new Group(); // what is seen through a cut, as flat as if it were filled
    this.insides.visible = false;
    this.parts = header.levels[0].parts.map((_, part) => {
      const shapes = header.levels.map((level) => unpackShape(level, part, arrays));
      return { shapes, meshes: [], count: list.filter((copy) => copy[0] === part).length };
    });
    this.coarsen(list.length > 1 ? 30 : Infinity);
    this.list = list.map(([part, rows, color]) => {
      const matrix = new Matrix4().set(...rows, 0, 0, 0, 1);
      const sphere = this.parts[part].shapes[0].geometry.boundingSphere.clone().applyMatrix4(matrix);
      return { part: this.parts[part], matrix, sphere, color: new Color(...light(color)), distance: 0 };
    });
    const center = this.list.reduce((sum, { sphere }) => sum.add(sphere.center), new Vector3());
    center.divideScalar(this.list.length);
    this.sphere = new Sphere(center, Math.max(...this.list.map(
      ({ sphere }) => sphere.center.distanceTo(center) + sphere.radius)));
    this.colored = false;
  }

  // Adds shapes down to so few triangles.
  coarsen(fewTriangles) {
    for (const { shapes, meshes, count } of this.parts) {
      coarsen(shapes, fewTriangles);
      for (const { geometry } of shapes.slice(meshes.length)) {
        const mesh = new InstancedMesh(geometry, this.material, count);
        mesh.frustumCulled = false; // copy by copy instead
        mesh.instanceMatrix.setUsage(DynamicDrawUsage);
        this.group.add(mesh);
        meshes.push(mesh);
      }
    }
  }

  paint(mode, arrays, mark) {
    for (const { shapes } of this.parts) {
      for (const shape of shapes) paint(shape, mode, arrays);
      for (const shape of shapes) if (shape.level === shapes[0].level) mark(shape);
    }
    this.colored = mode.kind === 'copies';
    for (const joined of this.joined) joined?.paint(this.colored);
  }

  // All copies as one mesh, of the finest shapes that have at most so many triangles, or the coarsest. Without a
  // graphics card every copy that is drawn by itself costs as much as some hundred triangles.
  join(most) {
    const at = ({ shapes }, place) => shapes[Math.min(place, shapes.length - 1)];
    const coarsest = Math.max(...this.parts.map(({ shapes }) => shapes.length)) - 1;
    let place = 0;
    while (place < coarsest && this.list.reduce((sum, { part }) => sum + at(part, place).triangles, 0) > most) ++place;
    if (!this.joined[place]) {
      this.joined[place] = new Joined(this.list, (part) => at(part, place));
      this.joined[place].paint(this.colored);
      this.group.add(this.joined[place].mesh);
    }
    return this.joined[place];
  }

  // Adds what is seen of a surface by itself where it is cut.
  fill(material) {
    for (const { shapes } of this.parts) this.insides.add(new Mesh(shapes[0].geometry, material));
    this.group.add(this.insides);
  }

  // Shows the copies as one mesh, or those that choose() has made ready.
  show(quick, joined) {
    const singly = this.parts.flatMap(({ meshes }) => meshes);
    for (const mesh of singly) mesh.visible = mesh.count > 0 && !joined;
    for (const one of this.joined) if (one) one.mesh.visible = one === joined;
    this.insides.children.forEach((mesh, i) => {
      const { shapes, meshes } = this.parts[i];
      mesh.geometry = shapes[Math.max(0, meshes.findIndex(({ count }) => count > 0))].geometry;
    });
    for (const mesh of joined ? [joined.mesh] : singly) mesh.material = quick ? this.quick : this.material;
  }

  // Chooses for each copy in sight the coarsest shape whose edges are at most `pixels` long, and
  // coarser ones if that takes more than `most` triangles.
  // Returns the edges in pixels that it came to.
  choose(camera, height, pixels, most) {
    const perUnit = height / (2 * Math.tan((camera.fov * Math.PI) / 360)); // pixels at distance 1
    const view = new Matrix4().multiplyMatrices(camera.matrixWorldInverse, this.group.matrixWorld);
    const frustum = new Frustum().setFromProjectionMatrix(new Matrix4().multiplyMatrices(camera.projectionMatrix, view));
    const seen = this.list.filter((copy) => frustum.intersectsSphere(copy.sphere));
    for (const copy of seen) {
      const depth = -copy.sphere.center.clone().applyMatrix4(view).z;
      copy.distance = Math.max(depth - copy.sphere.radius, camera.near);
    }
    seen.sort((a, b) => a.distance - b.distance); // what is hidden is then not shaded
    const shapeOf = ({ part, distance }, size) => {
      let place = part.shapes.length - 1;
      while (place > 0 && part.shapes[place].edge * perUnit > size * distance) --place;
      return place;
    };
    const sum = (size) => seen.reduce((all, copy) => all + copy.part.shapes[shapeOf(copy, size)].triangles, 0);
    let size = pixels;
    while (sum(size) > most && size < 1000) size *= 1.25;
    for (const { meshes } of this.parts) for (const mesh of meshes) mesh.count = 0;
    const white = new Color(1, 1, 1);
    for (const copy of seen) {
      const mesh = copy.part.meshes[shapeOf(copy, size)];
      mesh.setMatrixAt(mesh.count, copy.matrix);
      mesh.setColorAt(mesh.count++, this.colored ? copy.color : white);
    }
    for (const mesh of this.parts.flatMap(({ meshes }) => meshes)) {
      if (mesh.count === 0) continue;
      mesh.instanceMatrix.needsUpdate = true;
      mesh.instanceColor.needsUpdate = true;
    }
    this.seen = seen.length;
    return size;
  }
}

// ---- the cut --------------------------------------------------------------------------------

// What is seen of walls from behind where the surface is cut: the colour of the cut before them.
const insideShader = {
  side: BackSide,
  clipping: true,
  vertexShader: `varying vec3 world;
    #include <clipping_planes_pars_vertex>
    void main() {
      vec4 place = modelMatrix * vec4(position, 1.0);
      world = place.xyz;
      vec4 mvPosition = viewMatrix * place;
      #include <clipping_planes_vertex>
      gl_Position = projectionMatrix * mvPosition;
    }`,
  fragmentShader: `varying vec3 world;
    uniform vec3 normal, middle, right, up;
    uniform float constant, extent;
    uniform sampler2D colors;
    #include <clipping_planes_pars_fragment>
    void main() {
      #include <clipping_planes_fragment>
      vec3 way = world - cameraPosition;
      vec3 at = cameraPosition - way * (dot(normal, cameraPosition) + constant) / dot(normal, way) - middle;
      gl_FragColor = vec4(texture2D(colors, vec2(dot(at, right), dot(at, up)) / extent + 0.5).rgb, 1.0);
    }`,
};

// The colours of a cut: those of the nearest atoms, in a picture of the plane.
class CutColors {
  constructor(header, arrays, sphere) {
    this.sphere = sphere; // of the surface, where it is not turned
    const uniforms = { constant: { value: 0 }, extent: { value: 2.1 * sphere.radius }, colors: { value: null } };
    for (const name of ['normal', 'middle', 'right', 'up']) uniforms[name] = { value: new Vector3() };
    this.material = new ShaderMaterial({ ...insideShader, uniforms });
    this.drawn = '';
    this.balls = [];
    this.cells = new Map(); // of 4 Å, the balls in each
    if (!header.cut) return;
    const { step, radius_step: radiusStep, low } = header.cut;
    arrays.ball_radius.forEach((radius, i) => {
      const at = [0, 1, 2].map((c) => arrays.ball_position[3 * i + c] * step + low[c]);
      const key = CutColors.keyOf(at.map((x) => Math.floor(x / 4)));
      if (!this.cells.has(key)) this.cells.set(key, []);
      this.cells.get(key).push(i);
      this.balls.push([...at, (radius * radiusStep) ** 2]);
    });
  }

  static keyOf([x, y, z]) {
    return ((x + 8192) * 16384 + y + 8192) * 16384 + z + 8192;
  }

  // The ball that a point belongs to, -1: none is near.
  ballAt([x, y, z]) {
    const cell = [x, y, z].map((c) => Math.floor(c / 4));
    let nearest = -1, least = Infinity;
    for (let i = -1; i < 2; ++i) for (let j = -1; j < 2; ++j) for (let k = -1; k < 2; ++k) {
      for (const n of this.cells.get(CutColors.keyOf([cell[0] + i, cell[1] + j, cell[2] + k])) ?? []) {
        const ball = this.balls[n];
        const power = (x - ball[0]) ** 2 + (y - ball[1]) ** 2 + (z - ball[2]) ** 2 - ball[3];
        if (power < least) {
          least = power;
          nearest = n;
        }
      }
    }
    return nearest;
  }

  // Draws the plane as the camera sees it, unless it was the last one, too.
  // other: the colour of what has none; turn: of the surface
  draw(plane, camera, turn, mode, arrays, size, other) {
    const colors = this.balls.length > 0 && mode.cut ? arrays[mode.cut] : null;
    const rest = mode.kind === 'plain' && this.balls.length > 0 ? mode.color : other;
    const pixels = colors ? size : 1;
    const what = [...plane.normal.toArray(), plane.constant, ...camera.up.toArray(), mode.id, pixels, ...rest].join();
    this.pixels = pixels;
    if (what === this.drawn) return;
    this.drawn = what;
    const { uniforms } = this.material;
    const middle = this.sphere.center.clone().applyQuaternion(turn);
    plane.projectPoint(middle, uniforms.middle.value);
    uniforms.normal.value.copy(plane.normal);
    uniforms.constant.value = plane.constant;
    uniforms.right.value.crossVectors(plane.normal, camera.up).normalize();
    uniforms.up.value.crossVectors(uniforms.right.value, plane.normal).normalize();
    const back = turn.clone().invert(), extent = uniforms.extent.value;
    const local = (v) => v.clone().applyQuaternion(back);
    const start = local(uniforms.middle.value), right = local(uniforms.right.value), up = local(uniforms.up.value);
    const data = new Uint8Array(4 * pixels * pixels), at = new Vector3();
    for (let row = 0; row < pixels; ++row) {
      for (let column = 0; column < pixels; ++column) {
        at.copy(start).addScaledVector(right, ((column + 0.5) / pixels - 0.5) * extent)
          .addScaledVector(up, ((row + 0.5) / pixels - 0.5) * extent);
        const ball = colors ? this.ballAt(at.toArray()) : -1;
        const color = ball < 0 ? rest : colors.subarray(3 * ball, 3 * ball + 3);
        data.set([...color, 255], 4 * (row * pixels + column));
      }
    }
    uniforms.colors.value?.dispose();
    const texture = new DataTexture(data, pixels, pixels);
    texture.magFilter = texture.minFilter = LinearFilter;
    texture.needsUpdate = true;
    uniforms.colors.value = texture;
  }
}

// ---- the layers -----------------------------------------------------------------------------

// A surface of the page, with its colours and atoms.
class Layer {
  constructor(header, arrays, material) {
    this.header = header;
    this.arrays = arrays;
    this.name = header.name;
    this.copies = new Copies(header, arrays, material);
    this.group = this.copies.group;
    this.owners = header.names &&
      new Owners(header.names, arrays, this.copies.parts.map(({ shapes }) => shapes[0]));
    this.cutColors = new CutColors(header, arrays, this.copies.sphere);
    if (header.copies.length <= 1) this.copies.fill(this.cutColors.material);
    if (header.bodies) this.addBodies();
  }

  // What is seen through the surface.
  addBodies() {
    const { bodies } = this.header;
    const material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.55 });
    const mode = { kind: 'colors', array: 'color' };
    for (const part of bodies.parts.keys()) {
      const shape = unpackShape(bodies, part, this.arrays);
      paint(shape, mode, this.arrays);
      this.group.add(new Mesh(shape.geometry, material));
    }
  }

  // The direction to the eye from which the largest area of a residue is in sight, where the scene turns the group by a
  // rotation, and the middle of the residue. Each vertex hides those that lie farther than a cell of a picture behind it.
  sightOf(residue, rotation) {
    const all = [], own = [], at = new Vector3(), outward = new Vector3();
    const list = this.copies.list, shapeOf = ({ part }) => part.shapes[0];
    const sum = list.reduce((count, copy) => count + shapeOf(copy).source.length, 0);
    const stride = Math.ceil(sum / mostHiding);
    let first = null; // the copy that the residue is looked at in
    for (const copy of list) {
      const { geometry: { attributes }, source } = shapeOf(copy);
      for (let v = 0; v < source.length; ++v) {
        const isOwn = (first ?? copy) === copy && this.owners.atoms[this.owners.of[source[v]]].residue === residue;
        if (isOwn) first = copy;
        if (!isOwn && v % stride > 0) continue;
        at.fromBufferAttribute(attributes.position, v).applyMatrix4(copy.matrix).applyQuaternion(rotation);
        all.push(at.x, at.y, at.z);
        if (!isOwn) continue;
        outward.fromBufferAttribute(attributes.normal, v).transformDirection(copy.matrix).applyQuaternion(rotation);
        own.push({ at: at.clone(), outward: outward.clone() });
      }
    }
    if (own.length === 0) return null;
    const cell = 2 * Math.sqrt(stride) * shapeOf(list[0]).edge, right = new Vector3(), up = new Vector3();
    let best = null;
    for (let k = 0; k < directions; ++k) { // a golden spiral
      const z = 1 - (2 * k + 1) / directions, r = Math.sqrt(1 - z * z), angle = 2.399963 * k;
      const eye = new Vector3(r * Math.cos(angle), r * Math.sin(angle), z);
      right.set(-eye.y, eye.x, 0);
      if (right.lengthSq() < 1e-6) right.set(1, 0, 0);
      up.crossVectors(eye, right.normalize());
      const keyOf = (x, y, d) => {
        const column = Math.round((x * right.x + y * right.y + d * right.z) / cell);
        return column * 65536 + Math.round((x * up.x + y * up.y + d * up.z) / cell);
      };
      const nearest = new Map();
      for (const { at: { x, y, z: d } } of own) nearest.set(keyOf(x, y, d), -Infinity);
      for (let i = 0; i < all.length; i += 3) {
        const key = keyOf(all[i], all[i + 1], all[i + 2]), known = nearest.get(key);
        if (known === undefined) continue;
        const depth = all[i] * eye.x + all[i + 1] * eye.y + all[i + 2] * eye.z;
        if (depth > known) nearest.set(key, depth);
      }
      const area = own.reduce((seen, { at: p, outward: way }) => seen +
        (p.dot(eye) > nearest.get(keyOf(p.x, p.y, p.z)) - cell ? Math.max(0, way.dot(eye)) : 0), 0);
      if (!best || area > best.area) best = { area, eye };
    }
    const middle = own.reduce((mean, { at: p }) => mean.addScaledVector(p, 1 / own.length), new Vector3());
    return { toEye: best.eye, middle };
  }

  // The colours of an id; a layer that has none of them is plain.
  modeOf(id) {
    const { modes } = this.header;
    return modes.find((mode) => mode.id === id) ?? modes[modes.length - 1];
  }
}

// Where each of some layers is shown: as wide columns, rows or both, as fits a stage.
// Returns { left, top, width, height } of each.
function panesOf(count, width, height) {
  let best = null;
  for (let columns = 1; columns <= count; ++columns) {
    const rows = Math.ceil(count / columns);
    const side = Math.min(width / columns, height / rows);
    if (!best || side > best.side) best = { columns, side, width: width / columns, height: height / rows };
  }
  return Array.from({ length: count }, (_, n) => ({ ...best,
    left: (n % best.columns) * best.width, top: Math.floor(n / best.columns) * best.height }));
}

// ---- the scene ------------------------------------------------------------------------------

const frameTime = 1000 / 30; // that turning may take [ms]
const restAfter = 150; // without a move [ms]
const longest = 200; // that a finer drawing may take when nothing moves [ms]
const manyCopies = 300; // too many to be drawn one by one without a graphics card
const coarseCut = 96, fineCut = 400; // texels across a cut, while it moves and at rest
const mostHiding = 2e5, directions = 60; // vertices and directions that are tried to see a residue
const mostSorted = 1e6; // triangles, for a drawing at rest

const keyNames = [['arrows', 'turn'], ['+ \u2212', 'zoom'], ['r', 'reset view'], ['Esc', 'choose nothing'],
  ['?', 'show or hide this'], ['drag', 'turn'], ['wheel', 'zoom'], ['right drag', 'move'], ['click', 'choose a residue']];

// surfaces: header and arrays of each layer
function start(surfaces) {
  const [{ header }] = surfaces;
  const several = surfaces.some((surface) => surface.header.copies.length > 1);
  const finest = several ? 1 : 0.01; // edges, in pixels
  // Edges are smooth since there are more pixels than on the screen: `antialias` would cost three times as much
  // without a graphics card, where it cannot be left out while the surface turns.
  const renderer = new WebGLRenderer({ canvas: byId('view'), preserveDrawingBuffer: true });
  const canvas = renderer.domElement, stage = byId('stage');
  renderer.localClippingEnabled = true;
  const ratio = Math.min(window.devicePixelRatio, 2);
  renderer.setPixelRatio(ratio);

  const scene = new Scene();
  const camera = new PerspectiveCamera(30, 1, 0.1, 1000);
  const material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.55, forceSinglePass: true });
  const layers = surfaces.map((surface) => new Layer(surface.header, surface.arrays, material));
  const axes = header.axes.map((axis) => new Vector3(...axis)); // as pictures of the first mesh stand
  const upright = new Quaternion().setFromRotationMatrix(new Matrix4().makeBasis(...axes).transpose());
  for (const { group } of layers) {
    group.quaternion.copy(upright);
    scene.add(group);
  }
  scene.add(camera, new AmbientLight(0xffffff, ambient));
  const lamp = new DirectionalLight(0xffffff, direct);
  lamp.position.set(...lampPlace);
  camera.add(lamp, lamp.target); // which turn together

  const { center } = layers[0].copies.sphere;
  const radius = Math.max(...layers.map(({ copies: { sphere } }) => sphere.radius + sphere.center.distanceTo(center)));
  const middle = center.clone().applyQuaternion(upright);
  const site = header.zoom; // that is shown at first; null: all is
  const target = site ? new Vector3(...site.center).applyQuaternion(upright) : middle;
  let shown = layers; // all of them side by side, or one
  const panes = () => panesOf(shown.length, stage.clientWidth, stage.clientHeight);
  const all = (what) => shown.some(what);
  const controls = new TrackballControls(camera, renderer.domElement);
  controls.rotateSpeed = 3;
  controls.dynamicDampingFactor = 0.25;

  // A move is drawn at once, by as many triangles as the frames before left time for. When nothing
  // moves, finer and finer, until edges are a pixel or a drawing takes too long.
  const place = new Vector3(), turned = new Quaternion(); // of the camera that drew last
  let moved = true, movedAt = 0, size = 0, most = 500000, slow = false, crowded = false;
  let sharp = 1; // pixels of a crowd against those of the screen
  const draw = (pixels, triangles, pixelRatio) => {
    const glass = material.transparent;
    if (renderer.getPixelRatio() !== pixelRatio) renderer.setPixelRatio(pixelRatio);
    scene.updateMatrixWorld();
    cut.constant = cutAt();
    size = 0;
    crowded = false;
    let drawn = 0;
    const share = triangles / shown.length;
    const height = stage.clientHeight;
    renderer.setScissorTest(false);
    renderer.setClearColor(scene.background);
    renderer.clear(); // what no pane covers
    renderer.setScissorTest(shown.length > 1);
    for (const [n, pane] of panes().entries()) {
      const { copies, cutColors, arrays } = shown[n];
      for (const layer of layers) layer.group.visible = layer === shown[n];
      const area = [pane.left, height - pane.top - pane.height, pane.width, pane.height];
      renderer.setViewport(...area);
      renderer.setScissor(...area);
      size = Math.max(size, copies.choose(camera, pane.height * ratio, pixels, share));
      if (clipped()) cutColors.draw(cut, camera, upright, shown[n].modeOf(mode), arrays, moved ? coarseCut : fineCut, inside);
      const crowd = moved && slow && copies.seen > manyCopies;
      crowded ||= crowd;
      const joined = crowd ? copies.join(0) : glass ? copies.join(Math.min(share, mostSorted)) : null;
      if (glass) joined.sort(toEye().applyQuaternion(upright.clone().invert()).toArray());
      copies.show(moved && slow, joined);
      renderer.render(scene, camera);
      drawn += renderer.info.render.triangles;
    }
    place.copy(camera.position);
    turned.copy(camera.quaternion);
    const { dataset } = document.body; // for tests
    dataset.triangles = drawn;
    dataset.drawn = Number(dataset.drawn ?? 0) + 1;
  };
  const unfinished = () => several || slow ||
    (clipped() && all(({ cutColors }) => cutColors.pixels === coarseCut));
  const toEye = () => camera.position.clone().sub(controls.target).normalize();
  const timed = (...how) => { // waits for the end of the drawing
    const begin = performance.now();
    draw(...how);
    renderer.getContext().readPixels(0, 0, 1, 1, 6408, 5121, new Uint8Array(4)); // RGBA, bytes
    return performance.now() - begin;
  };
  const measure = () => { // whether turning needs something quicker
    slow = false;
    draw(finest, most, ratio); // compiles what the drawing card runs
    const time = timed(finest, most, ratio);
    slow = time > frameTime;
    if (several || !slow) return;
    most = Math.max((most * frameTime) / time, 20000);
    for (const { copies } of layers) copies.coarsen(5000);
    repaint();
  };
  const step = (now) => {
    controls.update();
    const pause = now - movedAt;
    if (moved) {
      forget();
      const late = pause > 1.1 * frameTime, early = pause < 0.7 * frameTime;
      if ((slow || several) && pause < 500) { // turning since the last frame
        if (late && (crowded || material.transparent)) sharp = Math.max(0.5, 0.9 * sharp);
        if (late && !crowded) most = Math.max(0.8 * most, 20000);
        if (early && !crowded) most = Math.min(1.05 * most, 5e6);
      }
      draw(finest, slow || several ? most : Infinity, slow ? sharp : several ? ratio : 2);
      movedAt = now;
      moved = false;
    } else if (unfinished() && size > 0 && pause > restAfter) {
      const last = !several || size <= 1;
      const time = timed(last ? finest : Math.max(1, size / 2), Infinity, last ? 2 : ratio);
      if (last || time > longest) size = 0;
      sharp = Math.min(1, 1.1 * sharp);
    }
    if (!moved && pause > restAfter) remember();
    document.body.dataset.rests = !moved && (size === 0 || !unfinished());
  };
  controls.addEventListener('change', () => { // which goes on after a move for steps nobody sees
    const way = place.distanceTo(camera.position) / controls.target.distanceTo(camera.position);
    moved ||= Math.max(way, turned.angleTo(camera.quaternion)) > 5e-4;
  });

  const setAspect = () => {
    const [{ width, height }] = panes();
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    moved = true;
  };
  const wholeFrom = () => { // the distance at which a pane shows all
    const [{ width, height }] = panes();
    return radius / Math.sin((Math.min(1, width / height) * Math.PI * 15) / 180);
  };
  const siteFrom = () => { // the distance at which the smaller side of a pane shows the site
    const [{ width, height }] = panes();
    return site.side / (2 * Math.min(1, width / height) * Math.tan((15 * Math.PI) / 180));
  };
  const reset = () => {
    camera.up.set(0, 1, 0);
    camera.position.copy(target).add(new Vector3(0, 0, site ? siteFrom() : wholeFrom()));
    camera.near = radius / 50;
    camera.far = radius * 50;
    controls.target.copy(target);
    camera.updateProjectionMatrix();
    controls.update();
    moved = true;
  };

  const setSize = () => {
    if (stage.clientWidth === 0 || stage.clientHeight === 0) return;
    renderer.setSize(stage.clientWidth, stage.clientHeight, false);
    controls.handleResize();
    setAspect();
    setCaptions();
  };
  let mode = header.modes[0].id, chosen = null; // a residue of all layers, by its name
  const repaint = () => {
    for (const layer of layers) {
      const { copies, arrays, owners } = layer, residue = chosen && owners?.find(chosen);
      copies.paint(layer.modeOf(mode), arrays, (shape) => { if (residue) owners.mark(shape, residue); });
    }
    moved = true;
  };
  const legend = () => { // those that are plain for want of values add nothing
    const modes = shown.map((layer) => layer.modeOf(mode));
    const own = modes.filter(({ id }) => id === mode);
    showLegend(own.length > 0 ? own : modes, shown.flatMap((layer) => layer.header.bodies?.entries ?? []));
  };
  const setMode = (id) => {
    mode = id;
    legend();
    repaint();
  };

  // The layers: one, or all side by side.
  const setCaptions = () => {
    const captions = shown.length > 1 ? panes().map(({ left, top, width }, n) => {
      const caption = document.createElement('div');
      caption.textContent = shown[n].name;
      caption.style.cssText = `left:${left}px;top:${top + 8}px;width:${width}px`;
      return caption;
    }) : [];
    byId('captions').replaceChildren(...captions);
  };
  const setLayers = () => {
    const place = Number(byId('layer').value), before = wholeFrom();
    shown = place < 0 ? layers : [layers[place]];
    zoom(wholeFrom() / before);
    byId('about').textContent = [...new Set(shown.map((layer) => layer.header.about))].join(' ');
    setCaptions();
    setAspect();
    legend();
    if (!owners()) return;
    search(byId('search').value);
    choose(chosen);
  };
  const nextLayer = () => {
    const { options } = byId('layer');
    byId('layer').selectedIndex = (options.selectedIndex + 1) % options.length;
    setLayers();
  };

  // The atoms: what the mouse is over is named, what is clicked is chosen, in the list too.
  const owners = () => shown[0].owners; // those in the list
  const ray = new Raycaster(), mouse = new Vector2(), tip = byId('tip'), list = byId('residues');
  // The layer under the mouse, and the vertex: null, if there is none that an atom owns.
  const vertexAt = (event) => {
    const box = canvas.getBoundingClientRect();
    const x = event.clientX - box.left, y = event.clientY - box.top;
    const at = panes().findIndex(({ left, top, width, height }) =>
      x >= left && x < left + width && y >= top && y < top + height);
    if (at < 0 || !shown[at].owners) return null;
    const { left, top, width, height } = panes()[at], layer = shown[at];
    mouse.set((2 * (x - left)) / width - 1, 1 - (2 * (y - top)) / height);
    ray.setFromCamera(mouse, camera);
    let nearest = null;
    for (const { meshes: [mesh], shapes: [shape] } of layer.copies.parts) {
      if (!several) mesh.count = 1; // whatever is shown in its place
      mesh.boundingSphere = null; // copies have moved
      const hits = ray.intersectObject(mesh, false);
      const hit = hits.find(({ point }) => !clipped() || cut.distanceToPoint(point) >= 0);
      if (hit && !(nearest && nearest.hit.distance < hit.distance)) nearest = { hit, mesh, shape };
    }
    if (!nearest) return null;
    const { hit, mesh, shape } = nearest;
    const point = mesh.worldToLocal(hit.point.clone()), corner = new Vector3();
    const far = [hit.face.a, hit.face.b, hit.face.c].map((v) => [
      corner.fromBufferAttribute(shape.geometry.attributes.position, v).distanceTo(point), v]);
    return { layer, vertex: shape.source[far.sort((a, b) => a[0] - b[0])[0][1]] };
  };
  const textOf = ({ layer, vertex }) => {
    const { owners, arrays } = layer;
    const { residue, name, area } = owners.atoms[owners.of[vertex]];
    const value = valueText(layer.modeOf(mode), vertex, arrays);
    return `${owners.nameOf(residue)} ${name}${value ? `, ${value}` : ''}, ${number(area, 1)} of ${number(residue.area, 1)} Å²`;
  };
  let forget = () => {}, remember = () => {}; // the label, while the surface turns
  const choose = (name) => {
    if (!owners()) return;
    chosen = name;
    const place = owners().residues.indexOf(owners().find(name));
    if (place >= 0 && !list.querySelector(`option[value="${place}"]`)) search('');
    list.value = place >= 0 ? place : '';
    list.selectedOptions[0]?.scrollIntoView({ block: 'nearest' });
    const areas = shown.map((layer) => {
      const residue = layer.owners?.find(name);
      return residue ? `${shown.length > 1 ? `${layer.name} ` : ''}${number(residue.area, 1)} Å²` : '';
    });
    byId('chosen').textContent = name ? [name, ...areas.filter(Boolean)].join(', ') : '';
    repaint();
  };
  const chooseAt = (place) => { // and turns so that it is in sight
    const residue = owners().residues[place];
    choose(owners().nameOf(residue));
    const sight = shown[0].sightOf(residue, upright);
    if (!sight) return;
    const turn = new Quaternion().setFromUnitVectors(toEye(), sight.toEye);
    const arm = camera.position.clone().sub(controls.target).applyQuaternion(turn);
    if (arm.length() < 0.9 * wholeFrom()) controls.target.copy(sight.middle);
    camera.position.copy(controls.target).add(arm);
    camera.up.applyQuaternion(turn);
    moved = true;
  };
  if (owners()) {
    byId('atoms').hidden = false;
    list.addEventListener('change', () => chooseAt(list.value));
    byId('search').addEventListener('input', () => search(byId('search').value));
    byId('search').addEventListener('keydown', (event) => {
      if (event.key === 'Enter' && list.options.length > 0) chooseAt(list.options[0].value);
    });
    search('');
    let waits = false, last = null, pressed = null, stale = false;
    forget = () => {
      stale ||= !tip.hidden;
      tip.hidden = true;
    };
    remember = () => {
      if (stale) look();
      stale = false;
    };
    const look = () => {
      waits = false;
      if (!last) return;
      const found = last.buttons === 0 ? vertexAt(last) : null;
      tip.hidden = !found;
      if (!found) return;
      tip.textContent = textOf(found);
      const { left, top, width, height } = stage.getBoundingClientRect();
      const x = last.clientX - left, y = last.clientY - top;
      tip.style.left = `${x > width / 2 ? x - tip.offsetWidth - 14 : x + 14}px`;
      tip.style.top = `${y > height / 2 ? y - tip.offsetHeight - 10 : y + 14}px`;
    };
    canvas.addEventListener('pointermove', (event) => {
      last = event;
      if (!waits) requestAnimationFrame(look);
      waits = true;
    });
    canvas.addEventListener('pointerleave', () => {
      tip.hidden = true;
      last = null;
    });
    canvas.addEventListener('pointerdown', (event) => { pressed = event; });
    canvas.addEventListener('pointerup', (event) => {
      if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > 4) return;
      const found = vertexAt(event);
      if (!found) return choose(null);
      const { layer: { owners: own }, vertex } = found;
      choose(own.nameOf(own.atoms[own.of[vertex]].residue));
    });
  }

  // Lists the residues that have each word: as chain, as number, or as the begin of the name.
  function search(text) {
    const words = text.toUpperCase().split(/[\s/]+/).filter(Boolean);
    list.replaceChildren();
    const { residues } = owners();
    residues.forEach((residue, i) => {
      const parts = [residue.chain, residue.name, residue.place].map((part) => part.toUpperCase());
      const has = (word) => {
        const at = parts.findIndex((part, k) => (k === 1 ? part?.startsWith(word) : part === word));
        if (at >= 0) parts[at] = null;
        return at >= 0;
      };
      const fits = words.every((word) => has(word));
      if (residue.area > 0 && fits) list.append(new Option(`${owners().nameOf(residue)}  ${number(residue.area, 1)}`, i));
    });
    byId('found').textContent = words.length === 0 ? '' : `${list.options.length} found`;
  }

  // A cut toward the eye, and light that goes through.
  const cut = new Plane();
  const clipped = () => Number(byId('clip').value) > 0;
  const cutAt = () => {
    cut.normal.copy(toEye()).negate();
    return toEye().dot(middle) + radius * (1 - 2 * Number(byId('clip').value));
  };
  for (const { cutColors } of layers) cutColors.material.clippingPlanes = [cut];
  let inside = [0xb9, 0xbe, 0xc6]; // of what has no colour
  const walls = [material, ...layers.map(({ copies }) => copies.quick)];
  const setClip = () => {
    for (const one of walls) {
      one.clippingPlanes = clipped() ? [cut] : null;
      one.side = one.transparent ? DoubleSide : FrontSide;
      one.needsUpdate = true;
    }
    for (const { copies } of layers) copies.insides.visible = clipped() && material.opacity === 1;
    moved = true;
  };
  const setOpacity = () => {
    const before = material.transparent;
    material.opacity = Number(byId('opacity').value);
    for (const { copies } of layers) copies.quick.uniforms.opacity.value = material.opacity;
    for (const one of walls) {
      one.transparent = material.opacity < 1;
      one.depthWrite = !one.transparent;
    }
    setClip();
    if (material.transparent !== before) measure();
  };
  byId('clip').addEventListener('input', setClip);
  byId('opacity').addEventListener('input', setOpacity);
  byId('png').addEventListener('click', () => {
    draw(finest, Infinity, 2);
    const link = document.createElement('a');
    link.download = `${header.title.replace(/[^\w.-]+/g, '_') || 'surface'}.png`;
    link.href = canvas.toDataURL('image/png');
    document.body.dataset.png = link.href.length;
    link.click();
  });
  const setBackground = (dark) => {
    byId('dark').checked = dark;
    document.body.classList.toggle('dark', dark);
    inside = dark ? [0x8a, 0x8f, 0x98] : [0xb9, 0xbe, 0xc6];
    scene.background = new Color(dark ? 0x14161a : 0xffffff);
    moved = true;
  };

  const choice = byId('mode');
  const modes = new Map(); // of all layers, by id
  for (const layer of layers) for (const { id, title } of layer.header.modes) if (!modes.has(id)) modes.set(id, title);
  [...modes.values()].forEach((title, number) => choice.append(new Option(title, number)));
  const asked = new URLSearchParams(window.location.search).get('color');
  const ids = [...modes.keys()];
  choice.selectedIndex = Math.max(0, ids.indexOf(asked));
  choice.addEventListener('change', () => setMode(ids[choice.selectedIndex]));
  if (layers.length > 1) {
    const select = byId('layer');
    select.append(new Option('Side by side', -1), ...layers.map(({ name }, n) => new Option(name, n)));
    select.hidden = false;
    select.addEventListener('change', setLayers);
    keyNames.splice(3, 0, ['s', 'next surface']);
  }
  byId('dark').addEventListener('change', (event) => setBackground(event.target.checked));
  byId('reset').addEventListener('click', reset);
  new ResizeObserver(setSize).observe(stage);
  canvas.addEventListener('webglcontextrestored', () => { moved = true; });
  const rotate = (axis, angle) => {
    const turn = new Quaternion().setFromAxisAngle(axis.clone().applyQuaternion(camera.quaternion), angle);
    const arm = camera.position.clone().sub(controls.target).applyQuaternion(turn);
    camera.position.copy(controls.target).add(arm);
    camera.up.applyQuaternion(turn);
    moved = true;
  };
  const zoom = (factor) => {
    camera.position.sub(controls.target).multiplyScalar(factor).add(controls.target);
    moved = true;
  };
  const showKeys = () => {
    const shown = byId('keys').hidden;
    byId('keys').hidden = !shown;
    byId('help').setAttribute('aria-expanded', shown);
  };
  for (const [key, does] of keyNames) {
    for (const [tag, text] of [['dt', key], ['dd', does]]) {
      const line = document.createElement(tag);
      line.textContent = text;
      byId('keys').append(line);
    }
  }
  byId('help').addEventListener('click', showKeys);
  const keys = {
    ArrowLeft: () => rotate(new Vector3(0, 1, 0), -0.1), ArrowRight: () => rotate(new Vector3(0, 1, 0), 0.1),
    ArrowUp: () => rotate(new Vector3(1, 0, 0), -0.1), ArrowDown: () => rotate(new Vector3(1, 0, 0), 0.1),
    '+': () => zoom(0.9), '-': () => zoom(1 / 0.9), r: reset, s: layers.length > 1 && nextLayer, Escape: () => choose(null), '?': showKeys,
  };
  document.addEventListener('keydown', (event) => {
    if (event.target.closest?.('input:not([type=checkbox]), select')) return; // which have keys of their own
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    keys[event.key]();
    event.preventDefault();
  });

  byId('title').textContent = header.title;
  byId('about').textContent = [...new Set(layers.map((layer) => layer.header.about))].join(' ');
  setBackground(window.matchMedia('(prefers-color-scheme: dark)').matches);
  setSize();
  reset();
  setMode(ids[choice.selectedIndex]);
  byId('opacity').value = header.opacity;
  setOpacity();
  measure();
  renderer.setAnimationLoop(step);
}

async function main() {
  try {
    const header = JSON.parse(byId('header').textContent);
    const bytes = await unpackBytes(byId('data').textContent);
    start([header, ...header.others].map((layer, n) => {
      const arrays = {};
      for (const array of header.arrays)
        if (array.layer === n) arrays[array.name] = unpackArray(bytes, array);
      return { header: layer, arrays };
    }));
    document.body.dataset.state = 'ready';
  } catch (problem) {
    document.body.dataset.state = 'failed';
    byId('title').textContent = `This page cannot show its surface: ${problem.message}`;
    throw problem;
  }
}

main();
