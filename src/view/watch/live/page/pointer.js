// Mouse, pen and fingers: the left button or one finger turns, the right button or two fingers
// move, wheel and pinch zoom, a click selects, a double click centres.

// The pointers that are down, by their numbers.
const held = new Map();
// How far (pixels) they have moved since the first came down, and what is dragged.
let far = 0, most = 0, taken = null, tapped = 0;

canvas.addEventListener('contextmenu', (event) => event.preventDefault());
canvas.addEventListener('pointerdown', (event) => {
  canvas.setPointerCapture(event.pointerId);
  if (!held.size) far = most = 0;
  held.set(event.pointerId, { button: event.button, x: event.clientX, y: event.clientY });
  most = Math.max(most, held.size);
  taken = held.size === 1 && event.button === 0 && page.isDragging ? beginDrag(hit(event)) : null;
});
canvas.addEventListener('pointermove', (event) => {
  const own = held.get(event.pointerId);
  if (!own) return;
  const before = pairOf();
  const [dx, dy] = [event.clientX - own.x, event.clientY - own.y];
  far += Math.hypot(dx, dy);
  Object.assign(own, { x: event.clientX, y: event.clientY });
  // A finger trembles more than a mouse.
  if (far < (event.pointerType === 'touch' ? 9 : 4)) return;
  if (taken) {
    drag(taken, event);
    return;
  }
  leaveView();
  if (held.size > 1) {
    const now = pairOf();
    orbit.move(now.x - before.x, now.y - before.y, canvas.clientHeight);
    if (before.apart > 10 && now.apart > 10) orbit.zoom(before.apart / now.apart);
  } else if (own.button === 0 && !event.shiftKey) orbit.turn(dx, dy);
  else orbit.move(dx, dy, canvas.clientHeight);
});
canvas.addEventListener('pointerup', (event) => {
  const own = held.get(event.pointerId);
  held.delete(event.pointerId);
  if (!own || held.size || most > 1) return;
  const isTouch = event.pointerType === 'touch';
  if (far >= (isTouch ? 9 : 4) || own.button !== 0) return;
  const found = hit(event);
  if (page.isMeasuring) {
    if (found) measure(found.at);
    return;
  }
  // Two taps are a double click.
  if (isTouch && event.timeStamp - tapped < 350) centre(found);
  tapped = event.timeStamp;
  page.moved = null;
  select(found?.id ?? null);
  page.clicked = found;
});
canvas.addEventListener('pointercancel', (event) => { held.delete(event.pointerId); });
canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  leaveView();
  const pixels = event.deltaY * [1, 30, 400][event.deltaMode];
  orbit.zoom(Math.exp(Math.max(-300, Math.min(300, pixels)) * 0.0012));
}, { passive: false });
canvas.addEventListener('dblclick', (event) => { if (!page.isMeasuring) centre(hit(event)); });

// The middle of two fingers, and how far apart (pixels) they are.
function pairOf() {
  const [a, b = a] = [...held.values()];
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, apart: Math.hypot(a.x - b.x, a.y - b.y) };
}

function centre(found) {
  if (!found) return;
  leaveView();
  orbit.go({ at: found.at, distance: Math.min(orbit.distance, Math.max(0.8, orbit.distance * 0.6)) }, performance.now());
}

// The arrow keys turn the view while the canvas has the focus, with Shift they move it.
canvas.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const arrows = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  const zoom = { '+': 0.85, '=': 0.85, '-': 1 / 0.85 }[event.key];
  const way = arrows[event.key];
  if (!way && !zoom) return;
  event.preventDefault();
  event.stopPropagation();
  leaveView();
  if (zoom) orbit.zoom(zoom);
  else if (event.shiftKey) orbit.move(way[0] * 40, way[1] * 40, canvas.clientHeight);
  else orbit.turn(way[0] * 24, way[1] * 24);
});

// The direction in which a pointer points from the eye; its part along the view is 1.
function rayAt(event, matrix, fov) {
  const box = canvas.getBoundingClientRect();
  const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
  const right = [matrix[0], matrix[4], matrix[8]], up = [matrix[1], matrix[5], matrix[9]], back = [matrix[2], matrix[6], matrix[10]];
  const half = Math.tan(fov / 2);
  const across = (x * 2 - 1) * half * box.width / box.height;
  return add(add(times(right, across), times(up, (1 - y * 2) * half)), times(back, -1));
}

// The node seen at a pointer, and the point on it.
function hit(event) {
  if (!stage) return null;
  const box = canvas.getBoundingClientRect();
  const { eye, matrix, fov } = bodyView(page.shown);
  const found = stage.at(dragged(page.shown), stage.projection(fov, matrix), event.clientX - box.left, event.clientY - box.top);
  return found && { id: found.id, at: add(eye, times(rayAt(event, matrix, fov), found.away)) };
}

// Where a point (m) is seen (pixels of the page); null behind the eye.
function onScreen(point) {
  if (!stage) return null;
  const { matrix, fov } = bodyView(page.shown);
  const [x, y, , w] = onto(stage.projection(fov, matrix), point);
  const box = canvas.getBoundingClientRect();
  return w > 0 ? [box.left + (x / w + 1) / 2 * box.width, box.top + (1 - y / w) / 2 * box.height] : null;
}

// Where the centre of a node is seen (pixels of the page).
function screenOf(id) {
  const node = scene.nodes.get(id);
  const place = node && scene.place(node, dragged(page.shown));
  return place ? onScreen(placed(place, node.mesh ? node.mesh.middle : [0, 0, 0])) : null;
}
