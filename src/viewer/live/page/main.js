// The page: what comes from the session, what the person does, and when to draw.

const $ = (id) => document.getElementById(id);
const canvas = $('canvas');
const scene = new Scene();
const orbit = new Orbit();
const past = new Past();
const tasks = new Tasks($('task-list'), $('task-count'));
const log = new Log($('log-lines'));

let stage = null;
try {
  stage = new Stage(canvas, scene);
} catch (error) {
  notice(error.message);
}

const page = {
  // Null while it shows what happens now, else the time (s) that is looked at.
  time: null,
  isPlaying: false,
  isRecording: false,
  isOver: false,
  pace: null,
  pastSpeed: 1,
  // A view that goes with the robot.
  bound: null,
  selected: null,
  views: null,
  shown: EMPTY,
  isDirty: true,
};

// What a check may look at.
const counts = { updates: 0, drawn: 0, errors: 0 };
window.planwright = { counts, page, orbit, scene, past, screenOf };
window.addEventListener('error', () => { counts.errors += 1; });

function notice(text) {
  $('notice').textContent = text;
  $('notice').hidden = !text;
}

function linked(state, text) {
  $('link').dataset.state = state;
  $('link-text').textContent = text;
}

// ---- What comes from the session

const source = new EventSource('events');
const on = (name, hear) => source.addEventListener(name, (event) => {
  hear(JSON.parse(event.data));
  page.isDirty = true;
});

on('hello', (hello) => {
  scene.clear();
  past.clear();
  tasks.clear();
  log.clear();
  page.isRecording = hello.recording;
  page.views = hello.views;
  if (stage) stage.camera = hello.views.camera;
  page.time = hello.recording ? 0 : null;
  linked('live', hello.recording ? 'recording' : 'live');
  notice('');
  makeViews();
  if (!page.hasView) look(hello.views.fixed[0]?.name ?? 'follow', true);
  page.hasView = true;
});

on('nodes', async (nodes) => {
  scene.addNodes(nodes);
  const answer = await fetch(`meshes?from=${nodes[0].id}`);
  const meshes = await answer.arrayBuffer();
  if (stage) for (const mesh of meshesIn(meshes)) stage.load(mesh);
  page.isDirty = true;
});

on('frame', (frame) => {
  scene.live = follow(scene.live, frame);
  counts.updates += 1;
});

on('span', (span) => {
  past.span = span;
  if (page.isRecording && page.time < span[0]) page.time = span[0];
});

on('news', (list) => {
  for (const news of list) {
    if (news.task) tasks.hear(news);
    else log.hear(news);
  }
});

on('pace', (pace) => {
  page.pace = pace;
  showTransport();
});

on('over', () => {
  page.isOver = true;
  source.close();
  linked('lost', 'session ended');
  showTransport();
});

source.addEventListener('error', () => {
  if (!page.isOver) linked('lost', source.readyState === EventSource.CLOSED ? 'disconnected' : 'reconnecting');
});

// ---- Views

function makeViews() {
  const names = [...page.views.fixed.map((view) => view.name), 'robot', 'follow'];
  $('views').replaceChildren(...names.map((name) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = name;
    button.dataset.view = name;
    button.title = { robot: 'Through the robot’s camera', follow: 'Goes with the robot' }[name] ?? `Look at: ${name}`;
    button.addEventListener('click', () => look(name));
    return button;
  }));
}

function look(name, isAtOnce = false) {
  const fixed = page.views.fixed.find((view) => view.name === name);
  page.bound = fixed ? null : name;
  page.named = name;
  if (fixed) orbit.go(Orbit.of(fixed.from, fixed.at, fixed.fov), isAtOnce ? -1e9 : performance.now());
  if (name === 'follow') {
    const base = page.shown.places.get(page.views.base);
    if (base) orbit.go(Orbit.of(placed(base, [-1.9, 1.7, 2.2]), placed(base, [0.45, 0, 0.72]), FOV), performance.now());
    page.base = base;
  }
  showViews();
}

function showViews() {
  for (const button of $('views').children) {
    button.setAttribute('aria-pressed', String(button.dataset.view === page.named));
  }
  page.isDirty = true;
}

// The person turns or moves the eye: it is at no named place any more, but still goes with
// the robot if it did.
function leaveView() {
  if (page.bound === 'robot') page.bound = null;
  if (page.bound !== 'follow') page.named = null;
  showViews();
}

