// The robot's joints: positions against their limits, and plots of position and velocity over
// the time of the slider.

// Pieces of the past around the present time that are plotted.
const MOST_PLOTTED = 150;
const PLOT = 74;

class Joints {
  constructor(list, canvas) {
    Object.assign(this, { list, canvas, rows: [], chosen: new Set(), samples: new Map(), isLoading: false });
    canvas.addEventListener('click', (event) => {
      const box = canvas.getBoundingClientRect();
      const [start, end] = past.span;
      goTo(start + (event.clientX - box.left) / box.width * (end - start));
    });
  }

  clear() {
    this.rows = [];
    this.samples.clear();
    this.list.replaceChildren();
  }

  render(state, time) {
    if (page.tab !== 'joints' || !page.views) return;
    const { joints } = page.views;
    if (this.rows.length !== joints.length) this.makeRows(joints);
    if (!state.joints.length && past.span[1] > 0) this.list.dataset.empty = 'There are no joint positions here.';
    else delete this.list.dataset.empty;
    joints.forEach((joint, i) => {
      const at = state.joints[i];
      const row = this.rows[i];
      const text = at === undefined ? '' : `${at.toFixed(3)} ${joint.unit}`;
      if (row.value.textContent !== text) row.value.textContent = text;
      if (!joint.limits) return;
      const [low, high] = joint.limits;
      const share = Math.max(0, Math.min(1, (at - low) / (high - low || 1)));
      row.bar.style.setProperty('--at', share);
      row.bar.classList.toggle('near', share < 0.03 || share > 0.97);
    });
    if (this.chosen.size) this.gather(time);
    this.plot(time);
  }

  makeRows(joints) {
    this.rows = joints.map((joint, i) => {
      const row = pushButton('', joint.limits ? `Plot; limits ${joint.limits.map((v) => v.toFixed(3)).join(' to ')} ${joint.unit}` : 'Plot; without limits', () => {
        if (!this.chosen.delete(i)) this.chosen.add(i);
        row.setAttribute('aria-pressed', String(this.chosen.has(i)));
        page.isDirty = true;
      });
      row.className = 'joint';
      row.setAttribute('aria-pressed', String(this.chosen.has(i)));
      const [name, value, bar] = [element('span', joint.name), element('span', '', 'value'), element('i', '')];
      if (!joint.limits) bar.className = 'free';
      row.append(name, value, bar);
      return { row, value, bar };
    });
    // Those with limits are those that people look for.
    const order = [...this.rows.keys()].sort((a, b) => !joints[a].limits - !joints[b].limits);
    this.list.replaceChildren(...order.map((i) => this.rows[i].row));
  }

  // Gets the positions in the pieces of the past that are not here yet.
  async gather(time) {
    if (this.isLoading) return;
    this.isLoading = true;
    const { store, span } = past;
    const [first, last] = [store.numberAt(span[0]), store.numberAt(span[1])];
    const begin = Math.max(first, Math.min(store.numberAt(time) - MOST_PLOTTED / 2, last - MOST_PLOTTED));
    try {
      for (let piece = begin; piece <= Math.min(last, begin + MOST_PLOTTED) && past.store === store; piece++) {
        if (this.samples.get(piece)?.isWhole) continue;
        const isWhole = span[1] > store.end(piece) + 0.1 || page.isRecording;
        let joints = [];
        const list = [];
        for (const { t, whole, j } of await store.frames(piece)) {
          joints = whole ? [] : joints.slice();
          for (let i = 0; i + 2 <= (j?.length ?? 0); i += 2) joints[j[i]] = j[i + 1] * METRE;
          list.push([t, joints]);
        }
        this.samples.set(piece, { isWhole, list });
        page.isDirty = true;
      }
    } catch {
      // It is tried again with the next picture.
    }
    // What grows is asked for again, but not with every picture.
    setTimeout(() => { this.isLoading = false; }, page.isRecording ? 0 : 700);
  }

  plot(time) {
    const { canvas } = this;
    canvas.hidden = !this.chosen.size;
    if (canvas.hidden) return;
    const context = canvas.getContext('2d');
    const ratio = devicePixelRatio || 1;
    const width = canvas.clientWidth;
    const height = this.chosen.size * 2 * PLOT;
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    const colors = lanes.look();
    context.font = '10px system-ui, sans-serif';
    const [start, end] = past.span;
    const x = (t) => (t - start) / Math.max(0.01, end - start) * width;
    const samples = [...this.samples.keys()].sort((a, b) => a - b).flatMap((piece) => this.samples.get(piece).list);
    [...this.chosen].forEach((i, place) => {
      const joint = page.views.joints[i];
      const points = samples.filter(([, joints]) => joints[i] !== undefined).map(([t, joints]) => [t, joints[i]]);
      const speeds = points.slice(1).map(([t, v], k) => [t, (v - points[k][1]) / Math.max(1e-3, t - points[k][0])]);
      this.curve(context, colors, points, joint.limits, place * 2 * PLOT, width, x, `${joint.name} (${joint.unit})`, colors.accent);
      const most = joint.velocity ? [-joint.velocity, joint.velocity] : null;
      this.curve(context, colors, speeds, most, (place * 2 + 1) * PLOT, width, x, `velocity (${joint.unit}/s)`, colors.good);
    });
    context.fillStyle = colors.accent;
    context.fillRect(x(Math.min(time, end)) - 0.5, 0, 1, height);
  }

  curve(context, colors, points, limits, top, width, x, name, color) {
    const values = points.map(([, v]) => v);
    // The limits are shown where the curve comes near them.
    let low = Math.min(...values, Infinity), high = Math.max(...values, -Infinity);
    if (!points.length) [low, high] = limits ?? [-1, 1];
    const slack = Math.max(0.02, (high - low) * 0.12);
    [low, high] = [low - slack, high + slack];
    const y = (v) => top + 14 + (high - v) / (high - low) * (PLOT - 20);
    context.fillStyle = colors.faint;
    context.fillText(name, 2, top + 9);
    context.fillText(high.toFixed(2), width - 34, top + 9);
    context.fillText(low.toFixed(2), width - 34, top + PLOT - 2);
    context.strokeStyle = colors.bad;
    context.setLineDash([4, 3]);
    for (const limit of limits ?? []) {
      if (limit < low || limit > high) continue;
      context.beginPath();
      context.moveTo(0, y(limit));
      context.lineTo(width, y(limit));
      context.stroke();
    }
    context.setLineDash([]);
    context.strokeStyle = color;
    context.lineWidth = 1.2;
    context.beginPath();
    points.forEach(([t, v], i) => (i ? context.lineTo(x(t), y(v)) : context.moveTo(x(t), y(v))));
    context.stroke();
  }
}

const jointPanel = new Joints($('joint-list'), $('joint-plot'));
