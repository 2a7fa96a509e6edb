// What the robot's camera sees, in a corner: colours, distances, or what belongs together.

const MODES = ['colour', 'depth', 'segments'];

const FLAT_FRAGMENT = HEAD + `
uniform vec3 hue;
uniform float isDepth;
out vec4 result;
void main() {
  float away = 1.0 / gl_FragCoord.w;
  // From warm to cold within five metres, with a line at every half metre.
  float share = clamp(away / 5.0, 0.0, 1.0);
  vec3 heat = mix(mix(vec3(0.98, 0.93, 0.60), vec3(0.89, 0.35, 0.29), smoothstep(0.0, 0.4, share)), vec3(0.13, 0.07, 0.35), smoothstep(0.35, 1.0, share));
  float line = fract(away * 2.0);
  heat *= 1.0 - 0.18 * step(line, fwidth(away) * 2.0);
  result = vec4(mix(hue, heat, isDepth), 1.0);
}`;

class Inset {
  constructor(figure, stage) {
    Object.assign(this, { figure, stage, mode: null });
    this.flat = program(stage.gl, PICK_VERTEX, FLAT_FRAGMENT);
    for (const mode of MODES) {
      const button = pushButton(mode, `Show: ${mode}`, () => this.show(mode));
      button.dataset.mode = mode;
      figure.lastElementChild.append(button);
    }
    const close = pushButton('×', 'Close', () => this.show(null));
    close.setAttribute('aria-label', 'Close');
    figure.lastElementChild.append(close);
  }

  show(mode) {
    this.mode = mode;
    this.figure.hidden = !mode;
    insetButton.setAttribute('aria-pressed', String(!!mode));
    for (const button of this.figure.querySelectorAll('[data-mode]')) button.setAttribute('aria-pressed', String(button.dataset.mode === mode));
    page.isDirty = true;
  }

  // Draws into the corner of the picture that the figure frames.
  draw(state) {
    const { camera } = this.stage;
    const place = this.mode && camera && state.places.get(camera.node);
    if (!place) return;
    const { gl, canvas } = this.stage;
    const [outer, frame] = [canvas.getBoundingClientRect(), this.figure.firstElementChild.getBoundingClientRect()];
    const ratio = canvas.width / Math.max(1, outer.width);
    const [left, width, height] = [frame.left - outer.left, frame.width, frame.height].map((v) => Math.round(v * ratio));
    const bottom = Math.round((outer.bottom - frame.bottom) * ratio);
    const eye = place.slice(0, 3);
    const eyeMatrix = lookingFrom(eye, placed(place, [0, 0, 1]), turned(place, [0, -1, 0]));
    const view = product(perspective(camera.fov, width / Math.max(1, height), 0.05, 70), eyeMatrix);
    gl.viewport(left, bottom, width, height);
    gl.enable(gl.SCISSOR_TEST);
    gl.scissor(left, bottom, width, height);
    if (this.mode === 'colour') {
      this.stage.drawInto(state, { eye, view, selected: null, hasShadows: this.stage.layers.shadows });
    } else {
      gl.clearColor(0.05, 0.05, 0.07, 1);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.useProgram(this.flat.made);
      gl.uniformMatrix4fv(this.flat.places.view, false, view);
      gl.uniform1f(this.flat.places.isDepth, this.mode === 'depth' ? 1 : 0);
      for (const [node, at] of this.stage.seen(state)) {
        gl.uniformMatrix4fv(this.flat.places.model, false, matrixOf(at));
        gl.uniform3fv(this.flat.places.hue, this.hue(node));
        gl.bindVertexArray(node.mesh.array);
        gl.drawElements(gl.TRIANGLES, node.mesh.count, gl.UNSIGNED_INT, 0);
      }
    }
    gl.disable(gl.SCISSOR_TEST);
  }

  // Objects have colours of their own; the robot is grey, furniture dark.
  hue(node) {
    if (node.kind === 'robot') return [0.55, 0.57, 0.6];
    if (node.kind === 'furniture') return [0.16, 0.18, 0.21];
    const turn = (node.id * 0.618) % 1 * 6;
    return [0, 4, 2].map((k) => 0.25 + 0.7 * Math.max(0, Math.min(1, Math.abs((turn + k) % 6 - 3) - 1)));
  }
}

const inset = stage && new Inset($('inset'), stage);
const insetButton = pushButton('robot’s eyes', 'What the robot’s camera sees, in the corner: colours, distances, or what belongs together', () => inset?.show(inset.mode ? null : 'colour'));
$('tools').append(insetButton);
