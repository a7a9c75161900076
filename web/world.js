// Flies over a world: tiles are asked for as they come near, and the server makes those that are
// not there. Tiles of heights are .r16, tiles of labels .glb.
"use strict";

const say = document.getElementById("say");
const canvas = document.querySelector("canvas");
const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });

const kAway = 4; // tiles around the one below that are shown
const kAtOnce = 2; // tiles that are asked for at once

const vertexShader = `#version 300 es
precision highp float;
uniform mat4 view;
uniform vec2 origin;
uniform float cell, cells, heights;
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 color;
out vec3 at, facing;
out vec4 shade;
out vec2 inTile;
void main() {
  vec3 p = position;
  if (heights > 0.0) {
    float n = cells + 1.0, id = float(gl_VertexID), row = floor(id / n);
    p = vec3((id - row * n) * cell, (cells - row) * cell, position.x);
  }
  inTile = p.xy / (cells * cell);
  at = p + vec3(origin, 0.0);
  facing = normal;
  shade = color;
  gl_Position = view * vec4(at, 1.0);
}`;
const fragmentShader = `#version 300 es
precision highp float;
uniform vec3 eye;
uniform float far, heights, borders;
uniform vec2 range;
uniform vec4 tint;
in vec3 at, facing;
in vec4 shade;
in vec2 inTile;
out vec4 result;
void main() {
  vec3 n = heights > 0.0 ? cross(dFdx(at), dFdy(at)) : facing;
  n = normalize(n);
  if (dot(n, eye - at) < 0.0) n = -n;
  vec3 color = tint.rgb * shade.rgb;
  if (heights > 0.0) {
    float h = clamp((at.z - range.x) / (range.y - range.x), 0.0, 1.0);
    vec3 low = vec3(0.42, 0.47, 0.27), middle = vec3(0.55, 0.47, 0.34), high = vec3(0.86, 0.85, 0.83);
    color = h < 0.5 ? mix(low, middle, h * 2.0) : mix(middle, high, h * 2.0 - 1.0);
    color = mix(vec3(0.45, 0.40, 0.35), color, smoothstep(0.55, 0.85, n.z));
  }
  float light = 0.42 + 0.62 * max(0.0, dot(n, normalize(vec3(-0.55, 0.55, 0.65))));
  color *= light;
  vec2 edge = min(inTile, 1.0 - inTile) / max(fwidth(inTile), 1e-6);
  if (borders > 0.0 && min(edge.x, edge.y) < 1.5) color = vec3(0.85, 0.1, 0.1);
  float fog = smoothstep(0.45, 1.0, distance(at.xy, eye.xy) / far);
  result = vec4(mix(pow(color, vec3(0.9)), vec3(0.725, 0.804, 0.878), fog), 1.0);
}`;

function program() {
  const made = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, vertexShader], [gl.FRAGMENT_SHADER, fragmentShader]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  return made;
}

function buffer(data, target = gl.ARRAY_BUFFER) {
  const made = gl.createBuffer();
  gl.bindBuffer(target, made);
  gl.bufferData(target, data, gl.STATIC_DRAW);
  return made;
}

let world, used, uniforms, gridIndices;
const tiles = new Map(); // "I,J" to what is drawn of it, or null while it is asked for
const camera = { x: 0, y: 0, z: 0, heading: 0.6, pitch: -0.35 };
let borders = false, flying = true, asked = 0, refusals = 0, wait = 0;

// Indices of a tile of heights: the same for all.
function makeGrid(cells) {
  const indices = new Uint32Array(6 * cells * cells), n = cells + 1;
  let at = 0;
  for (let y = 0; y < cells; ++y) {
    for (let x = 0; x < cells; ++x) {
      const a = y * n + x;
      indices.set([a, a + n, a + n + 1, a, a + n + 1, a + 1], at);
      at += 6;
    }
  }
  return { buffer: buffer(indices, gl.ELEMENT_ARRAY_BUFFER), count: indices.length };
}

function heightsTile(bytes) {
  const counts = new DataView(bytes), n = world.cells + 1, heights = new Float32Array(n * n);
  for (let k = 0; k < n * n; ++k)
    heights[k] = world.steps.offset + world.steps.size * counts.getUint16(2 * k, true);
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  const own = buffer(heights);
  gl.enableVertexAttribArray(0);
  gl.vertexAttribPointer(0, 1, gl.FLOAT, false, 0, 0);
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gridIndices.buffer);
  gl.bindVertexArray(null);
  return { heights, buffers: [own], parts: [{ array, count: gridIndices.count, type: gl.UNSIGNED_INT, offset: 0, tint: [1, 1, 1, 1] }] };
}

