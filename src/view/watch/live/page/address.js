// What is looked at, in the page's address after `#`: it lasts when the page is loaded again, and
// whoever gets the address of a saved run sees the same.

let told = location.hash;

function addressNow() {
  const parts = [];
  if (page.time !== null) parts.push(`t=${Number(page.time.toFixed(3))}`);
  if (page.bound !== 'robot') {
    const { azimuth, elevation, distance, at, fov } = orbit;
    parts.push(`eye=${[azimuth, elevation, distance, ...at, fov].map((v) => Number(v.toFixed(3))).join(',')}`);
  }
  if (page.named) parts.push(`view=${page.named}`);
  const off = Object.keys(stage?.layers ?? {}).filter((name) => stage.layers[name] !== DEFAULT_LAYERS[name]);
  if (off.length) parts.push(`layers=${off.map((name) => (stage.layers[name] ? '' : '-') + name).join(',')}`);
  const node = scene.nodes.get(page.selected);
  if (node) parts.push(`see=${encodeURIComponent(node.name)}`);
  if (page.task) parts.push(`task=${page.task.id}`);
  if (page.tab !== 'plan') parts.push(`tab=${page.tab}`);
  return `#${parts.join('&')}`;
}

// Browsers allow a hundred changes in half a minute.
setInterval(() => {
  if (!page.views || page.link !== 'live' || orbit.way || page.isPlaying) return;
  const now = addressNow();
  if (now === told) return;
  told = now;
  // A saved run that is shown within another page has no address of its own.
  if (location.protocol !== 'about:') history.replaceState(null, '', now);
}, 700);

// Goes to where the address points, as far as that is known; anything else in it is ignored.
function followAddress() {
  const wanted = new Map(told.slice(1).split('&').map((part) => part.split('=')));
  const numbers = (text) => (text ?? '').split(',').map(Number);
  const time = wanted.has('t') ? Number(wanted.get('t')) : NaN;
  const name = wanted.get('view');
  if (['robot', 'follow', ...page.views.fixed.map((view) => view.name)].includes(name)) look(name, true);
  const [azimuth, elevation, distance, x, y, z, fov] = numbers(wanted.get('eye'));
  if ([azimuth, elevation, distance, x, y, z, fov].every(Number.isFinite) && wanted.has('eye')) {
    orbit.way = null;
    Object.assign(orbit, {
      azimuth, elevation: Math.max(-0.2, Math.min(1.5605, elevation)), distance: Math.max(0.25, Math.min(30, distance)),
      at: [x, y, z], fov: Math.max(0.1, Math.min(2, fov)),
    });
    if (!name) page.bound = page.named = null;
  }
  for (const change of (wanted.get('layers') ?? '').split(',')) {
    const [, sign, layer] = /^(-?)(\w+)$/.exec(change) ?? [];
    if (stage && layer in DEFAULT_LAYERS) stage.layers[layer] = !sign;
  }
  showTab(wanted.get('tab') ?? 'plan');
  showViews();
  showLayers();
  if (Number.isFinite(time)) page.wanted = time;
  page.sought = { node: wanted.has('see') ? decode(wanted.get('see')) : null, task: wanted.get('task') ?? null };
  findSought();
}

function decode(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return null;
  }
}

// What the address names may come later than the address is read.
function findSought() {
  const sought = page.sought ?? {};
  const node = sought.node && [...scene.nodes.values()].find(({ name }) => name === sought.node);
  const task = sought.task && tasks.byId.get(sought.task);
  if (task) {
    page.sought = null;
    selectTask(task, page.wanted ?? task.since);
  } else if (node) {
    page.sought = null;
    select(node.id);
  } else if (!sought.node && !sought.task) {
    page.sought = null;
  }
  if (page.wanted !== undefined && past.span[1] > past.span[0] && page.wanted <= past.span[1] + 0.5) {
    goTo(page.wanted);
    page.wanted = undefined;
  }
}

window.addEventListener('hashchange', () => {
  if (location.hash === told || !page.views) return;
  told = location.hash;
  followAddress();
});
