// The mouse: left button turns, right button moves, wheel zooms, click selects, double click
// centres.

let held = null;
canvas.addEventListener('contextmenu', (event) => event.preventDefault());
canvas.addEventListener('pointerdown', (event) => {
  canvas.setPointerCapture(event.pointerId);
  held = { button: event.button, x: event.clientX, y: event.clientY, far: 0 };
});
canvas.addEventListener('pointermove', (event) => {
  if (!held) return;
  const [dx, dy] = [event.clientX - held.x, event.clientY - held.y];
  held.far += Math.hypot(dx, dy);
  Object.assign(held, { x: event.clientX, y: event.clientY });
  if (held.far < 4) return;
  leaveView();
  if (held.button === 0 && !event.shiftKey) orbit.turn(dx, dy);
  else orbit.move(dx, dy, canvas.clientHeight);
});
canvas.addEventListener('pointerup', (event) => {
  const isClick = held && held.far < 4 && held.button === 0;
  held = null;
  if (isClick) select(hit(event)?.id ?? null);
});
canvas.addEventListener('pointercancel', () => { held = null; });
canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  leaveView();
  const pixels = event.deltaY * [1, 30, 400][event.deltaMode];
  orbit.zoom(Math.exp(Math.max(-300, Math.min(300, pixels)) * 0.0012));
}, { passive: false });
canvas.addEventListener('dblclick', (event) => {
  const found = hit(event);
  if (!found) return;
  leaveView();
  orbit.go({ at: found.at, distance: Math.min(orbit.distance, Math.max(0.8, orbit.distance * 0.6)) }, performance.now());
});

// The node seen at a pointer, and the point on it.
function hit(event) {
  if (!stage) return null;
  const box = canvas.getBoundingClientRect();
  const [x, y] = [event.clientX - box.left, event.clientY - box.top];
  const { eye, matrix, fov } = bodyView(page.shown);
  const found = stage.at(page.shown, stage.projection(fov, matrix), x, y);
  if (!found) return null;
  const right = [matrix[0], matrix[4], matrix[8]], up = [matrix[1], matrix[5], matrix[9]], back = [matrix[2], matrix[6], matrix[10]];
  const half = Math.tan(fov / 2) * found.away;
  const across = (x / box.width * 2 - 1) * half * box.width / box.height;
  const upwards = (1 - y / box.height * 2) * half;
  return { id: found.id, at: add(eye, add(add(times(right, across), times(up, upwards)), times(back, -found.away))) };
}

// Where the centre of a node is seen (pixels of the page).
function screenOf(id) {
  const node = scene.nodes.get(id);
  const place = node && scene.place(node, page.shown);
  if (!stage || !place) return null;
  const { matrix, fov } = bodyView(page.shown);
  const middle = placed(place, node.mesh ? node.mesh.middle : [0, 0, 0]);
  const [x, y, , w] = onto(stage.projection(fov, matrix), middle);
  const box = canvas.getBoundingClientRect();
  return w > 0 ? [box.left + (x / w + 1) / 2 * box.width, box.top + (1 - y / w) / 2 * box.height] : null;
}
