// SPDX-License-Identifier: MPL-2.0
// The viewer of a .html file: unpacks the mesh that stands in the page, and shows it. build.sh makes
// viewer.min.js of this file and the parts of three.js that it uses.

import {
  AmbientLight, BackSide, BufferAttribute, BufferGeometry, Color, DirectionalLight, DoubleSide, DynamicDrawUsage,
  FrontSide, Frustum, Group, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial, MeshStandardMaterial, PerspectiveCamera, Plane,
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
      label.textContent = number(value, 2);
      ends.append(label);
    }
    const unit = document.createElement('div');
    unit.className = 'unit';
    unit.textContent = mode.unit;
    legend.append(bar, ends, unit);
  }
  const missing = mode.missing ? [{ name: 'no value', color: mode.missing }] : [];
  for (const entry of mode.entries ?? missing) {
    const row = document.createElement('div');
    row.className = 'entry';
    const patch = document.createElement('i');
    patch.style.background = css(entry.color);
    row.append(patch, entry.name);
    legend.append(row);
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
    this.insides = new Group(); // what is seen through a cut, as flat as if it were filled
    this.insides.visible = false;
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
      return { shapes, meshes, part };
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

  // Adds what is seen of a surface by itself where it is cut.
  fill(material) {
    for (const { shapes } of this.parts) this.insides.add(new Mesh(shapes[0].geometry, material));
    this.group.add(this.insides);
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
  const renderer = new WebGLRenderer({ canvas: byId('view'), antialias: !several, preserveDrawingBuffer: true });
  const canvas = renderer.domElement, stage = byId('stage');
  renderer.localClippingEnabled = true;
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
    size = copies.choose(camera, stage.clientHeight * ratio, pixels, triangles);
    if (clipped()) cut.constant = cutAt();
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
    const aspect = stage.clientWidth / stage.clientHeight;
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
    if (stage.clientWidth === 0 || stage.clientHeight === 0) return;
    camera.aspect = stage.clientWidth / stage.clientHeight;
    camera.updateProjectionMatrix();
    renderer.setSize(stage.clientWidth, stage.clientHeight, false);
    controls.handleResize();
    moved = true;
  };
  let mode = header.modes[0], chosen = null;
  const repaint = () => {
    copies.paint(mode, arrays);
    if (chosen) for (const { shapes } of copies.parts) owners.mark(shapes[0], chosen);
    moved = true;
  };
  const setMode = (place) => {
    mode = header.modes[place];
    showLegend(mode);
    repaint();
  };

  // The atoms: what the mouse is over is named, what is clicked is chosen, in the list too.
  const owners = header.names && new Owners(header.names, arrays, copies.parts.map(({ shapes }) => shapes[0]));
  const ray = new Raycaster(), mouse = new Vector2(), tip = byId('tip'), list = byId('residues');
  const vertexAt = (event) => {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    mouse.set((2 * (event.clientX - left)) / width - 1, 1 - (2 * (event.clientY - top)) / height);
    ray.setFromCamera(mouse, camera);
    const shown = copies.parts.flatMap(({ shapes, meshes }) => (meshes[0].count > 0 ? [[meshes[0], shapes[0]]] : []));
    let nearest = null;
    for (const [mesh, shape] of shown) {
      mesh.boundingSphere = null; // copies have moved
      const hits = ray.intersectObject(mesh, false);
      const hit = hits.find(({ point }) => !clipped() || cut.distanceToPoint(point) >= 0);
      if (hit && !(nearest && nearest.hit.distance < hit.distance)) nearest = { hit, mesh, shape };
    }
    if (!nearest) return -1;
    const { hit, mesh, shape } = nearest;
    const point = mesh.worldToLocal(hit.point.clone()), corner = new Vector3();
    const far = [hit.face.a, hit.face.b, hit.face.c].map((v) => [
      corner.fromBufferAttribute(shape.geometry.attributes.position, v).distanceTo(point), v]);
    return shape.source[far.sort((a, b) => a[0] - b[0])[0][1]];
  };
  const textOf = (vertex) => {
    const { residue, name, area } = owners.atoms[owners.of[vertex]];
    const value = valueText(mode, vertex, arrays);
    return `${owners.nameOf(residue)} ${name}${value ? `, ${value}` : ''}, ${number(area, 1)} of ${number(residue.area, 1)} Å²`;
  };
  const choose = (residue) => {
    chosen = residue;
    list.value = residue ? owners.residues.indexOf(residue) : '';
    byId('chosen').textContent = residue ? `${owners.nameOf(residue)}, ${number(residue.area, 1)} Å²` : '';
    repaint();
  };
  if (owners) {
    byId('atoms').hidden = false;
    owners.residues.forEach((residue, i) => {
      if (residue.area > 0) list.append(new Option(`${owners.nameOf(residue)}  ${number(residue.area, 1)}`, i));
    });
    list.addEventListener('change', () => choose(owners.residues[list.value]));
    let waits = false, last = null, pressed = null;
    const look = () => {
      waits = false;
      const vertex = last.buttons === 0 ? vertexAt(last) : -1;
      tip.hidden = vertex < 0;
      if (vertex < 0) return;
      tip.textContent = textOf(vertex);
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
    canvas.addEventListener('pointerleave', () => { tip.hidden = true; });
    canvas.addEventListener('pointerdown', (event) => { pressed = event; });
    canvas.addEventListener('pointerup', (event) => {
      if (!pressed || Math.hypot(event.clientX - pressed.clientX, event.clientY - pressed.clientY) > 4) return;
      const vertex = vertexAt(event);
      choose(vertex < 0 ? null : owners.atoms[owners.of[vertex]].residue);
    });
  }

  // A cut toward the eye, and light that goes through.
  const cut = new Plane();
  const clipped = () => Number(byId('clip').value) > 0;
  const cutAt = () => {
    const toEye = camera.position.clone().sub(controls.target).normalize();
    cut.normal.copy(toEye).negate();
    return toEye.dot(middle) + radius * (1 - 2 * Number(byId('clip').value));
  };
  const inside = new MeshBasicMaterial({ side: BackSide, clippingPlanes: [cut] });
  if (!several) copies.fill(inside);
  const setClip = () => {
    material.clippingPlanes = clipped() ? [cut] : null;
    material.side = material.transparent ? DoubleSide : FrontSide;
    material.needsUpdate = true;
    copies.insides.visible = clipped() && material.opacity === 1;
    moved = true;
  };
  const setOpacity = () => {
    material.opacity = Number(byId('opacity').value);
    material.transparent = material.opacity < 1;
    material.depthWrite = !material.transparent;
    setClip();
  };
  byId('clip').addEventListener('input', setClip);
  byId('opacity').addEventListener('input', setOpacity);
  byId('png').addEventListener('click', () => {
    draw(1, Infinity, ratio);
    const link = document.createElement('a');
    link.download = `${header.title.replace(/[^\w.-]+/g, '_') || 'surface'}.png`;
    link.href = canvas.toDataURL('image/png');
    document.body.dataset.png = link.href.length;
    link.click();
  });
  const setBackground = (dark) => {
    byId('dark').checked = dark;
    document.body.classList.toggle('dark', dark);
    inside.color.set(dark ? 0x8a8f98 : 0xb9bec6);
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
  const keys = {
    ArrowLeft: () => rotate(new Vector3(0, 1, 0), -0.1), ArrowRight: () => rotate(new Vector3(0, 1, 0), 0.1),
    ArrowUp: () => rotate(new Vector3(1, 0, 0), -0.1), ArrowDown: () => rotate(new Vector3(1, 0, 0), 0.1),
    '+': () => zoom(0.9), '-': () => zoom(1 / 0.9), r: reset, Escape: () => choose(null),
  };
  canvas.addEventListener('keydown', (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    keys[event.key]();
    event.preventDefault();
  });

  byId('title').textContent = header.title;
  setBackground(window.matchMedia('(prefers-color-scheme: dark)').matches);
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
