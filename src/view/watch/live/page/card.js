// The card about what is selected: a node of the scene, or a task of the plan.

function select(id) {
  page.selected = id;
  page.task = null;
  page.marked = null;
  page.isDirty = true;
}

// Selects a task, and goes to its begin, or to another time.
function selectTask(task, time = task.since) {
  page.selected = null;
  page.task = task;
  page.marked = null;
  tasks.reveal(task);
  goTo(time);
  markUsed(task);
}

function unselect() {
  page.moved = null;
  if (page.measured) measure(null);
  else select(null);
}

const element = (name, text, kind = '') => {
  const made = document.createElement(name);
  made.textContent = text;
  if (kind) made.className = kind;
  return made;
};

function pushButton(text, title, act) {
  const button = element('button', text);
  button.type = 'button';
  button.title = title;
  button.addEventListener('click', act);
  return button;
}

// Fills the card, unless it shows just that: rows are names with texts, `more` what follows.
function fillCard(title, rows, more, key = null) {
  const card = $('card');
  const text = JSON.stringify([title, rows, key]);
  if (card.dataset.text === text) return;
  card.dataset.text = text;
  const close = pushButton('×', 'Close (Escape)', () => select(null));
  close.className = 'close';
  close.setAttribute('aria-label', 'Close');
  const list = document.createElement('dl');
  list.append(...rows.flatMap(([name, value, kind]) => [element('dt', name), element('dd', value, kind)]));
  card.replaceChildren(element('h3', title), close, list, ...more());
}

// Moves the card to the other side if it would hide a node; once for each thing or task that it shows.
function keepClear(card, id, shown) {
  const at = screenOf(id);
  if (!at || page.wasClear === shown) return;
  page.wasClear = shown;
  card.classList.remove('aside');
  const box = card.getBoundingClientRect();
  const around = 60;
  const isHidden = at[0] > box.left - around && at[0] < box.right + around && at[1] > box.top - around;
  card.classList.toggle('aside', isHidden);
}

function showCard(state) {
  const node = scene.nodes.get(page.selected);
  $('card').hidden = !node && !page.task;
  if (node) keepClear($('card'), node.id, node.id);
  // A task is about the robot.
  else if (page.task) keepClear($('card'), page.views.base, page.task.id);
  if (node) showNode(node, state);
  else if (page.task) showTask(page.task);
}

function showNode(node, state) {
  const place = scene.place(node, state);
  const by = scene.holder(state, node.id);
  const rows = [['type', node.type || { robot: 'link of the robot', furniture: 'furniture' }[node.kind] || node.kind]];
  if (place) {
    rows.push(['position', `${place.slice(0, 3).map((v) => v.toFixed(3)).join('  ')} m`]);
    rows.push(['turned', `${angles(place).map((v) => (Math.round(v * 10) / 10 + 0).toFixed(1)).join('  ')}°`]);
  } else {
    rows.push(['position', 'not in the world']);
  }
  const parent = scene.nodes.get(node.parent);
  if (parent) rows.push(['carried by', parent.name]);
  if (node.kind === 'object') rows.push(['held by', by ?? 'nothing']);
  const touched = scene.touched(state, node.id);
  if (touched.length) rows.push(['touches', touched.join(', ')]);
  const holds = state.held.filter(([, link]) => link === node.name && node.kind === 'robot').map(([id]) => scene.nodes.get(id)?.name);
  if (holds.length) rows.push(['holds', holds.join(', ')]);
  // What has been dragged or clicked changes the forms.
  const key = [page.moved?.id === node.id && page.moved.place, page.clicked?.id === node.id && page.clicked.at, node.kind === 'furniture' ? '' : place];
  fillCard(node.name, rows, () => formsOf(node), key);
}

function showTask(task) {
  const state = Tasks.stateAt(task, Infinity);
  const rows = [[task.what, state]];
  const end = task.end;
  rows.push(['time', end === null ? `since ${task.since.toFixed(2)} s` : `${task.since.toFixed(2)} – ${end.toFixed(2)} s, ${(end - task.since).toFixed(2)} s`]);
  if (task.about?.place) rows.push(['plan', `${task.about.place}\n${task.about.line.trim()}`, 'code']);
  for (const [key, value] of task.about?.keys ?? []) rows.push([key, value, 'code']);
  if (task.result) rows.push(['result', task.result, 'code']);
  if (task.failure) rows.push(['failure', task.failure, 'bad']);
  const cause = originOf(task);
  if (cause && cause !== task) rows.push(['cause', cause.name]);
  if (page.marked?.names) rows.push(['used', page.marked.names]);
  fillCard(task.name, rows, () => {
    const actions = document.createElement('p');
    actions.className = 'actions';
    actions.append(pushButton('begin', 'Go to its begin', () => goTo(task.since)));
    if (end !== null) actions.append(pushButton('end', 'Go to its end', () => goTo(end)));
    if (cause && cause !== task) actions.append(pushButton('cause', 'Show what failed first', () => selectTask(cause, cause.end ?? cause.since)));
    if (task.parent) actions.append(pushButton('outer', 'Show the task that it belongs to', () => selectTask(task.parent, page.time ?? task.since)));
    return [actions];
  });
}

