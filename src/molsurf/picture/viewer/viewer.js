// SPDX-License-Identifier: MPL-2.0
// The viewer of a .html file: unpacks the mesh that stands in the page, and shows it. build.sh makes
// viewer.min.js of this file and the parts of three.js that it uses.

import {
  AmbientLight, BufferAttribute, BufferGeometry, Color, DirectionalLight, Matrix4,
  Mesh, MeshStandardMaterial, PerspectiveCamera, SRGBColorSpace, Scene, Vector3, WebGLRenderer,
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

function makeGeometry(header, arrays) {
  const quantized = arrays.position;
  const positions = new Float32Array(quantized.length);
  for (let i = 0; i < positions.length; ++i)
    positions[i] = (quantized[i] - 32767.5) * header.step;
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(positions, 3));
  geometry.setIndex(new BufferAttribute(arrays.index, 1));
  geometry.computeVertexNormals();
  geometry.computeBoundingSphere();
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(positions.length), 3));
  return geometry;
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

function paint(geometry, mode, arrays) {
  const to = geometry.attributes.color.array;
  const count = to.length / 3;
  let colorOf;
  if (mode.kind === 'scale') {
    const table = ramp(mode.stops);
    const values = arrays[mode.array];
    colorOf = (i) => table[values[i]];
  } else if (mode.kind === 'names') {
    const table = mode.entries.map((entry) => light(entry.color));
    const values = arrays[mode.array];
    colorOf = (i) => table[values[i]];
  } else if (mode.kind === 'colors') {
    const values = arrays[mode.array];
    colorOf = (i) => light(values.subarray(3 * i, 3 * i + 3));
  } else {
    const plain = light(mode.color);
    colorOf = () => plain;
  }
  for (let i = 0; i < count; ++i) to.set(colorOf(i), 3 * i);
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

// ---- the scene ------------------------------------------------------------------------------

function start(header, arrays) {
  const geometry = makeGeometry(header, arrays);
  const renderer = new WebGLRenderer({ canvas: byId('view'), antialias: true });
  renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));

  const scene = new Scene();
  const camera = new PerspectiveCamera(30, 1, 0.1, 1000);
  const material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.55 });
  const mesh = new Mesh(geometry, material);
  const axes = header.axes.map((axis) => new Vector3(...axis)); // as pictures of the mesh stand
  mesh.quaternion.setFromRotationMatrix(new Matrix4().makeBasis(...axes).transpose());
  scene.add(mesh, camera, new AmbientLight(0xffffff, 0.9));
  const lamp = new DirectionalLight(0xffffff, 2.4);
  lamp.position.set(-0.5, 0.8, 1); // over the eye's shoulder
  camera.add(lamp);

  const radius = geometry.boundingSphere.radius;
  const middle = geometry.boundingSphere.center.clone().applyQuaternion(mesh.quaternion);
  const controls = new TrackballControls(camera, renderer.domElement);
  controls.rotateSpeed = 3;
  controls.dynamicDampingFactor = 0.25;
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
  };

  const setSize = () => {
    camera.aspect = window.innerWidth / window.innerHeight;
    camera.updateProjectionMatrix();
    renderer.setSize(window.innerWidth, window.innerHeight, false);
    controls.handleResize();
  };
  const setMode = (number) => {
    paint(geometry, header.modes[number], arrays);
    showLegend(header.modes[number]);
  };
  const setBackground = (dark) => {
    document.body.classList.toggle('dark', dark);
    scene.background = new Color(dark ? 0x14161a : 0xffffff);
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
  renderer.setAnimationLoop(() => {
    controls.update();
    renderer.render(scene, camera);
  });
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
