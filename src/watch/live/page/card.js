// The card about the selected node.

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
  if (node.kind === 'object') rows.push(['held by', by ?? 'nothing']);
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

// The name label at the selected node itself.
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
