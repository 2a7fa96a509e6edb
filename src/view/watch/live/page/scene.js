// What exists and where: nodes with their meshes, and states, which say how the world was at a
// time.

const METRE = 1e-4;
const UNIT = 1e-5;

const EMPTY = { t: 0, places: new Map(), held: [], touch: [], hits: [], axes: [], paths: [], joints: [] };

function placeOf(n, i) {
  return [n[i] * METRE, n[i + 1] * METRE, n[i + 2] * METRE, n[i + 3] * UNIT, n[i + 4] * UNIT, n[i + 5] * UNIT, n[i + 6] * UNIT];
}

// The state after a frame, from the state before it.
function follow(before, frame) {
  const places = new Map(frame.whole ? [] : before.places);
  for (const id of frame.gone) places.delete(id);
  for (let i = 0; i + 8 <= frame.p.length; i += 8) places.set(frame.p[i], placeOf(frame.p, i + 1));
  const paths = !frame.paths ? before.paths : frame.paths.map((path) => {
    const points = [];
    for (let i = 0; i + 3 <= path.points.length; i += 3) points.push(path.points.slice(i, i + 3).map((v) => v * METRE));
    return { what: path.what, frame: path.frame, points };
  });
  let { joints } = before;
  if (frame.whole || frame.j?.length) {
    joints = frame.whole ? [] : joints.slice();
    for (let i = 0; i + 2 <= (frame.j?.length ?? 0); i += 2) joints[frame.j[i]] = frame.j[i + 1] * METRE;
  }
  // What presses on objects: the body (-1 is the floor), the object, where, and with which force (N).
  const touch = frame.touch ? frame.touch.map(([body, object, ...n]) => ({ body, object, at: times(n.slice(0, 3), METRE), force: times(n.slice(3), 0.1) })) : before.touch;
  return { t: frame.t, joints, places, held: frame.held, touch, hits: frame.hits, axes: frame.axes, paths };
}

class Scene {
  constructor() { this.clear(); }

  clear() {
    this.nodes = new Map();
    this.live = EMPTY;
  }

  addNodes(list) {
    for (const node of list) {
      this.nodes.set(node.id, { ...node, still: node.still ? placeOf(node.still, 0) : null, mesh: null });
    }
  }

  // The pose of a node in a state.
  place(node, state) { return node.still || state.places.get(node.id); }

  holder(state, id) {
    const hold = state.held.find(([object]) => object === id);
    return hold ? hold[1] + (hold[2] ? `, ${hold[2].toFixed(1)} N` : '') : null;
  }

  // What touches a thing, and how hard: names and forces (N).
  touched(state, id) {
    const forces = new Map();
    for (const { body, object, force } of state.touch) {
      if (body !== id && object !== id) continue;
      const name = this.nodes.get(body === id ? object : body)?.name ?? 'floor';
      forces.set(name, (forces.get(name) ?? 0) + length(force));
    }
    return [...forces].map(([name, force]) => (force ? `${name} ${force.toFixed(1)} N` : name));
  }
}

// Meshes as the server sends them: [id, corners, triangle corners], then the bytes of both.
function* meshesIn(buffer) {
  const view = new DataView(buffer);
  let at = 0;
  while (at + 12 <= buffer.byteLength) {
    const [id, corners, indices] = [0, 4, 8].map((i) => view.getUint32(at + i, true));
    at += 12;
    yield {
      id,
      corners: new Uint8Array(buffer, at, corners * 20),
      indices: new Uint32Array(buffer, at + corners * 20, indices),
    };
    at += corners * 20 + indices * 4;
  }
}
