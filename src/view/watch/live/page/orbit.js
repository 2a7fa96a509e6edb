// The eye from which the scene is seen, orbiting a point.

const FOV = 0.75;

class Orbit {
  constructor() {
    this.at = [-0.5, 0.55, 0.7];
    this.distance = 5.5;
    this.azimuth = -2.4;
    this.elevation = 0.45;
    this.fov = FOV;
    this.way = null;
  }

  eye() {
    const level = Math.cos(this.elevation) * this.distance;
    return add(this.at, [
      level * Math.cos(this.azimuth), level * Math.sin(this.azimuth),
      this.distance * Math.sin(this.elevation),
    ]);
  }

  matrix() { return lookingFrom(this.eye(), this.at, [0, 0, 1]); }

  turn(dx, dy) {
    this.way = null;
    this.azimuth -= dx * 0.0065;
    this.elevation = Math.max(-0.2, Math.min(1.5605, this.elevation + dy * 0.0055));
  }

  // Moves by pixels; `height` is the height of the picture.
  move(dx, dy, height) {
    this.way = null;
    const scale = 2 * this.distance * Math.tan(this.fov / 2) / height;
    const forward = unit(minus(this.at, this.eye()));
    const right = unit(cross(forward, [0, 0, 1]));
    const up = cross(right, forward);
    this.at = add(this.at, add(times(right, -dx * scale), times(up, dy * scale)));
    const reach = (v, least, most) => Math.max(least, Math.min(most, v));
    this.at = [reach(this.at[0], -15, 15), reach(this.at[1], -15, 15), reach(this.at[2], -1, 5)];
  }

  zoom(factor) {
    this.way = null;
    this.distance = Math.max(0.25, Math.min(30, this.distance * factor));
  }

  // Moves to a view within a third of a second.
  go(to, now) {
    const from = { at: this.at, distance: this.distance, azimuth: this.azimuth, elevation: this.elevation, fov: this.fov };
    const goal = { ...from, fov: FOV, ...to };
    // The shorter way round.
    goal.azimuth = from.azimuth + Math.atan2(Math.sin(goal.azimuth - from.azimuth), Math.cos(goal.azimuth - from.azimuth));
    this.way = { from, goal, since: now };
  }

  // The orbit of an eye that looks from one point to another.
  static of(from, at, fov) {
    const off = minus(from, at);
    const distance = length(off);
    const elevation = Math.min(1.5605, Math.asin(off[2] / distance));
    // Seen straight from above, north is up.
    const azimuth = Math.hypot(off[0], off[1]) < 1e-3 * distance ? -Math.PI / 2 : Math.atan2(off[1], off[0]);
    return { at, distance, elevation, azimuth, fov };
  }

  // Continues a movement; returns whether there is one.
  advance(now) {
    if (!this.way) return false;
    const { from, goal, since } = this.way;
    const t = Math.min(1, (now - since) / 350);
    const s = t * t * (3 - 2 * t);
    this.at = between(from.at, goal.at, s);
    for (const name of ['distance', 'azimuth', 'elevation', 'fov']) this[name] = from[name] * (1 - s) + goal[name] * s;
    if (t >= 1) this.way = null;
    return true;
  }
}