// The task inside a failed one that failed first for the same reason.
function originOf(task) {
  if (Tasks.stateAt(task, Infinity) !== 'failed') return null;
  const inner = task.children.find((child) => child.failure === task.failure);
  return inner ? originOf(inner) ?? inner : task;
}

// The motions inside a task.
const motionsOf = (task) => (task.what === 'motion' ? [task] : task.children.flatMap(motionsOf));

// The nodes of the robot's parts that motions used, by their process modules and by the arms that
// their parameters name; null if that is not known.
function partsOf(motions) {
  const known = motions.filter(({ about }) => about?.module);
  if (!known.length && motions.length) return null;
  const ids = new Set();
  for (const { about } of known) {
    // A key such as `left-target` names an arm, as do the values of `arm` and `gripper`.
    const said = about.keys.filter(([, value]) => value !== 'NIL').map(([key, value]) => (/^(arm|gripper)s?$/.test(key) ? value : key));
    const sides = ['left', 'right'].filter((side) => said.some((text) => text.toLowerCase().includes(side)));
    for (const [id, module, side] of page.views.parts) {
      const isUsed = { perception: 'neck' }[about.module] ?? about.module;
      const isHand = about.module === 'arms' && module === 'grippers';
      if (module !== isUsed && !isHand) continue;
      if (!side || !sides.length || sides.includes(side)) ids.add(id);
    }
  }
  return ids;
}

// Finds out which parts of the robot a task used, and which things: those that its description names,
// and those that these parts held, touched or moved.
async function markUsed(task) {
  const end = task.end ?? past.span[1];
  const times = [0, 0.25, 0.5, 0.75, 1].map((share) => task.since + (end - task.since) * share);
  const states = [];
  for (const time of times) states.push(await past.get(Math.max(past.span[0], Math.min(past.span[1], time))));
  if (page.task !== task || states.includes(null)) return;
  const relative = (node, state) => {
    const place = scene.place(node, state);
    const parent = scene.nodes.get(node.parent);
    const carrier = parent && scene.place(parent, state);
    return place && carrier ? within(carrier, place) : place;
  };
  const isMoved = (node) => {
    const [first, ...later] = states.map((state) => relative(node, state));
    return !!first && later.some((place) => place && isElsewhere(first, place));
  };
  const words = new Set((task.about?.keys ?? []).flatMap(([, value]) => value.toLowerCase().match(/[a-z][\w-]*/g) ?? []));
  const used = partsOf(motionsOf(task));
  const usedNames = new Set([...used ?? []].map((id) => scene.nodes.get(id)?.name));
  const handles = (state, id) => state.held.some(([object, link]) => object === id && usedNames.has(link))
    || state.touch.some(({ body, object }) => object === id && used.has(body));
  const ids = new Set(), things = new Set(), parts = new Set();
  for (const node of scene.nodes.values()) {
    if (node.still) {
      if (words.has(node.name.toLowerCase())) ids.add(node.id), things.add(node.name);
      continue;
    }
    // What moves in so short a time moves for other reasons.
    const mayMove = end - task.since > 0.04;
    const isNamed = node.kind !== 'robot' && words.has(node.name.toLowerCase());
    // What other branches of the plan do at the same time is not this task's.
    const isUsed = !used ? mayMove && isMoved(node)
      : node.kind === 'robot' ? used.has(node.id)
      : node.kind === 'object' ? states.some((state) => handles(state, node.id))
      : mayMove && usedNames.size > 0 && isMoved(node);
    if (!isNamed && !isUsed) continue;
    ids.add(node.id);
    (node.kind === 'robot' ? parts : things).add(node.name);
  }
  const list = (names) => [...names].slice(0, 6).join(', ') + (names.size > 6 ? ` and ${names.size - 6} more` : '');
  page.marked = { task, ids, names: [list(things), list(parts)].filter(Boolean).join('; ') };
  page.isDirty = true;
}
