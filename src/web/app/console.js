// The prompt: what has been typed and shown, and the editor of the next input.

import { insertNewlineAndIndent } from '@codemirror/commands';
import { completionStatus } from '@codemirror/autocomplete';
import { makeEditor, setText, textOf } from './lisp_editor.js';

// Number of pieces and of characters that are kept of what was shown.
const MAX_PIECES = 4000, MAX_CHARACTERS = 1000000;
// Characters of one piece.
const MAX_PIECE = 20000;

const element = (name, className, text) => {
  const made = document.createElement(name);
  if (className) made.className = className;
  if (text !== undefined) made.textContent = text;
  return made;
};

export class Console {
  constructor(engine, root) {
    this.engine = engine;
    this.lines = root.querySelector('#lines');
    this.prompt = root.querySelector('#prompt-name');
    this.hint = root.querySelector('#hint');
    this.progress = root.querySelector('#progress');
    this.stop = root.querySelector('#stop');
    this.past = [];
    // Lines at whose end Enter was pressed, until it is known what it does.
    this.entered = [];
    this.at = 0;
    this.draft = '';
    this.last = null;
    this.characters = 0;
    this.isAway = false;
    this.lines.addEventListener('scroll', () => {
      this.isAway = this.lines.scrollHeight - this.lines.scrollTop - this.lines.clientHeight > 60;
    });
    const engineKeys = [
      { key: 'Enter', run: () => this.enter() },
      { key: 'Shift-Enter', run: insertNewlineAndIndent },
      { key: 'ArrowUp', run: () => this.recall(-1) },
      { key: 'ArrowDown', run: () => this.recall(1) },
      { key: 'Ctrl-c', run: (view) => view.state.selection.main.empty && this.interrupt() },
      { key: 'Ctrl-l', run: () => this.clear() },
    ];
    this.editor = makeEditor({
      parent: root.querySelector('#typed'), engine, label: 'Next input', keys: engineKeys, onChange: (update) => { this.keepPlaces(update); this.showHint(); },
    });
    this.stop.addEventListener('click', () => { this.interrupt(); this.editor.focus(); });
    this.lines.addEventListener('click', (event) => {
      if (event.target === this.lines && !getSelection().toString()) this.editor.focus();
    });
    const on = (name, hear) => engine.addEventListener(name, ({ detail }) => hear(detail));
    on('begin', () => { this.setBusy(true); });
    on('open', ({ prompt }) => { this.prompt.textContent = `${prompt}>`; });
    on('idle', () => this.setBusy(false));
    on('input', (input) => this.showInput(input));
    on('message', (message) => this.showMessage(message));
    on('bytes', ({ what, bytes }) => { if (what === 'picture') this.showPicture(bytes); });
    on('done', (done) => this.finish(done));
    on('remark', ({ text }) => this.remark(text));
    on('again', ({ at, of }) => {
      this.isAgain = at < of;
      if (at < of) this.progress.textContent = `The session comes back: input ${at + 1} of ${of}. Ctrl-C stops that.`;
      else this.progress.textContent = '';
    });
  }

  setBusy(isBusy) {
    this.stop.hidden = !isBusy;
    document.body.classList.toggle('busy', isBusy);
    if (!isBusy && !this.isAgain) this.progress.textContent = '';
  }

  clear() {
    this.flush();
    this.lines.replaceChildren();
    this.characters = 0;
    this.last = null;
    return true;
  }

  interrupt() {
    if (this.engine.isBusy) this.engine.interrupt();
    else if (textOf(this.editor)) this.replace('');
    return true;
  }

  // Enter evaluates a whole input, and continues another on a new line. The session knows which it is;
  // keys that are pressed before it has answered lose nothing.
  enter() {
    if (completionStatus(this.editor.state) === 'active' || !this.editor.state.selection.main.empty) return false;
    const { head } = this.editor.state.selection.main;
    const line = { end: head, rest: head };
    this.entered.push(line);
    this.entering = (this.entering ?? Promise.resolve()).then(() => this.enterNow(line));
    return true;
  }

  // What is typed after Enter, while it is being found out whether the input is whole, is between `end` and `rest`: it
  // comes after the line's end, or after the input. More than one Enter may wait.
  keepPlaces({ changes }) {
    for (const line of this.entered) {
      line.end = changes.mapPos(line.end, -1);
      line.rest = changes.mapPos(line.rest, 1);
    }
  }

  async enterNow(line) {
    const textNow = () => {
      const text = textOf(this.editor);
      return text.slice(0, line.end) + text.slice(line.rest);
    };
    const { whole } = await this.engine.ask('enter', { text: textNow() }, true);
    // The text may have been replaced by another one.
    if (!this.entered.includes(line)) return;
    const text = textNow(), { doc, selection: { main: { head } } } = this.editor.state;
    if (whole || !text.trim()) {
      this.editor.dispatch({ changes: [{ from: 0, to: line.end }, { from: line.rest, to: doc.length }] });
      this.add(text);
    } else {
      const isBehind = head > line.end;
      this.editor.dispatch({ selection: { anchor: line.end } });
      insertNewlineAndIndent(this.editor);
      if (isBehind) this.editor.dispatch({ selection: { anchor: head + this.editor.state.doc.length - doc.length } });
    }
    this.entered = this.entered.filter((other) => other !== line);
  }