function bodyView(state) {
  if (page.bound === 'follow') {
    const base = state.places.get(page.views.base);
    if (base && page.base) {
      const moved = minus(base, page.base);
      orbit.at = add(orbit.at, moved);
      if (orbit.way) {
        orbit.way.from.at = add(orbit.way.from.at, moved);
        orbit.way.goal.at = add(orbit.way.goal.at, moved);
      }
    }
    page.base = base;
  }
  if (page.bound === 'robot') {
    const camera = state.places.get(page.views.camera.node);
    if (camera) {
      const eye = camera.slice(0, 3);
      return { eye, matrix: lookingFrom(eye, placed(camera, [0, 0, 1]), turned(camera, [0, -1, 0])), fov: page.views.camera.fov };
    }
  }
  return { eye: orbit.eye(), matrix: orbit.matrix(), fov: orbit.fov };
}

for (const name of ['paths', 'camera', 'contacts', 'shadows']) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = name;
  button.title = {
    paths: 'Planned ways of base and hands', camera: 'What the robot’s camera can see',
    contacts: 'What the hands touch, and what stopped a motion', shadows: 'Shadows',
  }[name];
  button.setAttribute('aria-pressed', 'true');
  button.addEventListener('click', () => {
    if (!stage) return;
    stage.layers[name] = !stage.layers[name];
    button.setAttribute('aria-pressed', String(stage.layers[name]));
    page.isDirty = true;
  });
  $('layers').append(button);
}

// ---- Mouse

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

// What is seen at a pointer, and where.
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

// Where the middle of a node is seen: pixels of the page.
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

// ---- The chosen thing

function select(id) {
  page.selected = id;
  page.isDirty = true;
}

function showCard(state) {
  const node = scene.nodes.get(page.selected);
  const card = $('card');
  card.hidden = !node;
  showLabel(node);
  if (!node) return;
  if (card.dataset.id !== String(node.id)) {
    card.dataset.id = node.id;
    const title = document.createElement('h3');
    title.textContent = node.name;
    const close = document.createElement('button');
    close.type = 'button';
    close.textContent = '×';
    close.title = 'Close (Escape)';
    close.addEventListener('click', () => select(null));
    card.replaceChildren(title, close, document.createElement('dl'));
  }
  const place = scene.place(node, state);
  const by = scene.holder(state, node.id);
  const rows = [['type', node.type || { robot: 'link of the robot', furniture: 'furniture' }[node.kind] || node.kind]];
  if (place) {
    rows.push(['position', `${place.slice(0, 3).map((v) => v.toFixed(3)).join('  ')} m`]);
    rows.push(['turned', `${angles(place).map((v) => v.toFixed(1)).join('  ')}°`]);
  } else {
    rows.push(['position', 'not in the world']);
  }
  if (node.kind === 'object') rows.push(['held by', by ?? 'nobody']);
  const touched = scene.touched(state, node.id);
  if (touched.length) rows.push(['touches', touched.join(', ')]);
  const holds = state.held.filter(([, link]) => link === node.name && node.kind === 'robot').map(([id]) => scene.nodes.get(id)?.name);
  if (holds.length) rows.push(['holds', holds.join(', ')]);
  const text = JSON.stringify(rows);
  if (card.dataset.text === text) return;
  card.dataset.text = text;
  card.lastChild.replaceChildren(...rows.flatMap(([name, value]) => {
    const [dt, dd] = [document.createElement('dt'), document.createElement('dd')];
    dt.textContent = name;
    dd.textContent = value;
    return [dt, dd];
  }));
}

// The name at the chosen thing itself.
const label = document.createElement('span');
$('labels').append(label);
function showLabel(node) {
  const at = node && screenOf(node.id);
  label.hidden = !at;
  if (!at) return;
  const box = canvas.getBoundingClientRect();
  label.textContent = node.name;
  label.style.left = `${at[0] - box.left}px`;
  label.style.top = `${at[1] - box.top}px`;
}

// ---- Time

const SPEEDS = [['¼', 0.25], ['½', 0.5], ['1×', 1], ['2×', 2], ['4×', 4], ['max', null]];
for (const [text, speed] of SPEEDS) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = text;
  button.title = speed ? `${speed} simulated seconds in a real one` : 'As fast as possible';
  button.addEventListener('click', () => {
    if (page.time === null) ask(`speed ${speed ?? 'max'}`);
    else page.pastSpeed = speed ?? 16;
    showTransport();
  });
  $('speeds').append(button);
}

// Asks the session for another pace; it can be asked for nothing else.
async function ask(what) {
  try {
    await fetch('pace', { method: 'POST', body: what });
  } catch {
    linked('lost', 'disconnected');
  }
}

function play() {
  if (page.time === null) {
    if (page.pace) ask(page.pace.paused ? 'go' : 'pause');
  } else {
    page.isPlaying = !page.isPlaying;
    if (page.isPlaying && page.time >= past.span[1] - 1e-3) page.time = past.span[0];
  }
  showTransport();
}

