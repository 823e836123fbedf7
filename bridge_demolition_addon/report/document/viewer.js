// SPDX-License-Identifier: GPL-3.0-or-later
// Shows the animated models of a report (glTF 2.0, GLB, packed by gzip, in base64) by WebGL. Nothing is loaded.
"use strict";

const SHADERS = [
  ["VERTEX_SHADER", `
attribute vec3 place, normal;
uniform mat4 view; uniform vec4 turn; uniform vec3 move;
varying vec3 upright;
vec3 turned(vec3 v) { return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v); }
void main() { upright = turned(normal); gl_Position = view * vec4(turned(place) + move, 1.0); }`],
  ["FRAGMENT_SHADER", `
precision mediump float;
uniform vec3 colour; varying vec3 upright;
void main() {
  float light = 0.62 + 0.38 * dot(normalize(upright), normalize(vec3(0.35, -0.45, 0.82)));
  gl_FragColor = vec4(pow(colour * light, vec3(1.0 / 2.2)), 1.0);
}`],
];
const WIDTHS = {SCALAR: 1, VEC3: 3, VEC4: 4};
const FIELD_OF_VIEW = 0.7;

async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

// The bodies of a model: triangles with their normals, colour, and keys of motion.
function bodiesOf(buffer) {
  const textLength = new DataView(buffer).getUint32(12, true);
  const model = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 20, textLength)));
  const values = number => {
    const accessor = model.accessors[number], view = model.bufferViews[accessor.bufferView];
    const kind = accessor.componentType === 5126 ? Float32Array : Uint32Array;
    return new kind(buffer, 28 + textLength + view.byteOffset, accessor.count * WIDTHS[accessor.type]);
  };
  const bodies = model.nodes.map(node => ({node, keys: {}}));
  for (const animation of model.animations || [])
    for (const channel of animation.channels) {
      const sampler = animation.samplers[channel.sampler];
      const keys = {times: values(sampler.input), values: values(sampler.output)};
      bodies[channel.target.node].keys[channel.target.path] = keys;
    }
  return bodies.filter(body => "mesh" in body.node).map(body => {
    const primitive = model.meshes[body.node.mesh].primitives[0], material = model.materials[primitive.material];
    const corners = cornersOf(values(primitive.attributes.POSITION), values(primitive.indices));
    return {...body, corners, kind: material.name, colour: material.pbrMetallicRoughness.baseColorFactor.slice(0, 3)};
  });
}

function cornersOf(places, indices) {
  const corners = new Float32Array(indices.length * 6);
  for (let first = 0; first < indices.length; first += 3) {
    const [a, b, c] = [0, 1, 2].map(corner => places.subarray(3 * indices[first + corner], 3 * indices[first + corner] + 3));
    const normal = unit(cross(minus(b, a), minus(c, a)));
    [a, b, c].forEach((place, corner) => { corners.set(place, 6 * (first + corner)); corners.set(normal, 6 * (first + corner) + 3); });
  }
  return corners;
}

const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = v => { const length = Math.hypot(...v) || 1; return v.map(each => each / length); };

// The value of keys at a time, in a straight line from key to key.
function valueAt(keys, width, time) {
  const {times, values} = keys;
  let low = 0, high = times.length - 1;
  while (high - low > 1) { const middle = (low + high) >> 1; if (times[middle] <= time) low = middle; else high = middle; }
  const share = Math.min(1, Math.max(0, (time - times[low]) / (times[high] - times[low])));
  return Array.from({length: width}, (_, k) => values[width * low + k] * (1 - share) + values[width * high + k] * share);
}

function placed(body, time) {
  const {translation, rotation} = body.keys;
  return {
    move: translation ? valueAt(translation, 3, time) : body.node.translation,
    turn: rotation ? unit(valueAt(rotation, 4, time)) : body.node.rotation,
  };
}

// Column by column: a camera that looks from a place to a point, z up.
function viewOf(eye, target, aspect, near, far) {
  const back = unit(minus(eye, target)), right = unit(cross([0, 0, 1], back)), up = cross(back, right);
  const moved = axis => -(axis[0] * eye[0] + axis[1] * eye[1] + axis[2] * eye[2]);
  const wide = 1 / Math.tan(FIELD_OF_VIEW / 2), x = wide / aspect, deep = (far + near) / (near - far);
  const rows = [
    [...right.map(each => each * x), moved(right) * x],
    [...up.map(each => each * wide), moved(up) * wide],
    [...back.map(each => each * deep), moved(back) * deep + 2 * far * near / (near - far)],
    [...back.map(each => -each), -moved(back)],
  ];
  return [0, 1, 2, 3].flatMap(column => rows.map(row => row[column]));
}

function programOf(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of SHADERS) {
    const shader = gl.createShader(gl[kind]);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}

