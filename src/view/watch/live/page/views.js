// The named views, and the layers shown.

function makeViews() {
  const names = [...page.views.fixed.map((view) => view.name), 'robot', 'follow'];
  $('views').replaceChildren(...names.map((name) => {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = name;
    button.dataset.view = name;
    button.title = { robot: 'Through the robot’s camera', follow: 'Follows the robot' }[name] ?? `Look at: ${name}`;
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
    const { from, at, fov } = page.views.follow;
    if (base) orbit.go(Orbit.of(add(base, from), add(base, at), fov), performance.now());
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

// The user turns or moves the eye: it is in no named view any more, but still follows the robot
// if it did before.
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

const LAYER_TITLES = {
  paths: 'Planned paths of base and hands', camera: 'What the robot’s camera can see',
  contacts: 'Where things touch, what the hands touch, and what stopped a motion',
  forces: 'Normal forces on objects, as arrows that end where they press', maps: 'Maps of locations', shadows: 'Shadows',
  frames: 'All frames of the robot and of objects, with what carries them',
};

for (const [name, title] of Object.entries(LAYER_TITLES)) {
  const button = pushButton(name, title, () => {
    if (!stage) return;
    stage.layers[name] = !stage.layers[name];
    showLayers();
  });
  button.dataset.layer = name;
  $('layers').append(button);
}

function showLayers() {
  for (const button of $('layers').children) {
    button.setAttribute('aria-pressed', String(!!stage?.layers[button.dataset.layer]));
  }
  showScale();
  page.isDirty = true;
}
showLayers();

// Where there is little room, layers and tools are shown on demand.
$('more').addEventListener('click', () => {
  $('more').setAttribute('aria-expanded', String(document.body.classList.toggle('more')));
});

// What the pointer does besides turning the view: measuring, or moving things.
for (const [name, title, set] of [
  ['measure', 'Measure between two clicks', (on) => { page.isMeasuring = on; measure(null); }],
  ['move', 'Drag objects and the robot while the view is paused, and copy the form that moves them', (on) => {
    page.isDragging = on;
    page.moved = null;
    page.isDirty = true;
  }],
]) {
  const button = pushButton(name, title, () => {
    const on = button.getAttribute('aria-pressed') !== 'true';
    for (const other of $('tools').children) if (other !== button && other.getAttribute('aria-pressed') === 'true') other.click();
    button.setAttribute('aria-pressed', String(on));
    set(on);
  });
  button.setAttribute('aria-pressed', 'false');
  $('tools').append(button);
}