// The part of glTF that the program writes: one mesh of one or more primitives, y up.
function meshTile(bytes) {
  const view = new DataView(bytes), length = view.getUint32(12, true);
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, length)));
  const binary = 20 + length + 8;
  const shift = (json.nodes[0] || {}).translation || [0, 0, 0];
  const types = { 5121: [Uint8Array, 1], 5123: [Uint16Array, 2], 5125: [Uint32Array, 4], 5126: [Float32Array, 4] };
  const widths = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4 };
  const tile = { buffers: [], parts: [] };
  const values = (index) => {
    const a = json.accessors[index], v = json.bufferViews[a.bufferView], [Type, size] = types[a.componentType];
    const begin = binary + (v.byteOffset || 0) + (a.byteOffset || 0), count = a.count * widths[a.type];
    return new Type(bytes.slice(begin, begin + count * size));
  };
  const upright = (list, by) => {
    const turned = new Float32Array(list.length);
    for (let k = 0; k < list.length; k += 3) {
      turned[k] = list[k] + by[0];
      turned[k + 1] = -(list[k + 2] + by[2]);
      turned[k + 2] = list[k + 1] + by[1];
    }
    return turned;
  };
  const attribute = (place, data, width) => {
    const own = buffer(data);
    tile.buffers.push(own);
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, width, data instanceof Float32Array ? gl.FLOAT : gl.UNSIGNED_BYTE, true, 0, 0);
  };
  for (const primitive of json.meshes[0].primitives) {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    attribute(0, upright(values(primitive.attributes.POSITION), shift), 3);
    if (primitive.attributes.NORMAL !== undefined) attribute(1, upright(values(primitive.attributes.NORMAL), [0, 0, 0]), 3);
    const colors = primitive.attributes.COLOR_0;
    if (colors !== undefined) attribute(2, values(colors), widths[json.accessors[colors].type]);
    const indices = values(primitive.indices);
    const own = buffer(indices, gl.ELEMENT_ARRAY_BUFFER);
    tile.buffers.push(own);
    const material = (json.materials || [])[primitive.material] || {};
    const linear = (material.pbrMetallicRoughness || {}).baseColorFactor || [0.8, 0.8, 0.8, 1];
    tile.parts.push({ array, count: indices.length, type: indices instanceof Uint32Array ? gl.UNSIGNED_INT : gl.UNSIGNED_SHORT,
      tint: linear.map((c, k) => (k < 3 ? Math.pow(c, 1 / 2.2) : c)) });
  }
  gl.bindVertexArray(null);
  return tile;
}

async function ask(key, x, y) {
  tiles.set(key, null);
  ++asked;
  try {
    const answer = await fetch(`/tiles/0/${x}/${y}.${world.format}`);
    if (answer.ok) {
      const bytes = await answer.arrayBuffer();
      if (world.heights && !world.steps) {
        const beside = await (await fetch(`/tiles/0/${x}/${y}.${world.format}.json`)).json();
        world.steps = { size: beside.height_step, offset: beside.height_offset || 0 };
      }
      tiles.set(key, Object.assign(world.heights ? heightsTile(bytes) : meshTile(bytes), { x, y }));
      refusals = 0;
    } else {
      tiles.delete(key);
      refusals = answer.status;
      wait = performance.now() + 1000;
    }
  } catch (error) {
    tiles.delete(key);
    refusals = error.message;
    wait = performance.now() + 2000;
  }
  --asked;
}

function below() {
  return [Math.floor(camera.x / world.size[0]), Math.floor(camera.y / world.size[1])];
}

// Asks for the nearest tiles that are not there, and forgets those far away.
function stream() {
  const [i, j] = below();
  for (const [key, tile] of tiles) {
    if (tile && Math.max(Math.abs(tile.x - i), Math.abs(tile.y - j)) > kAway + 2) {
      tile.buffers.forEach((b) => gl.deleteBuffer(b));
      tile.parts.forEach((p) => gl.deleteVertexArray(p.array));
      tiles.delete(key);
    }
  }
  if (performance.now() < wait) return;
  const wanted = [];
  for (let x = i - kAway; x <= i + kAway; ++x) {
    for (let y = j - kAway; y <= j + kAway; ++y) {
      const dx = (x + 0.5) * world.size[0] - camera.x, dy = (y + 0.5) * world.size[1] - camera.y;
      const ahead = dx * Math.sin(camera.heading) + dy * Math.cos(camera.heading);
      const away = Math.hypot(dx, dy);
      if (!tiles.has(`${x},${y}`)) wanted.push([away - 0.4 * ahead, x, y]);
    }
  }
  wanted.sort((a, b) => a[0] - b[0]);
  for (const [, x, y] of wanted.slice(0, kAtOnce - asked)) ask(`${x},${y}`, x, y);
}

function matrix() {
  const far = kAway * Math.max(world.size[0], world.size[1]) * 1.2, near = far / 4000;
  const f = 1 / Math.tan(0.5), aspect = canvas.width / canvas.height;
  const ch = Math.cos(camera.heading), sh = Math.sin(camera.heading), cp = Math.cos(camera.pitch), sp = Math.sin(camera.pitch);
  const forward = [sh * cp, ch * cp, sp], right = [ch, -sh, 0];
  const up = [-sh * sp, -ch * sp, cp];
  const e = [camera.x - world.middle[0], camera.y - world.middle[1], camera.z];
  const dot = (a) => a[0] * e[0] + a[1] * e[1] + a[2] * e[2];
  const a = (far + near) / (near - far), b = (2 * far * near) / (near - far);
  const rows = [
    right.map((v) => (v * f) / aspect).concat((-dot(right) * f) / aspect),
    up.map((v) => v * f).concat(-dot(up) * f),
    forward.map((v) => -v * a).concat(dot(forward) * a + b),
    forward.concat(-dot(forward)),
  ];
  return { far, view: new Float32Array(16).map((_, k) => rows[k % 4][k >> 2]) };
}