  // Another text takes the place of what is typed.
  replace(text) {
    this.entered = [];
    setText(this.editor, text);
  }

  // Evaluates an input as if it had been typed.
  add(text) {
    if (text.trim()) {
      if (this.past.at(-1) !== text) this.past.push(text);
      this.at = this.past.length;
    }
    return this.engine.run({ text });
  }

  recall(step) {
    const { state } = this.editor;
    const line = state.doc.lineAt(state.selection.main.head);
    if (step < 0 ? line.number > 1 : line.number < state.doc.lines) return false;
    const at = this.at + step;
    if (at < 0 || at > this.past.length) return true;
    if (this.at === this.past.length) this.draft = textOf(this.editor);
    this.at = at;
    this.replace(at === this.past.length ? this.draft : this.past[at]);
    return true;
  }

  showHint() {
    clearTimeout(this.hinting);
    this.hinting = setTimeout(async () => {
      const text = textOf(this.editor);
      const at = this.editor.state.selection.main.head;
      const { hint } = text.trim() ? await this.engine.ask('hint', { text, at }) : {};
      if (textOf(this.editor) !== text) return;
      // The parameter at the cursor stands between stars.
      const parts = (hint ?? '').split(/(?<=[( ])\*(.+?)\*(?=[) ])/);
      this.hint.replaceChildren(...parts.map((part, number) => (number % 2 ? element('b', '', part) : part)));
    }, 120);
  }

  append(made) {
    this.flush();
    this.lines.append(made);
    this.characters += made.textContent.length;
    this.trim();
    this.follow();
    return made;
  }

  // Forgets the oldest.
  trim() {
    while (this.lines.childElementCount > MAX_PIECES || (this.characters > MAX_CHARACTERS && this.lines.childElementCount > 1)) {
      this.characters -= this.lines.firstElementChild.textContent.length;
      this.lines.firstElementChild.remove();
    }
  }

  // The end stays in sight, unless somebody has scrolled away from it.
  follow() {
    if (this.isAway) return;
    cancelAnimationFrame(this.following);
    this.following = requestAnimationFrame(() => { this.lines.scrollTop = this.lines.scrollHeight; });
  }

  toEnd() {
    this.isAway = false;
    this.follow();
  }

  // Text is shown with the next picture of the screen, however many pieces it comes in.
  write(text, kind) {
    if (this.written?.kind !== kind || this.written.text.length > MAX_PIECE) this.flush();
    this.written ??= { kind, text: '' };
    this.written.text += text;
    this.flushing ??= setTimeout(() => this.flush(), 30);
  }

  flush() {
    clearTimeout(this.flushing);
    this.flushing = null;
    const { written } = this;
    this.written = null;
    if (!written) return;
    if (this.last?.className === written.kind && this.last.textContent.length < MAX_PIECE) {
      this.last.append(written.text);
      this.characters += written.text.length;
      this.trim();
      this.follow();
    } else this.last = this.append(element('span', written.kind, written.text));
  }

  showInput(input) {
    this.flush();
    this.last = null;
    const line = element('div', 'input');
    const name = input.file ? `; ${input.file}` : this.prompt.textContent;
    line.append(element('b', 'prompt', `${name} `), element('code', '', input.file ? '' : input.text));
    this.append(line);
    this.toEnd();
    this.endRestarts();
  }

  showMessage(message) {
    if (message.text !== undefined) this.write(message.text, message.kind);
    else if (message.progress !== undefined) this.progress.textContent = message.progress;
    else if (message.stopped) this.showRestarts();
    else if (message.failed) this.remark(message.failed);
    else if (message.panic) this.remark(`This is a defect of planwright: ${message.panic}`);
  }

  // In the list of restarts that has just been written, each line becomes a button.
  showRestarts() {
    this.flush();
    const shown = this.last;
    this.last = null;
    if (!shown) return;
    const parts = shown.textContent.split(/^( *\d+: .*)\n/m);
    shown.replaceChildren(...parts.flatMap((part, at) => {
      if (at % 2 === 0) return [part];
      const button = element('button', 'restart', part.trim());
      button.type = 'button';
      const number = String(parseInt(part, 10));
      button.addEventListener('click', () => { this.add(number); this.editor.focus(); });
      return [button, '\n'];
    }));
    this.toEnd();
  }

  endRestarts() {
    for (const button of this.lines.querySelectorAll('.restart')) button.disabled = true;
  }

  showPicture(bytes) {
    const image = element('img');
    image.src = URL.createObjectURL(new Blob([bytes], { type: 'image/png' }));
    image.alt = 'A picture of the world, as the form above has asked for it';
    image.addEventListener('load', () => this.follow());
    this.flush();
    this.last = null;
    this.append(image);
  }

  finish({ prompt, draft, outcome, input }) {
    this.flush();
    this.prompt.textContent = `${prompt}>`;
    this.progress.textContent = '';
    if (draft && !input.again) this.replace(draft);
    if (outcome === 'quit') this.remark('The session has ended. “New session” begins another one.');
  }

  remark(text) {
    this.flush();
    this.last = null;
    this.append(element('p', 'remark', text));
    this.toEnd();
  }
}
