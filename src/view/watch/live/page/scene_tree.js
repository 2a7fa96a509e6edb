// The things of the scene as a tree, by what carries them: to select, hide and name them.

const GRAIN = 'grain'; // The type of the node of a grain.

class SceneTree {
  constructor(list, filter) {
    Object.assign(this, { list, filter, key: '', folded: new Set() });
    filter.addEventListener('input', () => { page.isDirty = true; });
  }

  render(state) {
    if (page.tab !== 'scene') return;
    const here = [...scene.nodes.values()].filter((node) => node.still || state.places.has(node.id));
    const text = this.filter.value.trim().toLowerCase();
    const key = [here.length, here.at(-1)?.id, text, [...page.hidden], [...page.labelled], page.selected, [...this.folded]].join();
    if (key === this.key) return;
    this.key = key;
    const ids = new Set(here.map((node) => node.id));
    const inner = new Map();
    for (const node of here) {
      const parent = ids.has(node.parent) ? node.parent : node.kind;
      inner.set(parent, [...inner.get(parent) ?? [], node]);
    }
    const rows = [];
    const isWanted = (node) => node.name.toLowerCase().includes(text);
    const add = (node, depth) => {
      const own = inner.get(node.id) ?? [];
      if (!text || isWanted(node)) rows.push(this.row(node.id, node.name, [node], depth, own.length > 0 && !text));
      if (text || !this.folded.has(node.id)) own.forEach((one) => add(one, depth + 1));
    };
    for (const [kind, name] of [['object', 'objects'], ['robot', 'robot'], ['furniture', 'kitchen']]) {
      const all = here.filter((node) => node.kind === kind);
      if (!all.length) continue;
      if (!text) rows.push(this.row(kind, name, all, 0, true));
      if (!text && this.folded.has(kind)) continue;
      const grains = new Map();
      for (const node of inner.get(kind) ?? []) {
        if (node.type !== GRAIN) { add(node, 1); continue; }
        const what = node.name.replace(/ \d+$/, '');
        grains.set(what, [...grains.get(what) ?? [], node]);
      }
      // All grains of a kind have one row.
      for (const [what, nodes] of grains) {
        if (!text || what.toLowerCase().includes(text)) rows.push(this.row(`grains ${what}`, `${what}: ${nodes.length}`, nodes, 1, false));
      }
    }
    this.list.replaceChildren(...rows);
  }

  // A row about some nodes: what it hides and names.
  row(key, name, nodes, depth, isParent) {
    const row = document.createElement('div');
    row.className = 'thing';
    row.style.setProperty('--depth', Math.min(depth, 14));
    const toggle = (text, title, set, isOn) => {
      const button = pushButton(text, title, () => {
        for (const node of nodes) if (isOn) set.delete(node.id); else set.add(node.id);
        page.isDirty = true;
      });
      button.setAttribute('aria-pressed', String(isOn));
      button.setAttribute('aria-label', `${title}: ${name}`);
      return button;
    };
    const fold = pushButton(!isParent ? '' : this.folded.has(key) ? '▸' : '▾', isParent ? 'Fold or unfold' : '', () => {
      if (!this.folded.delete(key)) this.folded.add(key);
      page.isDirty = true;
    });
    fold.disabled = !isParent;
    fold.setAttribute('aria-label', `Fold or unfold ${name}`);
    const isHidden = nodes.every((node) => page.hidden.has(node.id));
    const [node] = nodes;
    const own = pushButton(name, nodes.length > 1 || key !== node.id ? `${nodes.length} things` : 'Select', () => {
      if (key === node.id) select(node.id);
      else fold.click();
    });
    own.className = 'name';
    if (key === page.selected) row.classList.add('chosen');
    row.append(fold, own,
      toggle('name', 'Name in the picture', page.labelled, nodes.every((one) => page.labelled.has(one.id))),
      toggle('hide', 'Hide', page.hidden, isHidden));
    return row;
  }
}

const sceneTree = new SceneTree($('scene-list'), $('scene-filter'));

// The names in the picture: of what is selected, and of what is to be named.
const labels = new Map();
function showLabels() {
  const named = new Set(page.labelled);
  if (page.selected !== null) named.add(page.selected);
  const names = [...named].map((id) => ({ key: id, text: scene.nodes.get(id)?.name, at: page.hidden.has(id) ? null : screenOf(id) }));
  const wanted = [...names, ...forceLabels(page.shown)];
  const keys = new Set(wanted.map(({ key }) => key));
  for (const [key, label] of labels) {
    if (keys.has(key)) continue;
    label.remove();
    labels.delete(key);
  }
  const box = canvas.getBoundingClientRect();
  for (const { key, text, at } of wanted) {
    let label = labels.get(key);
    if (!at) {
      if (label) label.hidden = true;
      continue;
    }
    if (!label) {
      label = element('span', text);
      label.className = typeof key === 'string' ? 'force' : '';
      labels.set(key, label);
      $('labels').append(label);
    }
    if (label.textContent !== text) label.textContent = text;
    label.hidden = false;
    label.style.left = `${at[0] - box.left}px`;
    label.style.top = `${at[1] - box.top}px`;
  }
}