function draw() {
  canvas.width = canvas.clientWidth * Math.min(2, devicePixelRatio);
  canvas.height = canvas.clientHeight * Math.min(2, devicePixelRatio);
  gl.viewport(0, 0, canvas.width, canvas.height);
  gl.clearColor(0.725, 0.804, 0.878, 1);
  gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  gl.enable(gl.DEPTH_TEST);
  // Around the tile below, so that floats stay fine far from the world's origin.
  const [i, j] = below();
  world.middle = [i * world.size[0], j * world.size[1]];
  const { far, view } = matrix();
  gl.useProgram(used);
  gl.uniformMatrix4fv(uniforms.view, false, view);
  gl.uniform3f(uniforms.eye, camera.x - world.middle[0], camera.y - world.middle[1], camera.z);
  gl.uniform1f(uniforms.far, far);
  gl.uniform1f(uniforms.heights, world.heights ? 1 : 0);
  gl.uniform1f(uniforms.borders, borders ? 1 : 0);
  gl.uniform1f(uniforms.cell, world.size[0] / world.cells);
  gl.uniform1f(uniforms.cells, world.cells);
  gl.uniform2f(uniforms.range, world.range[0], world.range[1]);
  gl.vertexAttrib4f(2, 1, 1, 1, 1);
  let shown = 0;
  for (const tile of tiles.values()) {
    if (!tile) continue;
    ++shown;
    gl.uniform2f(uniforms.origin, (tile.x - i) * world.size[0], (tile.y - j) * world.size[1]);
    for (const part of tile.parts) {
      gl.uniform4fv(uniforms.tint, part.tint);
      gl.bindVertexArray(part.array);
      gl.drawElements(gl.TRIANGLES, part.count, part.type, 0);
    }
  }
  say.textContent = `${world.example}, seed ${world.seed}: tile ${i},${j}; ${shown} tiles here` +
    (refusals ? `; the server says ${refusals}` : "") +
    "\ndrag to look, W A S D Q E to fly, space stops and goes on, B shows tiles";
  document.title = `${shown} tiles`;
}

const keys = new Set();
let last = 0;
function move(now) {
  const seconds = Math.min(0.1, (now - last) / 1000), speed = world.size[0] * (keys.has("ShiftLeft") ? 1.5 : 0.35) * seconds;
  last = now;
  const along = (keys.has("KeyW") || flying ? 1 : 0) - (keys.has("KeyS") ? 1 : 0);
  const aside = (keys.has("KeyD") ? 1 : 0) - (keys.has("KeyA") ? 1 : 0);
  const up = (keys.has("KeyE") ? 1 : 0) - (keys.has("KeyQ") ? 1 : 0);
  camera.x += speed * (along * Math.sin(camera.heading) + aside * Math.cos(camera.heading));
  camera.y += speed * (along * Math.cos(camera.heading) - aside * Math.sin(camera.heading));
  camera.z += 0.5 * speed * up;
  stream();
  draw();
  requestAnimationFrame(move);
}

async function begin() {
  if (!gl) {
    say.textContent = "This browser has no WebGL 2.";
    return;
  }
  world = await (await fetch("/world.json")).json();
  world.middle = [0, 0];
  used = program();
  uniforms = Object.fromEntries(["view", "origin", "cell", "cells", "heights", "eye", "far", "borders", "range", "tint"]
    .map((name) => [name, gl.getUniformLocation(used, name)]));
  if (world.heights) gridIndices = makeGrid(world.cells);
  const relief = world.range[1] - world.range[0];
  camera.x = camera.y = world.size[0] / 2;
  camera.z = world.heights ? world.range[1] + 0.25 * relief : world.range[1] + 0.3 * world.size[0];
  // #X,Y,Z,HEADING,PITCH,still: in tiles, and degrees.
  const given = location.hash.slice(1).split(",");
  if (given.length >= 5) {
    const [x, y, z, heading, pitch] = given.map(Number);
    Object.assign(camera, { x: x * world.size[0], y: y * world.size[1], z: z * world.size[0],
      heading: (heading * Math.PI) / 180, pitch: (pitch * Math.PI) / 180 });
  }
  if (given.includes("still")) flying = false;
  if (given.includes("borders")) borders = true;
  requestAnimationFrame(move);
}

addEventListener("keydown", (event) => {
  keys.add(event.code);
  if (event.code === "Space") flying = !flying;
  if (event.code === "KeyB") borders = !borders;
});
addEventListener("keyup", (event) => keys.delete(event.code));
canvas.addEventListener("pointermove", (event) => {
  if (!event.buttons) return;
  camera.heading -= event.movementX * 0.004;
  camera.pitch = Math.max(-1.5, Math.min(1.2, camera.pitch + event.movementY * 0.004));
});
begin().catch((error) => { say.textContent = String(error); });
