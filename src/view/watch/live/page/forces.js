// Forces with which bodies press on objects, as arrows that end where they press.

// The type of the nodes that are maps of locations.
const MAP_TYPE = 'map of a location';

// The greatest length (m) of an arrow, and the colour of arrows.
const LONGEST_ARROW = 0.4;
const FORCE_COLOR = [0.80, 0.10, 0.48, 1];

// At most so many forces are written beside their arrows.
const MOST_FORCES = 24;

// A cross at a point, as lines.
function marked(at, size, color) {
  return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => [add(at, times(axis, -size)), add(at, times(axis, size)), color]);
}

// Where the arrows begin and end, and the forces (N); recordings of earlier versions have none.
function forcesOf(state) {
  return state.touch.filter(({ force }) => length(force) > 0).map(({ at, force }) => {
    const newtons = length(force);
    return { from: minus(at, times(unit(force), Math.min(LONGEST_ARROW, newtons * FORCE_SCALE))), to: at, newtons };
  });
}

// An arrow as lines.
function arrowOf({ from, to }) {
  const along = unit(minus(to, from));
  const aside = unit(cross(along, Math.abs(along[2]) < 0.9 ? [0, 0, 1] : [1, 0, 0]));
  const head = Math.min(0.022, 0.45 * length(minus(to, from)));
  const back = minus(to, times(along, head));
  const edges = [aside, times(aside, -1), cross(along, aside), cross(aside, along)];
  return [[from, to, FORCE_COLOR], ...edges.map((off) => [add(back, times(off, head * 0.45)), to, FORCE_COLOR])];
}

// The strongest forces as texts, each with the point beside which it is written.
function forceLabels(state) {
  if (!stage?.layers.forces) return [];
  const strongest = forcesOf(state).sort((a, b) => b.newtons - a.newtons).slice(0, MOST_FORCES);
  return strongest.map(({ from, newtons }, i) => ({ key: `force ${i}`, text: `${newtons.toFixed(1)} N`, at: onScreen(from) }));
}

// The scale of the arrows.
function showScale() {
  $('scale').hidden = !stage?.layers.forces;
  $('scale').textContent = `normal forces: 10 N = ${(1000 * FORCE_SCALE).toFixed(0)} cm, at most ${100 * LONGEST_ARROW} cm`;
}
