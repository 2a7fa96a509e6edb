// Draws a state of a scene onto the canvas.

const SHADOW_SIZE = 2048;
const SUN = unit(LAMP);
const LINE_FLOATS = 12;

const LOOKS = {
  light: {
    clear: [0.915, 0.925, 0.935],
    sun: [0.66, 0.64, 0.60], sky: [0.40, 0.42, 0.45], ground: [0.20, 0.19, 0.18],
  },
  dark: {
    clear: [0.075, 0.086, 0.10],
    sun: [0.54, 0.52, 0.50], sky: [0.26, 0.28, 0.32], ground: [0.11, 0.105, 0.10],
  },
};

const PATH_COLORS = { base: [0.09, 0.45, 0.80, 0.9], left: [0.10, 0.62, 0.42, 0.9], right: [0.62, 0.32, 0.76, 0.9] };

const DEFAULT_LAYERS = { paths: true, camera: true, contacts: true, forces: false, maps: true, shadows: true, frames: false };

class Stage {
  constructor(canvas, scene) {
    this.canvas = canvas;
    this.scene = scene;
    const gl = canvas.getContext('webgl2', { antialias: true, alpha: false, powerPreference: 'high-performance' });
    if (!gl) throw new Error('This browser has no WebGL 2, which the view needs.');
    this.gl = gl;
    this.body = program(gl, BODY_VERTEX, BODY_FRAGMENT);
    this.shadow = program(gl, SHADOW_VERTEX, SHADOW_FRAGMENT);
    this.pick = program(gl, PICK_VERTEX, PICK_FRAGMENT);
    this.floor = program(gl, FLOOR_VERTEX, FLOOR_FRAGMENT);
    this.line = program(gl, LINE_VERTEX, LINE_FRAGMENT);
    this.layers = { ...DEFAULT_LAYERS };
    // On slow machines moving pictures are drawn coarser, in steps; still ones are not.
    this.coarse = 0;
    this.light = product(orthographic(6.2, 0.5, 26), lookingFrom(add([-0.6, 0.6, 0], times(SUN, 13)), [-0.6, 0.6, 0], [0, 0, 1]));
    this.makeShadowMap();
    this.makeFloor();
    this.makeLines();
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
  }

