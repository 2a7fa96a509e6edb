// The plan over the slider: a lane for each branch, a bar for each task and motion, failures
// marked, and a tick for each line of the log.

const LANE = 13;
const TICKS = 9;
// The line with the times.
const AXIS = 14;
// Bars narrower than this (pixels) are drawn and hit as if they were as wide.
const LEAST = 3;

class Lanes {
  constructor(canvas, tip, tasks, log) {
    Object.assign(this, { canvas, tip, tasks, log, bars: [], rows: 0, version: -1, hover: null });
    this.context = canvas.getContext('2d');
    canvas.addEventListener('pointermove', (event) => this.point(event));
    canvas.addEventListener('pointerleave', () => this.leave());
    canvas.addEventListener('click', (event) => this.click(event));
    canvas.addEventListener('keydown', (event) => this.type(event));
    canvas.addEventListener('dblclick', () => this.show(null));
    canvas.addEventListener('wheel', (event) => this.wheel(event), { passive: false });
    // The part of the time that is shown; null for all.
    this.part = null;
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { this.colors = null; });
  }

  // Places the bars: branches that run at the same time are below each other.
  place(end) {
    const last = (task) => task.end ?? end;
    this.bars = [];
    const block = (task) => {
      const { parts, height } = pack(task.children);
      return { task, parts, height: height + 1, begin: task.since, end: Math.max(last(task), task.since) };
    };
    const pack = (tasks) => {
      const placed = [];
      let open = [], height = 0;
      for (const task of tasks) {
        const one = block(task);
        open = open.filter((other) => other.end > one.begin);
        one.row = 0;
        // The first gap that is high enough.
        for (const other of open.sort((a, b) => a.row - b.row)) {
          if (one.row + one.height <= other.row) break;
          one.row = Math.max(one.row, other.row + other.height);
        }
        open.push(one);
        placed.push(one);
        height = Math.max(height, one.row + one.height);
      }
      return { parts: placed, height };
    };
    const add = (parts, above) => {
      for (const { task, parts: inner, row } of parts) {
        this.bars.push({ task, row: above + row });
        add(inner, above + row + 1);
      }
    };
    const { parts, height } = pack(this.tasks.roots);
    add(parts, 0);
    this.rows = height;
  }

  // Shows a part of the time, or with null all of it.
  show(part) {
    const [start, end] = past.span;
    if (part) {
      const length = Math.max(0.2, part[1] - part[0]);
      const from = Math.max(start, Math.min(end - length, part[0]));
      this.part = length < (end - start) * 0.98 ? [from, from + length] : null;
    } else {
      this.part = null;
    }
    page.isDirty = true;
  }

  // The time that lanes and slider show; it goes with the time that the page shows.
  shown() {
    if (!this.part) return past.span;
    const [from, to] = this.part;
    const now = page.time ?? past.span[1];
    if (page.isPlaying && (now < from || now > to)) this.show([now, now + to - from]);
    return this.part ?? past.span;
  }

  // The wheel zooms about the time that is pointed at, or moves to the side.
  wheel(event) {
    event.preventDefault();
    const [from, to] = this.shown();
    const pixels = (delta) => Math.max(-300, Math.min(300, delta * [1, 30, 400][event.deltaMode]));
    const at = this.timeAt(event.clientX - this.canvas.getBoundingClientRect().left);
    const scale = Math.exp(pixels(event.shiftKey ? 0 : event.deltaY) * 0.002);
    const aside = pixels(event.shiftKey ? event.deltaY : event.deltaX) / this.canvas.clientWidth * (to - from);
    this.show([at + (from - at) * scale + aside, at + (to - at) * scale + aside]);
  }

  render(time, [, end], selected) {
    const { canvas, context } = this;
    const [start, stop] = this.shown();
    const width = canvas.clientWidth;
    // What still runs gets longer.
    const isNew = this.version !== this.tasks.version || (this.end !== end && this.tasks.isRunning);
    const key = [width, devicePixelRatio, start, stop, end, time, selected?.id, this.hover?.x, this.log.lines.length].join();
    if (!isNew && key === this.key && this.colors) return;
    // Of many tasks, the places are found anew only now and then.
    const isDue = this.bars.length < 300 || performance.now() - this.placed > 250;
    if (isNew && isDue) {
      this.place(end);
      this.placed = performance.now();
    }
    Object.assign(this, { key, version: isNew && !isDue ? -1 : this.tasks.version, end, start, stop });
    const height = this.rows * LANE + TICKS + AXIS;
    canvas.style.height = `${height}px`;
    $('lanes').hidden = !this.bars.length && !this.log.lines.length;
    const ratio = devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    this.colors ??= this.look();
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    context.clearRect(0, 0, width, height);
    context.font = '10px system-ui, sans-serif';
    context.textBaseline = 'middle';
    for (const bar of this.bars) this.drawBar(bar, time, end, selected);
    for (const { time: at, kind } of this.log.lines) {
      context.fillStyle = { error: this.colors.bad, halted: this.colors.bad, warn: this.colors.warn }[kind] ?? this.colors.faint;
      context.fillRect(this.x(at) - 0.5, height - TICKS - AXIS + 2, kind === 'error' || kind === 'halted' ? 2 : 1, TICKS - 2);
    }
    this.drawAxis(height);
    const line = (at, color) => {
      if (at < start || at > stop) return;
      context.fillStyle = color;
      context.fillRect(this.x(at) - 0.75, 0, 1.5, height);
    };
    if (this.hover) line(this.hover.time, this.colors.faint);
    line(Math.min(time, end), this.colors.accent);
  }

  // Times below the bars, at round numbers of seconds.
  drawAxis(height) {
    const { context, colors, start, stop } = this;
    const least = (stop - start) * 64 / Math.max(1, this.canvas.clientWidth - 16);
    const step = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600].find((one) => one >= least) ?? least;
    context.textAlign = 'center';
    for (let at = Math.ceil(start / step - 1e-9); at * step <= stop + 1e-9; at += 1) {
      const x = this.x(at * step);
      context.fillStyle = colors.line;
      context.fillRect(x - 0.5, height - AXIS, 1, 3);
      context.fillStyle = colors.soft;
      const text = `${Number((at * step).toFixed(1))} s`;
      const half = context.measureText(text).width / 2;
      context.fillText(text, Math.max(half, Math.min(this.canvas.clientWidth - half, x)), height - AXIS / 2 + 2);
    }
    context.textAlign = 'left';
  }

  // As much of a name as fits; nothing if that would say nothing.
  fitted(name, width) {
    const { context } = this;
    if (context.measureText(name).width <= width) return name;
    const most = Math.floor(width / context.measureText('n').width) - 1;
    return most >= 3 ? `${name.slice(0, most)}…` : '';
  }

  drawBar({ task, row }, time, end, selected) {
    const { context, colors } = this;
    let [from, to] = this.extent(task, end);
    if (to < 0 || from > this.canvas.clientWidth) return;
    // What begins before is named where it is seen.
    [from, to] = [Math.max(-2, from), Math.min(this.canvas.clientWidth + 2, to)];
    const top = row * LANE + 1;
    const state = Tasks.stateAt(task, Infinity);
    const isOwn = state === 'failed' && Tasks.isOrigin(task);
    const color = { succeeded: colors.good, failed: colors.bad, stopped: colors.bad, running: colors.accent, suspended: colors.warn }[state] ?? colors.faint;
    context.globalAlpha = task.since > time ? 0.45 : 1;
    context.fillStyle = colors.panel;
    context.fillRect(from, top, to - from, LANE - 2);
    context.fillStyle = color;
    context.globalAlpha *= isOwn ? 0.85 : task.what === 'task' ? 0.22 : task.what === 'motion' ? 0.62 : 0.38;
    context.fillRect(from, top, to - from, LANE - 2);
    context.globalAlpha = task.since > time ? 0.45 : 1;
    context.fillRect(from, top, 1, LANE - 2);
    if (isOwn) {
      // Where it failed.
      context.beginPath();
      context.moveTo(to - 5, top);
      context.lineTo(to + 2, top);
      context.lineTo(to + 2, top + 7);
      context.fill();
    }
    const label = to - from > 20 ? this.fitted(task.name, to - from - 6) : '';
    if (label) {
      context.globalAlpha = 1;
      context.fillStyle = isOwn && task.since <= time ? colors.panel : colors.ink;
      context.fillText(label, from + 4, top + LANE / 2 - 0.5);
    }
    context.globalAlpha = 1;
    if (task === selected) {
      context.strokeStyle = colors.accent;
      context.lineWidth = 1.5;
      context.strokeRect(from + 0.5, top - 0.25, to - from - 1, LANE - 1.5);
    }
  }

  look() {
    const style = getComputedStyle(document.documentElement);
    const names = ['good', 'bad', 'warn', 'accent', 'faint', 'ink', 'panel', 'line', 'soft'];
    return Object.fromEntries(names.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
  }

  // The slider's thumb is 16 pixels wide: its middle does not get to the ends.
  x(time) { return 8 + (time - this.start) / Math.max(0.01, this.stop - this.start) * (this.canvas.clientWidth - 16); }

  timeAt(x) {
    const share = (x - 8) / Math.max(1, this.canvas.clientWidth - 16);
    return this.start + Math.max(0, Math.min(1, share)) * (this.stop - this.start);
  }

  extent(task, end) {
    const from = this.x(task.since);
    return [from, Math.max(from + LEAST, this.x(task.end ?? end))];
  }

  // The task and the line of the log at a point of the canvas.
  at(x, y) {
    const row = Math.floor(y / LANE);
    if (y >= this.rows * LANE) {
      const near = this.log.lines.filter((line) => Math.abs(this.x(line.time) - x) < 4);
      const distance = (line) => Math.abs(this.x(line.time) - x);
      return { line: near.sort((a, b) => distance(a) - distance(b))[0] ?? null, task: null };
    }
    const found = this.bars.filter((bar) => bar.row === row).findLast(({ task }) => {
      const [from, to] = this.extent(task, this.end);
      return x >= from - 1 && x <= to + 1;
    });
    return { task: found?.task ?? null, line: null };
  }

  point(event) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const { task, line } = this.at(x, y);
    const time = this.timeAt(x);
    this.hover = { x, time };
    showPath(task ?? page.task);
    const state = task && Tasks.stateAt(task, Infinity);
    const took = task && task.end !== null ? `, ${(task.end - task.since).toFixed(1)} s` : '';
    const texts = task ? [task.name, `${state}${took}`, state === 'failed' ? task.failure : ''] : [line ? line.text : '', '', ''];
    this.tip.replaceChildren(...[`${time.toFixed(2)} s`, ...texts].filter(Boolean).map((text, i) => {
      const part = document.createElement(i === 1 ? 'b' : 'span');
      part.textContent = text.length > 160 ? `${text.slice(0, 160)}…` : text;
      return part;
    }));
    this.tip.hidden = false;
    const left = Math.max(4, Math.min(innerWidth - this.tip.offsetWidth - 4, event.clientX - this.tip.offsetWidth / 2));
    this.tip.style.left = `${left}px`;
    this.tip.style.top = `${$('transport').getBoundingClientRect().top - this.tip.offsetHeight - 6}px`;
    this.canvas.style.cursor = task || line ? 'pointer' : 'default';
    // The scene shows the moment pointed at, if the pointer stays.
    clearTimeout(this.wait);
    if (event.pointerType === 'mouse') this.wait = setTimeout(() => { peek(this.hover?.time ?? null); }, 150);
    page.isDirty = true;
  }

  // Arrow keys go to the task before or after, around or within; plus and minus zoom.
  type(event) {
    const zoom = (factor) => {
      const [from, to] = this.shown();
      const at = Math.max(from, Math.min(to, page.time ?? to));
      this.show([at + (from - at) * factor, at + (to - at) * factor]);
    };
    const { task } = page;
    const siblings = (task?.parent ? task.parent.children : this.tasks.roots) ?? [];
    const beside = (way) => siblings[siblings.indexOf(task) + way];
    const ways = {
      ArrowLeft: () => (task ? beside(-1) : this.tasks.roots.at(-1)), ArrowRight: () => (task ? beside(1) : this.tasks.roots[0]),
      ArrowUp: () => task?.parent, ArrowDown: () => (task ? task.children[0] : this.tasks.roots[0]),
      '+': () => zoom(0.7), '=': () => zoom(0.7), '-': () => zoom(1 / 0.7), 0: () => this.show(null),
    };
    if (!ways[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    event.stopPropagation();
    const next = ways[event.key]();
    if (next) selectTask(next);
  }

  leave() {
    clearTimeout(this.wait);
    this.hover = null;
    this.tip.hidden = true;
    showPath(page.task);
    peek(null);
  }

  click(event) {
    const box = this.canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    const { task, line } = this.at(x, y);
    this.leave();
    if (task) selectTask(task);
    else goTo(line ? line.time : this.timeAt(x));
  }
}

// The way to a task: the tasks around it, and itself.
function showPath(task) {
  const names = [];
  for (let at = task; at; at = at.parent) names.unshift(at.name);
  const last = names.pop();
  const path = $('path');
  const text = last ? [...names, last].join(' › ') : '';
  if (path.dataset.text === text) return;
  path.dataset.text = text;
  path.title = text;
  path.replaceChildren(...(last ? [names.map((name) => `${name} › `).join(''), element('b', last)] : []));
}

// Shows another time than the page's, without going there; with null no more.
function peek(time) {
  if (page.peek === time) return;
  page.peek = time;
  page.isDirty = true;
}

const lanes = new Lanes($('lane-canvas'), $('tip'), tasks, log);

// The times at which something failed, in order, with the task if it is known.
function failures() {
  const failed = [];
  for (const task of tasks.all()) {
    for (const [t, state] of task.changes) {
      if ((state === 'failed' || state === 'stopped') && Tasks.isOrigin(task)) failed.push({ t, task });
    }
  }
  for (const { time, kind } of log.lines) if (kind === 'halted') failed.push({ t: time, task: null });
  return failed.sort((a, b) => a.t - b.t);
}

let silence;

// Goes to the next (1) or the previous (-1) of some moments.
function step(moments, way) {
  const now = page.time ?? past.span[1];
  const off = (moment) => (moment.t - now) * way;
  // Several things may happen at the same time: those are gone through one after the other.
  const here = moments.findIndex((m) => m.task && m.task === page.task && Math.abs(m.t - now) < 1e-3);
  const same = here >= 0 && moments[here + way] && Math.abs(moments[here + way].t - now) < 1e-3 ? moments[here + way] : null;
  const found = same ?? (way > 0 ? moments.find((m) => off(m) > 1e-3) : moments.findLast((m) => off(m) > 1e-3));
  notice('step', found ? '' : moments.length ? `There is none ${way > 0 ? 'after' : 'before'} this.` : 'There is none.');
  clearTimeout(silence);
  silence = setTimeout(() => notice('step', ''), 2500);
  if (!found) return;
  if (found.task) selectTask(found.task, found.t);
  else goTo(found.t);
}

const stepFailure = (way) => step(failures(), way);
const stepLine = (way) => step(log.lines.map(({ time }) => ({ t: time })), way);

for (const [id, go] of [['failure-back', () => stepFailure(-1)], ['failure-on', () => stepFailure(1)], ['line-back', () => stepLine(-1)], ['line-on', () => stepLine(1)]]) {
  $(id).addEventListener('click', go);
}
