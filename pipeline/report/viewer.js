// SPDX-License-Identifier: AGPL-3.0-or-later
// The picture that turns: parts of a surface drawn by WebGL, each shown or hidden, coloured by part or by a solved
// quantity, cut by a plane. Its data (view.h) stand in the element #view-data; nothing is loaded.
(() => {
  "use strict";
  const figure = document.getElementById("view"), canvas = figure.querySelector("canvas");
  const data = JSON.parse(document.getElementById("view-data").textContent);
  const one = (selector) => figure.querySelector(selector);
  const gl = canvas.getContext("webgl", {antialias: true, alpha: false});
  if (!gl) {
    one(".lacking").hidden = false;
    canvas.hidden = true;
    return;
  }

  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const VERTEX = `
    attribute vec3 place; attribute vec4 normal; attribute float value;
    uniform mat4 turn, look; uniform vec3 middle;
    varying vec3 at, away; varying float amount;
    void main() {
      at = place;
      away = (turn * vec4(normal.xyz, 0.)).xyz;
      amount = value / 255.;
      gl_Position = look * turn * vec4(place - middle, 1.);
    }`;
  const FRAGMENT = `
    precision highp float;
    varying vec3 at, away; varying float amount;
    uniform vec3 colour; uniform vec4 cut; uniform sampler2D scale; uniform float scaled;
    void main() {
      if (dot(cut.xyz, at) > cut.w) discard;
      vec3 n = normalize(away + vec3(0., 0., 1e-6));
      if (n.z < 0.) n = -n;
      float light = .5 + .56 * max(dot(n, vec3(-.37, .46, .81)), 0.);
      vec3 base = mix(colour, texture2D(scale, vec2(amount * .996 + .002, .5)).rgb, scaled);
      gl_FragColor = vec4(min(base * light, 1.), 1.);
    }`;

  function shader(type, text) {
    const made = gl.createShader(type);
    gl.shaderSource(made, text);
    gl.compileShader(made);
    if (!gl.getShaderParameter(made, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(made));
    return made;
  }
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, VERTEX));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, FRAGMENT));
  gl.linkProgram(program);
  gl.useProgram(program);
  const uniform = (name) => gl.getUniformLocation(program, name);
  const uniforms = Object.fromEntries(
    ["turn", "look", "middle", "colour", "cut", "scale", "scaled"].map((name) => [name, uniform(name)]));

  // Points of a part as lengths in m.
  function pointsOf(part) {
    const raw = new Uint16Array(bytes(part.points).buffer), points = new Float32Array(raw.length);
    for (let k = 0; k < raw.length; k++) points[k] = data.least[k % 3] + raw[k] * data.step;
    return points;
  }

  // Corners with a normal each: the mean of the faces at the point that lie within 40 degrees of its own face.
  function cornersOf(points, index) {
    const faces = index.length / 3, normal = new Float32Array(index.length), mean = new Int8Array(index.length * 4);
    const first = new Uint32Array(points.length / 3 + 1), list = new Uint32Array(index.length), least = 0.766;
    for (let f = 0; f < faces; f++) {
      const [a, b, c] = [0, 1, 2].map((k) => 3 * index[3 * f + k]);
      for (let i = 0; i < 3; i++) {
        const j = (i + 1) % 3, k = (i + 2) % 3;
        normal[3 * f + i] = (points[b + j] - points[a + j]) * (points[c + k] - points[a + k]) -
                            (points[b + k] - points[a + k]) * (points[c + j] - points[a + j]);
      }
    }
    for (const point of index) first[point + 1]++;
    for (let k = 1; k < first.length; k++) first[k] += first[k - 1];
    const next = first.slice();
    index.forEach((point, corner) => { list[next[point]++] = Math.floor(corner / 3); });
    for (let corner = 0; corner < index.length; corner++) {
      const own = 3 * Math.floor(corner / 3), sum = [0, 0, 0];
      const size = Math.hypot(normal[own], normal[own + 1], normal[own + 2]);
      for (let k = first[index[corner]]; k < first[index[corner] + 1]; k++) {
        const f = 3 * list[k], dot = normal[f] * normal[own] + normal[f + 1] * normal[own + 1] +
                                     normal[f + 2] * normal[own + 2];
        if (dot < least * size * Math.hypot(normal[f], normal[f + 1], normal[f + 2])) continue;
        for (let i = 0; i < 3; i++) sum[i] += normal[f + i];
      }
      const length = Math.hypot(...sum) || 1;
      for (let i = 0; i < 3; i++) mean[4 * corner + i] = Math.round(127 * sum[i] / length);
    }
    return mean;
  }

  function buffer(array) {
    const made = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, made);
    gl.bufferData(gl.ARRAY_BUFFER, array, gl.STATIC_DRAW);
    return made;
  }

  function prepare(part) {
    const points = pointsOf(part), raw = bytes(part.corners).buffer;
    const index = part.wide ? new Uint32Array(raw) : new Uint16Array(raw);
    const places = new Float32Array(3 * index.length), least = [1e9, 1e9, 1e9], most = [-1e9, -1e9, -1e9];
    index.forEach((point, corner) => {
      for (let i = 0; i < 3; i++) {
        const x = points[3 * point + i];
        places[3 * corner + i] = x;
        least[i] = Math.min(least[i], x);
        most[i] = Math.max(most[i], x);
      }
    });
    part.count = index.length;
    part.box = [least, most];
    part.places = buffer(places);
    part.normals = buffer(cornersOf(points, index));
    part.amounts = part.values.map((text) => {
      if (!text) return null;
      const value = bytes(text), amounts = new Uint8Array(index.length);
      index.forEach((point, corner) => { amounts[corner] = value[point]; });
      return buffer(amounts);
    });
    part.points = part.corners = part.values = null;
  }
  data.parts.forEach(prepare);
  function boxOf(parts) {
    const filled = parts.filter((part) => part.count > 0);
    return [0, 1].map((end) => [0, 1, 2].map((i) => Math[end ? "max" : "min"](...filled.map((p) => p.box[end][i]))));
  }
  const radiusOf = (box) => Math.hypot(...box[0].map((x, i) => box[1][i] - x)) / 2;
  const shownFirst = data.parts.filter((part) => part.shown && part.count > 0);
  const whole = boxOf(data.parts), seen = shownFirst.length ? boxOf(shownFirst) : whole, [least, most] = whole;
  const middle = seen[0].map((x, i) => (x + seen[1][i]) / 2), radius = radiusOf(seen), reach = 2 * radiusOf(whole);

  // State of the view. turn: rows of the rotation from x, y, z to right, up, towards.
  const distance = 3.4 * radius + reach; // of the eye from the middle, m
  const state = {turn: null, extent: null, zoom: 1, shift: [0, 0], quantity: -1};
  // How far the corners of what is shown at first lie from the middle of the picture, to the right and up.
  function extentOf([right, up, towards]) {
    const extent = [0, 0], dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for (let corner = 0; corner < 8; corner++) {
      const x = middle.map((m, i) => seen[(corner >> i) & 1][i] - m), depth = distance - dot(towards, x);
      extent[0] = Math.max(extent[0], Math.abs(dot(right, x)) / depth);
      extent[1] = Math.max(extent[1], Math.abs(dot(up, x)) / depth);
    }
    return extent;
  }
  function face(towards, up) {
    const unit = (v) => v.map((x) => x / Math.hypot(...v));
    const cross = (a, b) => [0, 1, 2].map((i) => a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3]);
    const t = unit(towards), right = unit(cross(up, t));
    state.turn = [right, cross(t, right), t];
    state.extent = extentOf(state.turn);
    state.zoom = 1;
    state.shift = [0, 0];
  }
  // As the other pictures are turned (picture_list.c); data.suction: the sign of z on the suction side.
  const {suction} = data;
  const views = {home: [[-0.95, 0.1, suction], [1, 0, 0]], suction: [[0, 0, suction], [1, 0, 0]],
                 back: [[0, 0, -suction], [1, 0, 0]], side: [[0, -1, 0], [0, 0, suction]]};

  // Turns about the axes of the screen.
  function rotate(dx, dy) {
    const about = (a, b, angle) => {
      const c = Math.cos(angle), s = Math.sin(angle), [p, q] = [state.turn[a], state.turn[b]];
      state.turn[a] = p.map((x, i) => c * x + s * q[i]);
      state.turn[b] = q.map((x, i) => c * x - s * p[i]);
    };
    about(0, 2, dx);
    about(1, 2, -dy);
  }

  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  const scale = bytes(data.scale);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, scale.length / 3, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, scale);
  for (const [name, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
                               [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
    gl.texParameteri(gl.TEXTURE_2D, name, value);

  function attribute(name, source, size, type, normalised) {
    const at = gl.getAttribLocation(program, name);
    if (!source) {
      gl.disableVertexAttribArray(at);
      gl.vertexAttrib4f(at, 0, 0, 1, 0);
      return;
    }
    gl.bindBuffer(gl.ARRAY_BUFFER, source);
    gl.enableVertexAttribArray(at);
    gl.vertexAttribPointer(at, size, type, normalised, 0, 0);
  }

  // The plane of the cut: what lies beyond it along its normal is left out.
  function cutPlane() {
    const axis = ["x", "y", "z"].indexOf(one("[name=cut]").value);
    if (axis < 0) return [0, 0, 0, 1];
    const sign = one("[name=flip]").checked ? -1 : 1, share = one("[name=place]").valueAsNumber / 1000;
    const plane = [0, 0, 0, sign * (least[axis] + share * (most[axis] - least[axis]))];
    plane[axis] = sign;
    return plane;
  }

  function draw() {
    const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    const [r, u, t] = state.turn, eye = distance, near = eye - reach, far = eye + reach, sides = width / height;
    const focus = 0.97 * state.zoom * Math.min(sides / state.extent[0], 1 / state.extent[1]);
    gl.uniformMatrix4fv(uniforms.turn, false, [r[0], u[0], t[0], 0, r[1], u[1], t[1], 0, r[2], u[2], t[2], 0,
                                               0, 0, 0, 1]);
    gl.uniformMatrix4fv(uniforms.look, false, [focus / sides, 0, 0, 0, 0, focus, 0, 0,
      -state.shift[0] / sides, -state.shift[1], -(far + near) / (far - near), -1,
      state.shift[0] * eye / sides, state.shift[1] * eye, ((far + near) * eye - 2 * far * near) / (far - near), eye]);
    gl.uniform3fv(uniforms.middle, middle);
    gl.uniform4fv(uniforms.cut, cutPlane());
    gl.uniform1i(uniforms.scale, 0);
    for (const part of data.parts) {
      if (!part.shown) continue;
      const amounts = part.amounts[state.quantity];
      gl.uniform3fv(uniforms.colour, [16, 8, 0].map((bits) => ((part.colour >> bits) & 255) / 255));
      gl.uniform1f(uniforms.scaled, amounts ? 1 : 0);
      attribute("place", part.places, 3, gl.FLOAT, false);
      attribute("normal", part.normals, 4, gl.BYTE, true);
      attribute("value", amounts, 1, gl.UNSIGNED_BYTE, false);
      gl.drawArrays(gl.TRIANGLES, 0, part.count);
    }
    figure.dataset.drawn = Number(figure.dataset.drawn || 0) + 1;
  }
  let asked = false;
  function redraw() {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => { asked = false; draw(); });
  }

  // One pointer turns, with Shift or the right button it shifts; two pointers shift and zoom.
  const pointers = new Map();
  const spread = () => { const [a, b] = [...pointers.values()]; return Math.hypot(a.x - b.x, a.y - b.y); };
  function zoomBy(factor) {
    state.zoom = Math.min(Math.max(state.zoom * factor, 0.3), 60);
  }
  canvas.addEventListener("pointerdown", (event) => {
    try { canvas.setPointerCapture(event.pointerId); } catch { /* a pointer that is gone by now */ }
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.x, dy = event.clientY - before.y, half = canvas.clientHeight / 2;
    const gap = pointers.size === 2 ? spread() : 0, share = 1 / pointers.size;
    pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    if (pointers.size === 2 && gap > 0) zoomBy(spread() / gap);
    if (pointers.size === 2 || event.shiftKey || event.buttons === 2) {
      state.shift[0] += share * dx / half;
      state.shift[1] -= share * dy / half;
    } else rotate(dx / half * 1.5 / Math.sqrt(state.zoom), dy / half * 1.5 / Math.sqrt(state.zoom));
    redraw();
  });
  for (const name of ["pointerup", "pointercancel"])
    canvas.addEventListener(name, (event) => pointers.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    const before = state.zoom;
    zoomBy(Math.exp(-0.0015 * event.deltaY));
    state.shift = state.shift.map((x) => x * state.zoom / before);
    redraw();
  }, {passive: false});
  const TURNS = {ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1]};
  canvas.addEventListener("keydown", (event) => {
    if (TURNS[event.key]) rotate(...TURNS[event.key]);
    else if (event.key === "+" || event.key === "-") zoomBy(event.key === "+" ? 1.15 : 1 / 1.15);
    else return;
    event.preventDefault();
    redraw();
  });

  // Controls.
  for (const button of figure.querySelectorAll("[data-view]"))
    button.addEventListener("click", () => { face(...views[button.dataset.view]); redraw(); });
  for (const name of ["cut", "place", "flip"]) one(`[name=${name}]`).addEventListener("input", () => {
    one(".cut").classList.toggle("off", !one("[name=cut]").value);
    redraw();
  });
  const boxes = figure.querySelectorAll("[data-part]");
  for (const box of boxes) box.addEventListener("change", () => {
    data.parts[box.dataset.part].shown = box.checked;
    redraw();
  });
  for (const button of figure.querySelectorAll("[data-zone]")) button.addEventListener("click", () => {
    const own = [...boxes].filter((box) => box.closest("fieldset") === button.closest("fieldset"));
    const shown = own.some((box) => !box.checked);
    for (const box of own) data.parts[box.dataset.part].shown = box.checked = shown;
    redraw();
  });
  const colour = one("[name=colour]");
  function recolour() {
    state.quantity = colour ? Number(colour.value) : -1;
    for (const bar of figure.querySelectorAll("[data-bar]")) bar.hidden = Number(bar.dataset.bar) !== state.quantity;
    redraw();
  }
  if (colour) colour.addEventListener("input", recolour);
  window.addEventListener("resize", redraw);
  canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
  face(...views.home);
  recolour();
})();