  makeShadowMap() {
    const { gl } = this;
    this.shadowMap = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.shadowMap);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.DEPTH_COMPONENT24, SHADOW_SIZE, SHADOW_SIZE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, filter, gl.LINEAR);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
    this.shadowBuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowBuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, this.shadowMap, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  makeFloor() {
    const { gl } = this;
    this.floorArray = gl.createVertexArray();
    gl.bindVertexArray(this.floorArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, 1, 1, -1, -1, 1, 1, -1, 1]), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(0);
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
  }

  makeLines() {
    const { gl } = this;
    this.lineArray = gl.createVertexArray();
    this.lineBuffer = gl.createBuffer();
    gl.bindVertexArray(this.lineArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lineBuffer);
    [[3, 0], [3, 12], [4, 24], [2, 40]].forEach(([size, offset], place) => {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, gl.FLOAT, false, LINE_FLOATS * 4, offset);
    });
  }

  // Uploads a mesh to the graphics card.
  load({ id, corners, indices }) {
    const node = this.scene.nodes.get(id);
    if (!node || !indices.length || node.mesh) return;
    const { gl } = this;
    const array = gl.createVertexArray();
    const buffers = [gl.createBuffer(), gl.createBuffer()];
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers[0]);
    gl.bufferData(gl.ARRAY_BUFFER, corners, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers[1]);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
    const parts = [[3, gl.FLOAT, false, 0], [3, gl.BYTE, true, 12], [1, gl.UNSIGNED_BYTE, true, 15], [4, gl.UNSIGNED_BYTE, true, 16]];
    parts.forEach(([size, type, normed, offset], place) => {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribPointer(place, size, type, normed, 20, offset);
    });
    gl.bindVertexArray(null);
    const points = new DataView(corners.buffer, corners.byteOffset, corners.byteLength);
    const least = [Infinity, Infinity, Infinity], most = [-Infinity, -Infinity, -Infinity];
    for (let at = 0; at < corners.byteLength; at += 20) {
      for (let axis = 0; axis < 3; axis++) {
        const v = points.getFloat32(at + axis * 4, true);
        least[axis] = Math.min(least[axis], v);
        most[axis] = Math.max(most[axis], v);
      }
    }
    node.mesh = { array, buffers, count: indices.length, middle: between(least, most, 0.5), top: most[2] };
  }

  // Frees the mesh of a node.
  unload(node) {
    if (!node.mesh) return;
    this.gl.deleteVertexArray(node.mesh.array);
    node.mesh.buffers.forEach((buffer) => this.gl.deleteBuffer(buffer));
    node.mesh = null;
  }

  // The nodes visible in a state, with their poses.
  seen(state) {
    const seen = [];
    for (const node of this.scene.nodes.values()) {
      const place = this.scene.place(node, state);
      if (!node.mesh || !place || page.hidden.has(node.id)) continue;
      if (this.layers.maps || node.type !== MAP_TYPE) seen.push([node, place]);
    }
    return seen;
  }

  resize(isFine) {
    const scale = isFine ? 1 : [1, 1, 0.75, 0.5][this.coarse];
    const ratio = Math.min(window.devicePixelRatio || 1, 2) * scale;
    const width = Math.max(1, Math.round(this.canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.canvas.clientHeight * ratio));
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
    }
  }

  // The projection matrix for an eye.
  projection(fov, eyeMatrix) {
    const aspect = this.canvas.width / this.canvas.height;
    return product(perspective(fov, aspect, 0.05, 70), eyeMatrix);
  }

  draw(state, { eye, view, selected, isFine, isThroughCamera }) {
    const { gl } = this;
    const hasShadows = this.layers.shadows && (isFine || !this.coarse);
    const bodies = this.seen(state).map(([node, place]) => [node, matrixOf(place)]);
    if (hasShadows) this.drawShadows(bodies);
    gl.viewport(0, 0, this.canvas.width, this.canvas.height);
    this.drawInto(state, { eye, view, selected, hasShadows, bodies });
    this.drawLines(this.linesOf(state, selected, isThroughCamera), view);
    // What presses from below a table would be hidden in it.
    if (!this.layers.forces) return;
    gl.disable(gl.DEPTH_TEST);
    this.drawLines(forcesOf(state).flatMap(arrowOf), view);
    gl.enable(gl.DEPTH_TEST);
  }

  // Draws bodies and floor into the viewport; shadows have been drawn before.
  drawInto(state, { eye, view, selected, hasShadows, bodies = this.seen(state).map(([node, place]) => [node, matrixOf(place)]) }) {
    const { gl } = this;
    const look = matchMedia('(prefers-color-scheme: dark)').matches ? LOOKS.dark : LOOKS.light;
    gl.clearColor(...look.clear, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    const lit = ({ made, places }) => {
      gl.useProgram(made);
      gl.uniformMatrix4fv(places.view, false, view);
      gl.uniformMatrix4fv(places.light, false, this.light);
      gl.uniform1i(places.shadowMap, 0);
      gl.uniform1f(places.shadows, hasShadows ? 1 : 0);
      gl.uniform3fv(places.sun, SUN);
      gl.uniform3fv(places.sunColor, look.sun);
      gl.uniform3fv(places.skyColor, look.sky);
      gl.uniform3fv(places.groundColor, look.ground);
      gl.uniform3fv(places.eye, eye);
    };
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.shadowMap);
    lit(this.body);
    const tints = this.tints(state, selected);
    for (const [node, matrix] of bodies) {
      gl.uniformMatrix4fv(this.body.places.model, false, matrix);
      gl.uniform4fv(this.body.places.tint, tints.get(node.id) || [0, 0, 0, 0]);
      gl.bindVertexArray(node.mesh.array);
      gl.drawElements(gl.TRIANGLES, node.mesh.count, gl.UNSIGNED_INT, 0);
    }
    lit(this.floor);
    gl.uniform3fv(this.floor.places.far, look.clear);
    gl.bindVertexArray(this.floorArray);
    gl.drawArrays(gl.TRIANGLES, 0, 6);
  }

  drawShadows(bodies) {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.shadowBuffer);
    gl.viewport(0, 0, SHADOW_SIZE, SHADOW_SIZE);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.POLYGON_OFFSET_FILL);
    gl.polygonOffset(2.5, 4);
    gl.useProgram(this.shadow.made);
    gl.uniformMatrix4fv(this.shadow.places.light, false, this.light);
    for (const [node, matrix] of bodies) {
      gl.uniformMatrix4fv(this.shadow.places.model, false, matrix);
      gl.bindVertexArray(node.mesh.array);
      gl.drawElements(gl.TRIANGLES, node.mesh.count, gl.UNSIGNED_INT, 0);
    }
    gl.disable(gl.POLYGON_OFFSET_FILL);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  }

  tints(state, selected) {
    const tints = new Map();
    if (this.layers.contacts) {
      for (const { body, object } of this.handled(state)) for (const id of [body, object]) tints.set(id, [0.95, 0.60, 0.10, 0.30]);
      for (const id of state.hits.flatMap((hit) => hit.nodes)) tints.set(id, [0.90, 0.08, 0.05, 0.65]);
    }
    for (const id of page.marked?.ids ?? []) tints.set(id, [0.98, 0.62, 0.05, 0.50]);
    if (selected !== null) tints.set(selected, [0.12, 0.45, 0.95, 0.30]);
    return tints;
  }

  // The lines to draw: from, to, colour.
  linesOf(state, selected, isThroughCamera) {
    const lines = [];
    const axes = (place, size) => {
      [[1, 0, 0], [0, 1, 0], [0, 0, 1]].forEach((axis, i) => {
        const color = [[0.85, 0.15, 0.12, 1], [0.13, 0.60, 0.20, 1], [0.12, 0.32, 0.85, 1]][i];
        lines.push([place.slice(0, 3), placed(place, times(axis, size)), color]);
      });
    };
    if (state.axes.length) axes(placeOf(state.axes, 0), state.axes[7] * METRE);
    if (page.measured?.length === 2) lines.push([...page.measured, [0.98, 0.45, 0.05, 1]]);
    for (const at of page.measured ?? []) lines.push(...marked(at, 0.02, [0.98, 0.45, 0.05, 1]));
    if (this.layers.frames) {
      for (const one of this.scene.nodes.values()) {
        const place = one.kind !== 'furniture' && this.scene.place(one, state);
        if (!place) continue;
        axes(place, 0.07);
        const parent = this.scene.nodes.get(one.parent);
        const carrier = parent && this.scene.place(parent, state);
        if (carrier) lines.push([carrier.slice(0, 3), place.slice(0, 3), [0.9, 0.75, 0.1, 0.7]]);
      }
    }
    const node = selected === null ? null : this.scene.nodes.get(selected);
    const where = node && this.scene.place(node, state);
    if (where) axes(where, 0.18);
    if (this.layers.paths) {
      for (const path of state.paths) {
        const frame = path.frame < 0 ? null : state.places.get(path.frame);
        const points = frame ? path.points.map((p) => placed(frame, p)) : path.points;
        for (let i = 1; i < points.length; i++) lines.push([points[i - 1], points[i], PATH_COLORS[path.what]]);
      }
    }
    if (this.layers.camera && this.camera && !isThroughCamera) lines.push(...this.frustum(state));
    if (this.layers.contacts) {
      for (const hit of state.hits) lines.push(...marked(times(hit.at, METRE), 0.06, [0.9, 0.08, 0.05, 1]));
      for (const { at } of state.touch) lines.push(...marked(at, 0.012, [0.95, 0.60, 0.10, 1]));
    }
    return lines;
  }

  // The contacts between the robot and objects.
  handled(state) { return state.touch.filter(({ body }) => this.scene.nodes.get(body)?.kind === 'robot'); }

  frustum(state) {
    const { node, fov, aspect, near, far } = this.camera;
    const place = state.places.get(node);
    if (!place) return [];
    const color = [0.95, 0.62, 0.12, 0.55];
    const corner = (z, x, y) => placed(place, [x * z * Math.tan(fov / 2) * aspect, y * z * Math.tan(fov / 2), z]);
    const signs = [[-1, -1], [1, -1], [1, 1], [-1, 1]];
    const lines = [];
    signs.forEach(([x, y], i) => {
      const [nx, ny] = signs[(i + 1) % 4];
      lines.push([corner(near, x, y), corner(far, x, y), color]);
      lines.push([corner(far, x, y), corner(far, nx, ny), color]);
    });
    return lines;
  }

  drawLines(lines, view) {
    if (!lines.length) return;
    const { gl } = this;
    const corners = [[0, 0], [1, 0], [1, 1], [0, 0], [1, 1], [0, 1]];
    const numbers = new Float32Array(lines.length * 6 * LINE_FLOATS);
    let at = 0;
    for (const [from, to, color] of lines) {
      for (const corner of corners) {
        numbers.set(from, at);
        numbers.set(to, at + 3);
        numbers.set(color, at + 6);
        numbers.set(corner, at + 10);
        at += LINE_FLOATS;
      }
    }
    gl.useProgram(this.line.made);
    gl.uniformMatrix4fv(this.line.places.view, false, view);
    gl.uniform2f(this.line.places.size, this.canvas.width, this.canvas.height);
    gl.uniform1f(this.line.places.width, 2.4 * this.canvas.width / Math.max(1, this.canvas.clientWidth));
    gl.bindVertexArray(this.lineArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.lineBuffer);
    gl.bufferData(gl.ARRAY_BUFFER, numbers, gl.STREAM_DRAW);
    gl.enable(gl.BLEND);
    gl.disable(gl.CULL_FACE);
    gl.blendFunc(gl.SRC_ALPHA, gl.ONE_MINUS_SRC_ALPHA);
    gl.drawArrays(gl.TRIANGLES, 0, lines.length * 6);
    gl.disable(gl.BLEND);
    gl.enable(gl.CULL_FACE);
  }

  // The node seen at a point of the canvas (pixels of the page), and the point on it (m).
  at(state, view, x, y) {
    const { gl, canvas } = this;
    const ratio = canvas.width / canvas.clientWidth;
    const column = Math.floor(x * ratio), row = canvas.height - 1 - Math.floor(y * ratio);
    const buffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, buffer);
    const made = [gl.RGBA8, gl.RGBA8, gl.DEPTH_COMPONENT24].map((format, i) => {
      const store = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, store);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, canvas.width, canvas.height);
      const place = i === 2 ? gl.DEPTH_ATTACHMENT : gl.COLOR_ATTACHMENT0 + i;
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, store);
      return store;
    });
    gl.drawBuffers([gl.COLOR_ATTACHMENT0, gl.COLOR_ATTACHMENT1]);
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(column, row, 1, 1);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.useProgram(this.pick.made);
    gl.uniformMatrix4fv(this.pick.places.view, false, view);
    for (const [node, place] of this.seen(state)) {
      gl.uniformMatrix4fv(this.pick.places.model, false, matrixOf(place));
      gl.uniform1f(this.pick.places.id, node.id);
      gl.bindVertexArray(node.mesh.array);
      gl.drawElements(gl.TRIANGLES, node.mesh.count, gl.UNSIGNED_INT, 0);
    }
    const read = (place) => {
      const bytes = new Uint8Array(4);
      gl.readBuffer(gl.COLOR_ATTACHMENT0 + place);
      gl.readPixels(column, row, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
      return bytes[3] ? bytes[0] + bytes[1] * 256 + bytes[2] * 65536 : null;
    };
    const [id, depth] = [read(0), read(1)];
    gl.disable(gl.SCISSOR_TEST);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    made.forEach((store) => gl.deleteRenderbuffer(store));
    gl.deleteFramebuffer(buffer);
    if (id === null) return null;
    // The distance along the view.
    const near = 0.05, far = 70, z = depth / 16777215 * 2 - 1;
    return { id, away: 2 * near * far / (far + near - z * (far - near)) };
  }
}
