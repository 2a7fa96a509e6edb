// The running plan: a tree of tasks and motions, as it was at a given time.

const MOST_TASKS = 3000;
const MOST_ROWS = 400;

// States of tasks that have not ended.
const UNFINISHED = ['running', 'suspended', 'stopped'];

class Tasks {
  constructor(list, count) {
    this.list = list;
    this.count = count;
    this.follow = true;
    list.addEventListener('scroll', () => {
      this.follow = list.scrollTop + list.clientHeight > list.scrollHeight - 40;
    });
    this.clear();
  }

  clear() {
    this.byId = new Map();
    this.roots = [];
    this.list.replaceChildren();
    this.rows = new Map();
    this.isDirty = true;
  }

  hear(news) {
    let task = this.byId.get(news.task);
    if (!task) {
      const parent = this.byId.get(news.parent) || null;
      task = {
        id: news.task, name: named(news.name), full: news.name, parent, children: [], since: news.t, changes: [],
        failure: '', depth: parent ? parent.depth + 1 : 0, folded: null, isMotion: news.task[0] === 'm',
      };
      this.byId.set(task.id, task);
      (parent ? parent.children : this.roots).push(task);
      if (this.byId.size > MOST_TASKS) this.forget();
    }
    task.changes.push([news.t, news.state]);
    if (news.failure) task.failure = news.failure;
    this.isDirty = true;
  }

  // Forgets the oldest plan first; of a plan that still runs, the oldest parts.
  forget() {
    let siblings = this.roots;
    while (siblings.length === 1 && siblings[0].children.length) siblings = siblings[0].children;
    const gone = siblings.shift();
    const drop = (task) => {
      this.byId.delete(task.id);
      task.children.forEach(drop);
    };
    if (gone) drop(gone);
  }

  // The state of a task at a time; undefined if it had not begun.
  static stateAt(task, time) {
    let state = null;
    for (const [t, name] of task.changes) {
      if (t > time) break;
      state = name;
    }
    return state;
  }

  render(time) {
    if (!this.isDirty && this.time === time) return;
    this.isDirty = false;
    this.time = time;
    const shown = [];
    let running = 0, failed = 0;
    const visit = (task, isHidden) => {
      const state = Tasks.stateAt(task, time);
      if (!state) return;
      if (!task.children.length) running += state === 'running';
      failed += state === 'failed';
      if (!isHidden) shown.push([task, state]);
      const isDone = state === 'succeeded' || state === 'evaporated';
      const isFolded = task.folded ?? (isDone && task.depth > 0 && !task.children.some((c) => Tasks.stateAt(c, time) === 'failed'));
      for (const child of task.children) visit(child, isHidden || isFolded);
    };
    this.roots.forEach((root) => visit(root, false));
    const rows = shown.slice(-MOST_ROWS).map(([task, state]) => this.row(task, state, time));
    if (!rows.length) {
      const empty = document.createElement('p');
      empty.className = 'empty';
      empty.textContent = 'No plan has run yet.';
      rows.push(empty);
    }
    const now = this.list.children;
    if (rows.length !== now.length || rows.some((row, i) => row !== now[i])) this.list.replaceChildren(...rows);
    this.count.textContent = failed ? `${failed} failed` : '';
    if (this.follow && time === Infinity) this.list.scrollTop = this.list.scrollHeight;
  }

  row(task, state, time) {
    let row = this.rows.get(task.id);
    if (!row) {
      row = document.createElement('div');
      for (const name of ['mark', 'name', 'took', 'why']) {
        const part = document.createElement('span');
        part.className = name;
        row.append(part);
      }
      row.style.setProperty('--depth', Math.min(task.depth, 12));
      row.addEventListener('click', () => {
        if (!task.children.length) return;
        task.folded = !row.classList.contains('folded');
        this.isDirty = true;
      });
      if (this.rows.size > 2 * MOST_TASKS) this.rows.clear();
      this.rows.set(task.id, row);
    }
    const isFolded = task.children.length && !!(task.folded ?? ((state === 'succeeded' || state === 'evaporated') && task.depth > 0 && !task.children.some((c) => Tasks.stateAt(c, time) === 'failed')));
    const kind = `task ${state}${task.isMotion ? ' motion' : ''}${task.children.length ? ' parent' : ''}${isFolded ? ' folded' : ''}`;
    if (row.className !== kind) row.className = kind;
    const [, ...parts] = row.children;
    const end = task.changes.findLast(([t]) => t <= time);
    const hasEnded = end && !UNFINISHED.includes(end[1]);
    // A failure is shown where it originates; the tasks around it failed for the same reason.
    const isOwn = !task.children.some((child) => child.failure === task.failure);
    const why = (state === 'failed' || state === 'stopped') && (isOwn || isFolded) ? task.failure : '';
    const texts = [task.name, hasEnded ? `${(end[0] - task.since).toFixed(1)} s` : '', why];
    parts.forEach((part, i) => {
      if (part.textContent !== texts[i]) part.textContent = texts[i];
      if (i === 2) part.hidden = !texts[i];
    });
    row.title = `${task.full} – ${state}, since ${task.since.toFixed(2)} s`;
    return row;
  }
}

// `[PICK-UP]-393` becomes `pick-up`, `[PAR-CHILD-#1/2]-394` becomes `par 1 of 2`.
function named(name) {
  const child = /^\[(.*)-CHILD-#(\d+)\/(\d+)\]-\d+$/.exec(name);
  if (child) return `${child[1].toLowerCase()} ${child[2]} of ${child[3]}`;
  const numbered = /^\[(.*)\]-\d+$/.exec(name);
  const plain = (numbered ? numbered[1] : name).toLowerCase();
  return plain.replace(/^(top-level-)?top-level$/, 'plan').replace(/-top-level$/, '');
}
