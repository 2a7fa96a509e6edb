// The shader programs.

const HEAD = `#version 300 es
precision highp float;
precision highp sampler2DShadow;
`;

const LIGHT = `
uniform sampler2DShadow shadowMap;
uniform float shadows;
uniform vec3 sun, sunColor, skyColor, groundColor;
float lit(vec4 at, float slope) {
  if (shadows < 0.5) return 1.0;
  vec3 p = at.xyz / at.w * 0.5 + 0.5;
  if (any(lessThan(p, vec3(0.0))) || any(greaterThan(p, vec3(1.0)))) return 1.0;
  float texel = 1.0 / float(textureSize(shadowMap, 0).x);
  p.z -= texel * (0.7 + 3.0 * slope * slope);
  float sum = 0.0;
  for (int i = -1; i <= 1; i++)
    for (int j = -1; j <= 1; j++)
      sum += texture(shadowMap, p + vec3(float(i), float(j), 0.0) * texel);
  return sum / 9.0;
}
vec3 shown(vec3 c) {
  c = mix(c, 0.74 + 0.26 * (1.0 - exp(-(c - 0.74) / 0.26)), step(0.74, c));
  return mix(12.92 * c, 1.055 * pow(max(c, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}
`;

const BODY_VERTEX = HEAD + `
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float gloss;
layout(location = 3) in vec4 color;
uniform mat4 model, view, light;
out vec3 at, facing;
out vec4 paint, inLight;
out float shine;
void main() {
  vec4 world = model * vec4(position, 1.0);
  at = world.xyz;
  facing = mat3(model) * normal;
  paint = vec4(color.rgb * color.rgb, color.a);
  shine = gloss;
  inLight = light * world;
  gl_Position = view * world;
}`;

const BODY_FRAGMENT = HEAD + LIGHT + `
in vec3 at, facing;
in vec4 paint, inLight;
in float shine;
uniform vec3 eye;
uniform vec4 tint;
out vec4 result;
void main() {
  float rank = mod(floor(gl_FragCoord.x) + 2.0 * floor(gl_FragCoord.y), 4.0) / 4.0 + 0.125;
  if (paint.a < rank) discard;
  vec3 n = normalize(facing), v = normalize(eye - at), h = normalize(sun + v);
  float face = max(dot(n, sun), 0.0);
  float seen = face > 0.0 ? lit(inLight, 1.0 - face) : 0.0;
  vec3 color = paint.rgb * (mix(groundColor, skyColor, n.z * 0.5 + 0.5) + sunColor * face * seen);
  float rim = pow(1.0 - max(dot(n, v), 0.0), 4.0);
  color += shine * (sunColor * pow(max(dot(n, h), 0.0), 48.0) * 0.16 * seen + skyColor * rim * 0.10);
  color = mix(color, tint.rgb, tint.a * (0.45 + 0.55 * rim));
  result = vec4(shown(color), 1.0);
}`;

const SHADOW_VERTEX = HEAD + `
layout(location = 0) in vec3 position;
uniform mat4 model, light;
void main() { gl_Position = light * model * vec4(position, 1.0); }`;

const SHADOW_FRAGMENT = HEAD + `void main() {}`;

// Which node is seen at a pixel, and how far away: for clicks.
const PICK_VERTEX = HEAD + `
layout(location = 0) in vec3 position;
uniform mat4 model, view;
void main() { gl_Position = view * model * vec4(position, 1.0); }`;

const PICK_FRAGMENT = HEAD + `
uniform float id;
layout(location = 0) out vec4 who;
layout(location = 1) out vec4 depth;
vec4 bytes(float v) { return vec4(mod(v, 256.0), mod(floor(v / 256.0), 256.0), floor(v / 65536.0), 255.0) / 255.0; }
void main() {
  who = bytes(id);
  depth = bytes(floor(gl_FragCoord.z * 16777215.0));
}`;

// Thick lines: each segment is a rectangle that faces the eye.
const LINE_VERTEX = HEAD + `
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec4 color;
layout(location = 3) in vec2 corner;
uniform mat4 view;
uniform vec2 size;
uniform float width;
out vec4 paint;
void main() {
  vec4 a = view * vec4(from, 1.0), b = view * vec4(to, 1.0);
  float near = 0.02;
  if (a.w < near && b.w < near) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  if (a.w < near) a = mix(b, a, (b.w - near) / (b.w - a.w));
  if (b.w < near) b = mix(a, b, (a.w - near) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  along = length(along) > 1e-4 ? normalize(along) : vec2(1.0, 0.0);
  vec4 p = mix(a, b, corner.x);
  vec2 off = vec2(-along.y, along.x) * (corner.y - 0.5) + along * (corner.x - 0.5) * 0.6;
  p.xy += off * width * 2.0 / size * p.w;
  p.z -= 0.0006 * p.w;
  paint = color;
  gl_Position = p;
}`;

const LINE_FRAGMENT = HEAD + `
in vec4 paint;
out vec4 result;
void main() { result = paint; }`;

function program(gl, vertex, fragment) {
  const made = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) {
    const logs = gl.getAttachedShaders(made).map((shader) => gl.getShaderInfoLog(shader));
    throw new Error([gl.getProgramInfoLog(made), ...logs].join('\n'));
  }
  const places = {};
  const count = gl.getProgramParameter(made, gl.ACTIVE_UNIFORMS);
  for (let i = 0; i < count; i++) {
    const { name } = gl.getActiveUniform(made, i);
    places[name] = gl.getUniformLocation(made, name);
  }
  return { made, places };
}
