// Vectors, quaternions (x y z w) and column-major matrices, as plain arrays.

const add = (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
const times = (a, s) => [a[0] * s, a[1] * s, a[2] * s];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0],
];
const length = (a) => Math.hypot(a[0], a[1], a[2]);
const unit = (a) => times(a, 1 / (length(a) || 1));
const between = (a, b, share) => add(times(a, 1 - share), times(b, share));

// A pose is [x, y, z, qx, qy, qz, qw].
function turned(place, v) {
  const q = [place[3], place[4], place[5]];
  const t = times(cross(q, v), 2);
  return add(add(v, times(t, place[6])), cross(q, t));
}
const placed = (place, v) => add(turned(place, v), place);

// A pose as seen from another one.
function within(from, place) {
  const [x, y, z, i, j, k, w] = from;
  const back = [0, 0, 0, -i, -j, -k, w];
  const [a, b, c, d] = place.slice(3);
  return [
    ...turned(back, minus(place, [x, y, z])),
    w * a - i * d - j * c + k * b, w * b + i * c - j * d - k * a,
    w * c - i * b + j * a - k * d, w * d + i * a + j * b + k * c,
  ];
}

// A pose that is given as seen from another one.
function combined(from, place) {
  const [, , , i, j, k, w] = from;
  const [a, b, c, d] = place.slice(3);
  return [
    ...placed(from, place),
    w * a + i * d + j * c - k * b, w * b - i * c + j * d + k * a,
    w * c + i * b - j * a + k * d, w * d - i * a - j * b - k * c,
  ];
}

// Whether two poses differ by more than a millimetre or a quarter of a degree.
function isElsewhere(a, b) {
  const four = (p, q) => p[3] * q[3] + p[4] * q[4] + p[5] * q[5] + p[6] * q[6];
  // Rounded quaternions are not quite of unit length.
  const alike = Math.abs(four(a, b)) / Math.sqrt(four(a, a) * four(b, b));
  return length(minus(a, b)) > 1e-3 || alike < 1 - 2.5e-6;
}

function matrixOf(place) {
  const [x, y, z, i, j, k, w] = place;
  return new Float32Array([
    1 - 2 * (j * j + k * k), 2 * (i * j + k * w), 2 * (i * k - j * w), 0,
    2 * (i * j - k * w), 1 - 2 * (i * i + k * k), 2 * (j * k + i * w), 0,
    2 * (i * k + j * w), 2 * (j * k - i * w), 1 - 2 * (i * i + j * j), 0,
    x, y, z, 1,
  ]);
}

// Roll, pitch and yaw (degrees) of a pose.
function angles(place) {
  const [, , , i, j, k, w] = place;
  const degrees = (a) => a * 180 / Math.PI;
  return [
    degrees(Math.atan2(2 * (w * i + j * k), 1 - 2 * (i * i + j * j))),
    degrees(Math.asin(Math.max(-1, Math.min(1, 2 * (w * j - k * i))))),
    degrees(Math.atan2(2 * (w * k + i * j), 1 - 2 * (j * j + k * k))),
  ];
}

function product(a, b) {
  const c = new Float32Array(16);
  for (let column = 0; column < 4; column++) {
    for (let row = 0; row < 4; row++) {
      let sum = 0;
      for (let i = 0; i < 4; i++) sum += a[i * 4 + row] * b[column * 4 + i];
      c[column * 4 + row] = sum;
    }
  }
  return c;
}

function perspective(fov, aspect, near, far) {
  const f = 1 / Math.tan(fov / 2);
  return new Float32Array([
    f / aspect, 0, 0, 0, 0, f, 0, 0,
    0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0,
  ]);
}

function orthographic(half, near, far) {
  return new Float32Array([
    1 / half, 0, 0, 0, 0, 1 / half, 0, 0,
    0, 0, 2 / (near - far), 0, 0, 0, (far + near) / (near - far), 1,
  ]);
}

// The matrix that transforms the world into the frame of an eye.
function lookingFrom(eye, at, up) {
  const back = unit(minus(eye, at));
  const right = unit(cross(up, back));
  const above = cross(back, right);
  return new Float32Array([
    right[0], above[0], back[0], 0, right[1], above[1], back[1], 0,
    right[2], above[2], back[2], 0, -dot(right, eye), -dot(above, eye), -dot(back, eye), 1,
  ]);
}

const onto = (matrix, v) => {
  const out = [0, 1, 2, 3].map((row) =>
    matrix[row] * v[0] + matrix[4 + row] * v[1] + matrix[8 + row] * v[2] + matrix[12 + row]);
  return out;
};
