// SPDX-License-Identifier: MPL-2.0
// The viewer of a .html file: unpacks the mesh that stands in the page, and shows it. build.sh makes
// viewer.min.js of this file and the parts of three.js that it uses.

import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, DynamicDrawUsage, Frustum, Group,
  InstancedMesh, Matrix4, Mesh, MeshStandardMaterial, PerspectiveCamera, Quaternion, SRGBColorSpace, Scene,
  ShaderMaterial, Sphere, Vector3, WebGLRenderer,
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

const fewTriangles = 30;

// The shapes of a part, from fine to coarse: those of the file, and behind them what is still
// coarser, for turning many copies without a graphics card.
function shapesOf(header, part, arrays) {
  const shapes = header.levels.map((level) => unpackShape(level, part, arrays));
  if (header.copies.length < 2) return shapes;
  for (let cell = 2 * shapes[shapes.length - 1].edge; ; cell *= 1.2) {
    const last = shapes[shapes.length - 1];
    if (last.triangles <= fewTriangles) return shapes;
    const next = clustered(last, cell);
    if (next.triangles === 0) return shapes;
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

function showLegend(mode) {
  const legend = byId('legend');
  legend.replaceChildren();
  if (mode.kind === 'scale') {
    const bar = document.createElement('div');
    bar.className = 'bar';
    bar.style.background = `linear-gradient(to right, ${mode.stops.map(css).join(', ')})`;
    const ends = document.createElement('div');
    ends.className = 'ends';
    for (const value of [mode.low, (mode.low + mode.high) / 2, mode.high]) {
      const label = document.createElement('span');
      label.textContent = value.toFixed(2).replace('-', '\u2212');
      ends.append(label);
    }
    const unit = document.createElement('div');
    unit.className = 'unit';
    unit.textContent = mode.unit;
    legend.append(bar, ends, unit);
  } else if (mode.entries) {
    for (const entry of mode.entries) {
      const row = document.createElement('div');
      row.className = 'entry';
      const patch = document.createElement('i');
      patch.style.background = css(entry.color);
      row.append(patch, entry.name);
      legend.append(row);
    }
  }
}

// ---- the copies -----------------------------------------------------------------------------

const ambient = 0.9, direct = 2.4, lampPlace = [-0.5, 0.8, 1]; // over the eye's shoulder

// For turning without a graphics card: light at vertices, and nothing to be done for a pixel.
const quickShader = {
  vertexColors: true,
  vertexShader: `varying vec3 shade;
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
      float lamp = max(0.0, dot(normalize(normalMatrix * outward), normalize(vec3(${lampPlace}))));
      light *= (${ambient} + ${direct} * lamp) / ${Math.PI};
      shade = 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055; // sRGB
      gl_Position = projectionMatrix * modelViewMatrix * place;
    }`,
  fragmentShader: 'varying vec3 shade; void main() { gl_FragColor = vec4(shade, 1.0); }',
};

// What is drawn: the copies of parts, each by one of the shapes of its part.
class Copies {
  constructor(header, arrays, material) {
    const still = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];
    const list = header.copies.length > 0 ? header.copies :
      header.levels[0].parts.map((_, part) => [part, still, [255, 255, 255]]);
    this.group = new Group();
    this.material = material;
    this.quick = new ShaderMaterial(quickShader);
    this.parts = header.levels[0].parts.map((_, part) => {
      const shapes = shapesOf(header, part, arrays);
      const count = list.filter((copy) => copy[0] === part).length;
      const meshes = shapes.map(({ geometry }) => {
        const mesh = new InstancedMesh(geometry, material, count);
        mesh.frustumCulled = false; // copy by copy instead
        mesh.instanceMatrix.setUsage(DynamicDrawUsage);
        this.group.add(mesh);
        return mesh;
      });
      return { shapes, meshes };
    });
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

  paint(mode, arrays) {
    for (const { shapes } of this.parts) for (const shape of shapes) paint(shape, mode, arrays);
    this.colored = mode.kind === 'copies';
    if (this.crowd) this.paintCrowd();
  }

  // All copies by the coarsest shapes as one mesh: without a graphics card every copy that is drawn by
  // itself costs as much as some hundred triangles.
  makeCrowd() {
    const positions = [], index = [], corner = new Vector3();
    for (const { part, matrix } of this.list) {
      const { geometry } = part.shapes[part.shapes.length - 1];
      const first = positions.length / 3;
      for (const v of geometry.index.array) index.push(first + v);
      for (let v = 0; v < geometry.attributes.position.count; ++v) {
        corner.fromBufferAttribute(geometry.attributes.position, v).applyMatrix4(matrix);
        positions.push(corner.x, corner.y, corner.z);
      }
    }
    const { geometry } = makeShape('', Float32Array.from(positions), Uint32Array.from(index), []);
    this.crowd = new Mesh(geometry, this.quick);
    this.group.add(this.crowd);
    this.paintCrowd();
  }

  paintCrowd() {
    const to = this.crowd.geometry.attributes.color;
    let at = 0;
    for (const { part, color } of this.list) {
      const from = part.shapes[part.shapes.length - 1].geometry.attributes.color.array;
      const own = this.colored ? [color.r, color.g, color.b] : [1, 1, 1];
      from.forEach((value, i) => { to.array[at++] = value * own[i % 3]; });
    }
    to.needsUpdate = true;
  }

  // Shows the copies as one mesh, or those that choose() has made ready.
  show(quick, crowd) {
    if (crowd && !this.crowd) this.makeCrowd();
    if (this.crowd) this.crowd.visible = crowd;
    for (const mesh of this.parts.flatMap(({ meshes }) => meshes)) {
      mesh.material = quick ? this.quick : this.material;
      mesh.visible = mesh.count > 0 && !crowd;
    }
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

// ---- the scene ------------------------------------------------------------------------------

const frameTime = 1000 / 30; // that turning may take [ms]
const restAfter = 150; // without a move [ms]
const longest = 200; // that a finer drawing may take when nothing moves [ms]
const manyCopies = 300; // too many to be drawn one by one without a graphics card

function start(header, arrays) {
  const several = header.copies.length > 1; // they get smooth edges when nothing moves
  const renderer = new WebGLRenderer({ canvas: byId('view'), antialias: !several });
  const ratio = Math.min(window.devicePixelRatio, 2);
  renderer.setPixelRatio(ratio);

  const scene = new Scene();
  const camera = new PerspectiveCamera(30, 1, 0.1, 1000);
  const material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.55 });
  const copies = new Copies(header, arrays, material);
  const axes = header.axes.map((axis) => new Vector3(...axis)); // as pictures of the mesh stand
  copies.group.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(...axes).transpose());
  scene.add(copies.group, camera, new AmbientLight(0xffffff, ambient));
  const lamp = new DirectionalLight(0xffffff, direct);
  lamp.position.set(...lampPlace);
  camera.add(lamp);

  const radius = copies.sphere.radius;
  const middle = copies.sphere.center.clone().applyQuaternion(copies.group.quaternion);
  const controls = new TrackballControls(camera, renderer.domElement);
  controls.rotateSpeed = 3;
  controls.dynamicDampingFactor = 0.25;

  // A move is drawn at once, by as many triangles as the frames before left time for. When nothing
  // moves, finer and finer, until edges are a pixel or a drawing takes too long.
  const place = new Vector3(), turned = new Quaternion(); // of the camera that drew last
  let moved = true, movedAt = 0, size = 0, most = 500000, slow = false, crowded = false;
  let sharp = 1; // pixels of a crowd against those of the screen
  const draw = (pixels, triangles, pixelRatio) => {
    if (renderer.getPixelRatio() !== pixelRatio) renderer.setPixelRatio(pixelRatio);
    scene.updateMatrixWorld();
    size = copies.choose(camera, window.innerHeight * ratio, pixels, triangles);
    crowded = moved && slow && copies.seen > manyCopies;
    copies.show(moved && slow, crowded);
    renderer.render(scene, camera);
    place.copy(camera.position);
    turned.copy(camera.quaternion);
    const { dataset } = document.body; // for tests
    dataset.triangles = renderer.info.render.triangles;
    dataset.drawn = Number(dataset.drawn ?? 0) + 1;
  };
  const timed = (...how) => { // waits for the end of the drawing
    const begin = performance.now();
    draw(...how);
    renderer.getContext().readPixels(0, 0, 1, 1, 6408, 5121, new Uint8Array(4)); // RGBA, bytes
    return performance.now() - begin;
  };
  const step = (now) => {
    controls.update();
    const pause = now - movedAt;
    if (moved) {
      if (crowded && pause < 500) { // turning since the last frame
        if (pause > 1.1 * frameTime) sharp = Math.max(0.5, 0.9 * sharp);
      } else if (several && pause < 500) {
        if (pause > 1.1 * frameTime) most = Math.max(0.8 * most, 20000);
        else if (pause < 0.7 * frameTime) most = Math.min(1.05 * most, 5e6);
      }
      draw(1, several ? most : Infinity, slow ? sharp : ratio);
      movedAt = now;
      moved = false;
    } else if (several && size > 0 && pause > restAfter) {
      const last = size <= 1;
      const time = timed(Math.max(1, size / 2), Infinity, last ? 2 : ratio);
      if (last || time > longest) size = 0;
      sharp = Math.min(1, 1.1 * sharp);
    }
    document.body.dataset.rests = size === 0;
  };
  controls.addEventListener('change', () => { // which goes on after a move for steps nobody sees
    const way = place.distanceTo(camera.position) / controls.target.distanceTo(camera.position);
    moved ||= Math.max(way, turned.angleTo(camera.quaternion)) > 5e-4;
  });

  const reset = () => {
    const aspect = window.innerWidth / window.innerHeight;
    const angle = (Math.min(1, aspect) * Math.PI * 15) / 180;
    camera.up.set(0, 1, 0);
    camera.position.copy(middle).add(new Vector3(0, 0, radius / Math.sin(angle)));
    camera.near = radius / 50;
    camera.far = radius * 50;
    controls.target.copy(middle);
    camera.updateProjectionMatrix();
    controls.update();
    moved = true;
  };

  const setSize = () => {
    camera.aspect = window.innerWidth / window.innerHeight;
    camera.updateProjectionMatrix();
    renderer.setSize(window.innerWidth, window.innerHeight, false);
    controls.handleResize();
    moved = true;
  };
  const setMode = (number) => {
    copies.paint(header.modes[number], arrays);
    showLegend(header.modes[number]);
    moved = true;
  };
  const setBackground = (dark) => {
    document.body.classList.toggle('dark', dark);
    scene.background = new Color(dark ? 0x14161a : 0xffffff);
    moved = true;
  };

  const choice = byId('mode');
  header.modes.forEach((mode, number) => choice.append(new Option(mode.title, number)));
  const asked = new URLSearchParams(window.location.search).get('color');
  const found = header.modes.findIndex((mode) => mode.id === asked);
  choice.value = Math.max(0, found);
  choice.addEventListener('change', () => setMode(choice.value));
  byId('dark').addEventListener('change', (event) => setBackground(event.target.checked));
  byId('reset').addEventListener('click', reset);
  window.addEventListener('resize', setSize);

  byId('title').textContent = header.title;
  setBackground(false);
  setSize();
  reset();
  setMode(choice.value);
  if (several) {
    draw(1, most, ratio); // compiles what the drawing card runs
    slow = timed(1, most, ratio) > frameTime;
  }
  renderer.setAnimationLoop(step);
}

async function main() {
  try {
    const header = JSON.parse(byId('header').textContent);
    const bytes = await unpackBytes(byId('data').textContent);
    const arrays = {};
    for (const array of header.arrays) arrays[array.name] = unpackArray(bytes, array);
    start(header, arrays);
    document.body.dataset.state = 'ready';
  } catch (problem) {
    document.body.dataset.state = 'failed';
    byId('title').textContent = `This page cannot show its surface: ${problem.message}`;
    throw problem;
  }
}

main();
