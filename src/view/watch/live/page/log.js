// The printed output, with its times.

const MOST_LINES = 1500;

class Log {
  constructor(list) {
    this.list = list;
    this.follow = true;
    list.addEventListener('scroll', () => {
      this.follow = list.scrollTop + list.clientHeight > list.scrollHeight - 30;
    });
    this.clear();
  }

  clear() {
    this.list.replaceChildren();
    this.lines = [];
    this.rest = '';
    this.time = Infinity;
  }

  hear(news) {
    if (news.halted !== undefined) {
      this.add(news.t, news.halted, 'halted');
      return;
    }
    // Text arrives in pieces, not in lines.
    const lines = (this.rest + news.text).split('\n');
    this.rest = lines.pop();
    if (this.rest.length > 2000) {
      lines.push(this.rest);
      this.rest = '';
    }
    for (const line of lines) if (line.trim()) this.addLine(news.t, line);
    if (this.rest && !news.text.endsWith('\n')) {
      // An incomplete line is shown at once.
      this.addLine(news.t, this.rest);
      this.rest = '';
    }
  }

  addLine(time, text) {
    const known = /^\[\(([^)]*)\) (DEBUG|INFO|WARN|ERROR)\] ([\d.]+): (.*)$/s.exec(text);
    if (known) this.add(Number(known[3]), known[4], known[2].toLowerCase(), known[1].toLowerCase());
    else this.add(time, text, /^WARNING/.test(text) ? 'warn' : '');
  }

  add(time, text, kind, tags) {
    const line = document.createElement('button');
    line.type = 'button';
    line.title = 'Go to this time';
    line.className = `line ${kind}`;
    const at = document.createElement('time');
    at.textContent = time.toFixed(2);
    const what = document.createElement('span');
    what.textContent = text;
    if (tags) {
      what.append(' ');
      const small = document.createElement('small');
      small.textContent = tags;
      what.append(small);
    }
    line.append(at, what);
    line.classList.toggle('later', time > this.time + 1e-6);
    line.tabIndex = -1;
    line.addEventListener('click', () => goTo(time));
    this.lines.push({ time, line, text, kind });
    this.list.append(line);
    if (this.lines.length > MOST_LINES) this.lines.shift().line.remove();
    if (this.follow && this.time === Infinity) this.list.scrollTop = this.list.scrollHeight;
  }

  // Shows the lines that had been printed by a time.
  render(time) {
    if (time === this.time) return;
    this.time = time;
    let last = null;
    for (const entry of this.lines) {
      const isLater = entry.time > time + 1e-6;
      entry.line.classList.toggle('later', isLater);
      if (!isLater) last = entry.line;
    }
    if (time === Infinity) this.list.scrollTop = this.list.scrollHeight;
    else if (last) this.list.scrollTop = last.offsetTop - this.list.offsetTop - this.list.clientHeight * 0.6;
  }
}
