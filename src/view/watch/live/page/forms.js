// What can be typed at the prompt about what was clicked: the page only writes it down, for the
// user to paste. Also distances between two clicks, and places to which things are dragged.

const number = (v) => String(Number(v.toFixed(3)));
const listed = (values) => `(${values.map(number).join(' ')})`;
const poseText = (place) => `(${listed(place.slice(0, 3))} ${listed(place.slice(3))})`;

// A name as the reader takes it for one symbol, whatever it contains.
const symbolText = (name) => (/^[A-Z][A-Z0-9_-]*$/.test(name) ? name.toLowerCase() : `|${name.replaceAll(/[\\|]/g, '\\$&')}|`);

// A list of forms, each with a button that copies it.
function formList(forms) {
  const list = document.createElement('ul');
  list.className = 'forms';
  for (const [what, form] of forms) {
    const item = document.createElement('li');
    const button = pushButton(form, `Copy: ${what}`, () => copy(form, button));
    button.className = 'form';
    item.append(element('small', what), button);
    list.append(item);
  }
  return list;
}

async function copy(text, button) {
  let isDone = true;
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    // Without the permission, the text is selected and copied as if by hand.
    const field = document.createElement('textarea');
    field.value = text;
    document.body.append(field);
    field.select();
    isDone = document.execCommand('copy');
    field.remove();
  }
  button.dataset.copied = isDone ? 'copied' : 'press Ctrl-C';
  setTimeout(() => delete button.dataset.copied, 1500);
}

// The forms about a node, and about the point of it that was clicked.
function formsOf(node) {
  const forms = [];
  const place = scene.place(node, page.shown);
  const name = symbolText(node.name);
  const { moved, clicked } = page;
  if (moved?.id === node.id) {
    const edit = node.kind === 'robot' ? '(move-robot ' : `(move-object '${name} `;
    forms.push(['puts it here', `${edit}'${poseText(moved.place)})`]);
  }
  if (node.kind === 'object') {
    forms.push(['its name', `'${name}`], ['a designator', `(an object (name ${name}))`]);
  } else if (node.kind === 'furniture') {
    const urdf = symbolText(node.name.replaceAll('_', '-').toUpperCase());
    forms.push(['on it', `(a location (on (an object (urdf-name ${urdf}) (part-of kitchen))))`]);
  }
  if (place && !moved) forms.push(['its pose', `(make-pose "map" '${poseText(place)})`]);
  if (clicked?.id === node.id && !moved) {
    forms.push(['this point', `(make-pose "map" '${poseText([...clicked.at, 0, 0, 0, 1])})`]);
  }
  return [formList(forms)];
}

// Distances.

// Sets the first or the second point of a measurement; with null ends it.
function measure(at) {
  if (!at) page.measured = null;
  else if (!page.measured?.length || page.measured.length === 2) page.measured = [at];
  else page.measured = [page.measured[0], at];
  const [a, b] = page.measured ?? [];
  const ruler = $('ruler');
  ruler.hidden = !page.isMeasuring;
  if (page.isMeasuring) {
    const off = b && minus(b, a);
    ruler.textContent = b
      ? `${length(off).toFixed(3)} m   Δx ${off[0].toFixed(3)}  Δy ${off[1].toFixed(3)}  Δz ${off[2].toFixed(3)}  level ${Math.hypot(off[0], off[1]).toFixed(3)}`
      : a ? `from ${a.map((v) => v.toFixed(3)).join('  ')}: click the other point` : 'Click two points.';
  }
  page.isDirty = true;
}

// Dragging things.

// Begins to drag what is seen at a point, if it can be moved: an object, or the robot by any of
// its links. Only what stands still can be dragged.
function beginDrag(found) {
  const isStill = page.time !== null || !page.pace || page.pace.paused || page.halt;
  const node = scene.nodes.get(found?.id);
  if (!page.isDragging || !isStill || !node || node.kind === 'furniture') return null;
  const moved = node.kind === 'robot' ? scene.nodes.get(page.views.base) : node;
  const place = page.moved?.id === moved.id ? page.moved.place : scene.place(moved, page.shown);
  if (!place) return null;
  page.selected = moved.id;
  page.task = null;
  return { id: moved.id, from: place, height: found.at[2], offset: minus(place, found.at) };
}

// Moves what is dragged to where the pointer meets the level at which it was taken.
function drag(dragged, event) {
  const { eye, matrix, fov } = bodyView(page.shown);
  const way = rayAt(event, matrix, fov);
  const distance = (dragged.height - eye[2]) / way[2];
  if (!(distance > 0.05 && distance < 30)) return;
  const at = add(eye, times(way, distance));
  const place = [at[0] + dragged.offset[0], at[1] + dragged.offset[1], dragged.from[2], ...dragged.from.slice(3)];
  page.moved = { id: dragged.id, place };
  page.isDirty = true;
}

// The state in which something has been dragged elsewhere.
function dragged(state) {
  const { moved } = page;
  if (!moved) return state;
  const node = scene.nodes.get(moved.id);
  const places = new Map(state.places);
  if (node?.kind === 'robot') {
    const base = state.places.get(moved.id);
    if (!base) return state;
    const held = new Set(state.held.map(([id]) => id));
    for (const [id, place] of state.places) {
      if (scene.nodes.get(id)?.kind !== 'robot' && !held.has(id)) continue;
      places.set(id, combined(moved.place, within(base, place)));
    }
  } else {
    places.set(moved.id, moved.place);
  }
  return { ...state, places };
}
