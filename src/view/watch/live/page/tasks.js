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
    list.addEventListener('keydown', (event) => this.key(event));
    this.clear();
  }

  clear() {
    this.version = (this.version ?? 0) + 1;
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
      // The function that carries out an action is that action.
      if (parent?.what === 'action' && /^\[(?!.*CHILD-#).*\]-\d+$/.test(news.name)) {
        this.byId.set(news.task, parent);
        parent.functions.push(news.task);
        return;
      }
      task = {
        id: news.task, name: named(news.name), full: news.name, parent, children: [], since: news.t, changes: [],
        failure: '', depth: parent ? parent.depth + 1 : 0, folded: null, end: null, about: news.about ?? null, result: '',
        functions: [],
        what: { m: 'motion', a: 'action' }[news.task[0]] ?? 'task',
      };
      this.byId.set(task.id, task);
      (parent ? parent.children : this.roots).push(task);
      if (this.byId.size > MOST_TASKS) this.forget();
    }
    // The action itself tells its end.
    if (task.id !== news.task && !UNFINISHED.includes(news.state)) return;
    task.changes.push([news.t, news.state]);
    task.end = UNFINISHED.includes(news.state) ? null : news.t;
    if (news.failure) task.failure = news.failure;
    if (news.result) task.result = news.result;
    this.isDirty = true;
    this.version += 1;
  }

  // Forgets the oldest plan first; of a plan that still runs, the oldest parts.
  forget() {
    let siblings = this.roots;
    while (siblings.length === 1 && siblings[0].children.length) siblings = siblings[0].children;
    const gone = siblings.shift();
    const drop = (task) => {
      [task.id, ...task.functions].forEach((id) => this.byId.delete(id));
      task.children.forEach(drop);
    };
    if (gone) drop(gone);
  }

  // All tasks, in the order in which they began.
  all() { return [...new Set(this.byId.values())]; }

  // Whether any plan has not ended.
  get isRunning() { return this.roots.some((task) => task.end === null); }

  // Whether a failure originates in this task: the tasks around it failed for the same reason.
  static isOrigin(task) { return !task.children.some((child) => child.failure && child.failure === task.failure); }

  // Unfolds what a task is in, and shows its row.
  reveal(task) {
    for (let above = task.parent; above; above = above.parent) above.folded = false;
    this.revealed = task;
    this.isDirty = true;
  }

  // Moves among the rows, folds and unfolds with the arrow keys.
  key(event) {
    const row = event.target.closest('.task');
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) {
      const rows = [...this.list.querySelectorAll('.task')];
      const next = rows[row ? rows.indexOf(row) + step : 0];
      next?.focus();
      next?.scrollIntoView({ block: 'nearest' });
    } else if (row && (event.key === 'ArrowLeft' || event.key === 'ArrowRight')) {
      const task = this.byId.get(row.dataset.task);
      if (task?.children.length) task.folded = event.key === 'ArrowLeft';
      this.isDirty = true;
    } else if (row && event.key === 'Enter') {
      row.click();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
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
    // A tree has to have an item.
    this.list.setAttribute('role', shown.length ? 'tree' : 'group');
    const now = this.list.children;
    if (rows.length !== now.length || rows.some((row, i) => row !== now[i])) this.list.replaceChildren(...rows);
    const chosen = page.task?.id;
    for (const row of rows) if (row.dataset.task) row.setAttribute('aria-selected', String(row.dataset.task === chosen));
    this.count.textContent = failed ? `${failed} failed` : '';
    const revealed = this.revealed && this.rows.get(this.revealed.id);
    if (revealed?.isConnected) {
      revealed.scrollIntoView({ block: 'nearest' });
      this.revealed = null;
      this.follow = false;
    } else if (this.follow && time === Infinity) this.list.scrollTop = this.list.scrollHeight;
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
      row.dataset.task = task.id;
      row.tabIndex = -1;
      row.setAttribute('role', 'treeitem');
      row.setAttribute('aria-level', task.depth + 1);
      row.firstChild.title = 'Fold or unfold';
      row.addEventListener('click', (event) => {
        if (event.target === row.firstChild && task.children.length) {
          task.folded = !row.classList.contains('folded');
          this.isDirty = true;
        } else {
          selectTask(task);
        }
      });
      if (this.rows.size > 2 * MOST_TASKS) this.rows.clear();
      this.rows.set(task.id, row);
    }
    const isFolded = task.children.length && !!(task.folded ?? ((state === 'succeeded' || state === 'evaporated') && task.depth > 0 && !task.children.some((c) => Tasks.stateAt(c, time) === 'failed')));
    const kind = `task ${state}${task.what === 'task' ? '' : ` ${task.what}`}${task.children.length ? ' parent' : ''}${isFolded ? ' folded' : ''}`;
    if (row.className !== kind) row.className = kind;
    if (task.children.length) row.setAttribute('aria-expanded', String(!isFolded));
    const [, ...parts] = row.children;
    const end = task.changes.findLast(([t]) => t <= time);
    const hasEnded = end && !UNFINISHED.includes(end[1]);
    // A failure is shown where it originates; the tasks around it failed for the same reason.
    const isOwn = Tasks.isOrigin(task);
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