// What is seen of the bridge at first: all but the ground.
function cameraFor(bodies) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  const seen = bodies.filter(body => body.kind !== "ground");
  for (const body of seen.length ? seen : bodies)
    body.node.translation.forEach((each, axis) => { low[axis] = Math.min(low[axis], each); high[axis] = Math.max(high[axis], each); });
  const size = Math.max(Math.hypot(...minus(high, low)), 5);
  return {target: low.map((each, axis) => (each + high[axis]) / 2), around: -1.0, above: 0.45, away: 1.5 * size};
}

function follow(canvas, camera, redraw) {
  canvas.onpointerdown = event => canvas.setPointerCapture(event.pointerId);
  canvas.onpointermove = event => {
    if (!event.buttons) return;
    if (event.shiftKey || event.buttons !== 1) {
      const scale = camera.away / canvas.clientHeight, sine = Math.sin(camera.around), cosine = Math.cos(camera.around);
      camera.target[0] += scale * (event.movementX * sine - event.movementY * cosine * Math.sin(camera.above));
      camera.target[1] += scale * (-event.movementX * cosine - event.movementY * sine * Math.sin(camera.above));
      camera.target[2] += scale * event.movementY * Math.cos(camera.above);
    } else {
      camera.around -= 0.008 * event.movementX;
      camera.above = Math.min(1.55, Math.max(-0.2, camera.above + 0.008 * event.movementY));
    }
    redraw();
  };
  canvas.oncontextmenu = event => event.preventDefault();
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    camera.away *= Math.exp(0.001 * event.deltaY);
    redraw();
  }, {passive: false});
}

async function show(figure) {
  const find = name => figure.querySelector(name);
  const canvas = find("canvas"), button = find("button"), slider = find("input"), slow = find("select"), said = find("output");
  const gl = canvas.getContext("webgl");
  if (!gl) throw new Error("this browser has no WebGL");
  const bodies = bodiesOf(await unpacked(figure.dataset.model)), program = programOf(gl), camera = cameraFor(bodies);
  const at = Object.fromEntries(["view", "turn", "move", "colour"].map(name => [name, gl.getUniformLocation(program, name)]));
  gl.useProgram(program);
  gl.enable(gl.DEPTH_TEST);
  for (const body of bodies) {
    body.buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, body.buffer);
    gl.bufferData(gl.ARRAY_BUFFER, body.corners, gl.STATIC_DRAW);
  }
  const end = Math.max(0, ...bodies.flatMap(body => Object.values(body.keys).map(keys => keys.times[keys.times.length - 1])));
  slider.max = end;

  function draw() {
    canvas.width = canvas.clientWidth * devicePixelRatio;
    canvas.height = canvas.clientHeight * devicePixelRatio;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(0.86, 0.90, 0.94, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const {around, above, away, target} = camera;
    const from = [Math.cos(around) * Math.cos(above), Math.sin(around) * Math.cos(above), Math.sin(above)];
    const eye = target.map((each, axis) => each + away * from[axis]);
    gl.uniformMatrix4fv(at.view, false, viewOf(eye, target, canvas.width / canvas.height, away / 100, away * 50));
    for (const body of bodies) {
      const {move, turn} = placed(body, +slider.value);
      gl.uniform3fv(at.move, move);
      gl.uniform4fv(at.turn, turn);
      gl.uniform3fv(at.colour, body.colour);
      gl.bindBuffer(gl.ARRAY_BUFFER, body.buffer);
      ["place", "normal"].forEach((name, number) => {
        const location = gl.getAttribLocation(program, name);
        gl.enableVertexAttribArray(location);
        gl.vertexAttribPointer(location, 3, gl.FLOAT, false, 24, 12 * number);
      });
      gl.drawArrays(gl.TRIANGLES, 0, body.corners.length / 6);
    }
    said.textContent = `${(+slider.value).toFixed(2)} s of ${end.toFixed(2)} s`;
    figure.dataset.bodies = bodies.length;
  }

  let waits = false, plays = false, last = 0;
  const redraw = () => { if (!waits) { waits = true; requestAnimationFrame(tick); } };
  function tick(now) {
    waits = false;
    if (plays) {
      slider.value = Math.min(end, +slider.value + (now - last) / 1000 / +slow.value);
      if (+slider.value >= end) stop();
      else redraw();
    }
    last = now;
    draw();
  }
  function stop() { plays = false; button.textContent = button.dataset.play; }
  button.onclick = () => {
    if (plays) { stop(); return; }
    if (+slider.value >= end) slider.value = 0;
    plays = true;
    last = performance.now();
    button.textContent = button.dataset.stop;
    redraw();
  };
  slider.oninput = () => { stop(); redraw(); };
  window.addEventListener("resize", redraw);
  follow(canvas, camera, redraw);
  draw();
}

for (const figure of document.querySelectorAll("figure[data-model]"))
  show(figure).catch(error => { figure.querySelector("output").textContent = `The model cannot be shown: ${error.message}.`; });