function goTo(time) {
  page.time = Math.max(past.span[0], Math.min(past.span[1], time));
  page.isDirty = true;
  showTransport();
}

function goLive() {
  page.isPlaying = false;
  page.time = page.isRecording ? past.span[1] : null;
  page.isDirty = true;
  showTransport();
}

function showTransport() {
  const isNow = page.time === null;
  const isGoing = isNow ? !(page.pace?.paused) && !page.isOver : page.isPlaying;
  $('play').classList.toggle('go', !isGoing);
  $('play').title = `${isGoing ? 'Pause' : 'Go on'} (space)`;
  $('play').disabled = isNow && (!page.pace || page.isOver);
  $('live').setAttribute('aria-pressed', String(isNow && !page.isOver));
  $('live').hidden = page.isRecording;
  const speed = isNow ? page.pace?.speed ?? null : (page.pastSpeed === 16 ? null : page.pastSpeed);
  [...$('speeds').children].forEach((button, i) => {
    button.setAttribute('aria-pressed', String(SPEEDS[i][1] === speed && (!isNow || !!page.pace)));
    button.disabled = isNow && (!page.pace || page.isOver);
  });
}

$('play').addEventListener('click', play);
$('live').addEventListener('click', goLive);
$('slider').addEventListener('input', () => {
  page.isPlaying = false;
  goTo(Number($('slider').value));
});

window.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.id === 'slider') return;
  const step = event.shiftKey ? 1 : 0.1;
  const now = page.time ?? past.span[1];
  const keys = {
    ' ': play, End: goLive, Home: () => goTo(past.span[0]), Escape: () => select(null),
    ArrowLeft: () => goTo(now - step), ArrowRight: () => goTo(now + step),
  };
  if (!keys[event.key] || (event.key === ' ' && event.target.tagName === 'BUTTON')) return;
  event.preventDefault();
  keys[event.key]();
});

// ---- Drawing

const seconds = (t) => `${t.toFixed(2)} s`;

function showTime() {
  const slider = $('slider');
  const [start, end] = past.span;
  // A plan that just begins must not make the slider jump about.
  slider.min = start;
  slider.max = Math.max(end, start + 0.01);
  slider.value = page.time ?? end;
  $('now').textContent = seconds(page.time ?? scene.live.t);
  $('end').textContent = page.time === null ? '' : `of ${seconds(end)}`;
}

let lastTick = 0, lastDraw = 0, slow = 0, isRefined = false;
function tick(now) {
  requestAnimationFrame(tick);
  const passed = Math.min(0.25, (now - lastTick) / 1000);
  lastTick = now;
  if (page.isPlaying && page.time !== null) {
    page.time = Math.min(past.span[1], page.time + passed * page.pastSpeed);
    page.isDirty = true;
    if (page.time >= past.span[1]) {
      page.isPlaying = false;
      if (!page.isRecording && !page.isOver) goLive();
      showTransport();
    }
  }
  if (orbit.advance(now)) page.isDirty = true;
  if (tasks.isDirty) page.isDirty = true;
  if (document.hidden) return;
  // What has come to rest is drawn once more, as well as possible.
  const isFine = !page.isDirty && stage?.coarse > 0 && !isRefined && now - lastDraw > 250;
  if (!page.isDirty && !isFine) return;
  isRefined = isFine;
  if (!isFine) lastDraw = now;
  page.isDirty = false;
  if (page.time === null) page.shown = scene.live;
  else page.shown = past.at(page.time, () => { page.isDirty = true; }) ?? page.shown;
  if (stage) {
    const { eye, matrix, fov } = bodyView(page.shown);
    stage.resize(isFine);
    const view = stage.projection(fov, matrix);
    stage.draw(page.shown, { eye, view, selected: page.selected, isFine, isThroughCamera: page.bound === 'robot' });
    if (!isFine) adapt(passed);
  }
  counts.drawn += 1;
  showTime();
  showCard(page.shown);
  tasks.render(page.time ?? Infinity);
  log.render(page.time ?? Infinity);
}

// Where the graphics are slow, the picture gets coarser rather than late.
function adapt(passed) {
  slow = passed > 0.045 ? slow + passed : Math.max(0, slow - passed);
  if (slow < 1.5) return;
  slow = 0;
  stage.coarse = Math.min(3, stage.coarse + 1);
}

new ResizeObserver(() => { page.isDirty = true; }).observe(canvas);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { page.isDirty = true; });
showTransport();
requestAnimationFrame(tick);
