// The floor, as in pictures: the server tells its numbers.

const glsl = (number) => (Array.isArray(number) ? `vec3(${number.map(glsl)})` : number.toFixed(6));

const FLOOR_VERTEX = HEAD + `
layout(location = 0) in vec2 corner;
uniform mat4 view, light;
out vec3 at;
out vec4 inLight;
void main() {
  at = vec3(corner * 30.0, 0.0);
  inLight = light * vec4(at, 1.0);
  gl_Position = view * vec4(at, 1.0);
}`;

const FLOOR_FRAGMENT = HEAD + LIGHT + `
in vec3 at;
in vec4 inLight;
uniform vec3 eye, far;
out vec4 result;
const float WIDTH = ${glsl(FLOOR.width)}, LENGTH = ${glsl(FLOOR.length)}, GAP = ${glsl(FLOOR.gap)};
float tone(float row, float column) {
  uint bits = uint(int(row)) * 0x9E3779B1u ^ uint(int(column)) * 0x85EBCA77u;
  bits ^= bits >> 15;
  bits *= 0x2C1B3C6Du;
  bits ^= bits >> 12;
  bits *= 0x297A2D39u;
  bits ^= bits >> 15;
  return float(bits & 0xFFFFu) / 65535.0;
}
float inside(float value, float size) {
  float part = fract(value);
  return min(part, 1.0 - part) * size;
}
vec3 boards(float grain) {
  float row = floor(at.y / WIDTH), along = at.x / LENGTH + tone(row, 0.0);
  float seam = min(inside(at.y / WIDTH, WIDTH), inside(along, LENGTH)), width = max(GAP, grain);
  float dark = max(1.0 - seam / width, 0.0) * GAP / width * ${glsl(FLOOR.shade)};
  float fine = 1.0 - smoothstep(0.0, 1.0, grain / WIDTH * 1.5);
  return ${glsl(FLOOR.board)} * (1.0 + (tone(row, floor(along) + 1.0) - 0.5) * ${glsl(FLOOR.variety)} * fine) * (1.0 - dark);
}
void main() {
  vec3 color = boards(max(fwidth(at.x), fwidth(at.y))) * (skyColor + sunColor * sun.z * lit(inLight, 0.2));
  float faded = smoothstep(${FLOOR.fade.map(glsl)}, length(at.xy - eye.xy));
  result = vec4(mix(shown(color), far, faded), 1.0);
}`;
