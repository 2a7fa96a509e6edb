// The user's files: they are kept in the browser, and the session sees them.

import { forget, keep, keptWith } from './keep.js';
import { makeEditor, setText, textOf } from './lisp_editor.js';

// The text that bytes are; the bytes themselves if they are no text, such as a picture.
function contentsOf(bytes) {
  try {
    return new TextDecoder('utf-8', { fatal: true }).decode(bytes);
  } catch {
    return new Uint8Array(bytes);
  }
}

const isText = (contents) => typeof contents === 'string';

export class UserFiles {
  constructor(root) {
    this.texts = new Map();
    this.root = root;
    this.open = null;
    this.isSaved = true;
    // Called with the text that is edited.
    this.onText = () => {};
    this.plans = JSON.parse(document.getElementById('plans-data').textContent);
  }

  async load() {
    this.texts = await keptWith('file:');
  }

  attach(engine, prompt) {
    this.engine = engine;
    this.prompt = prompt;
    const find = (id) => this.root.querySelector(id);
    this.list = find('#file-list');
    this.name = find('#file-name');
    this.status = find('#file-status');
    this.editor = makeEditor({
      parent: find('#file-text'), engine, label: 'Text of the file', hasLines: true,
      keys: [{ key: 'Mod-s', run: () => { this.save(); return true; } }],
      onChange: (update) => {
        if (!update.docChanged) return;
        this.isSaved = false;
        this.onText(textOf(this.editor));
      },
    });
    find('#file-new').addEventListener('click', () => this.edit('my.plan', ';; A plan of your own.\n(in-package :pp-tut)\n\n', true));
    find('#file-save').addEventListener('click', () => this.save());
    find('#file-run').addEventListener('click', () => this.run());
    find('#file-check').addEventListener('click', () => this.check());
    find('#file-download').addEventListener('click', () => this.download());
    find('#file-delete').addEventListener('click', () => this.delete());
    find('#file-upload').addEventListener('change', (event) => this.take(event.target.files));
    this.list.addEventListener('click', (event) => {
      const { name } = event.target.closest('button')?.dataset ?? {};
      if (name) this.edit(name, this.texts.get(name) ?? this.plans[name], !this.texts.has(name));
    });
    document.addEventListener('dragover', (event) => { if (event.dataTransfer.types.includes('Files')) event.preventDefault(); });
    document.addEventListener('drop', (event) => {
      if (!event.dataTransfer.files.length) return;
      event.preventDefault();
      this.take(event.dataTransfer.files);
    });
    engine.addEventListener('bytes', ({ detail: { what, bytes } }) => {
      if (what.startsWith('file ')) this.put(what.slice(5), contentsOf(bytes));
      if (what.startsWith('deleted ')) this.put(what.slice(8), null);
    });
    engine.addEventListener('message', ({ detail }) => { if (detail.findings) this.showFindings(detail.findings); });
    this.show();
  }

  // The texts that a session sees: the user's, and those of the program of which there is no own copy.
  all() {
    return { ...this.plans, ...Object.fromEntries([...this.texts].filter(([, contents]) => isText(contents))) };
  }

  put(name, text) {
    if (text === null) {
      this.texts.delete(name);
      forget(`file:${name}`);
    } else {
      this.texts.set(name, text);
      keep(`file:${name}`, text);
    }
    this.show();
  }

  show() {
    const button = (name, isOwn) => {
      const made = document.createElement('button');
      made.type = 'button';
      made.dataset.name = name;
      made.textContent = name;
      made.className = isOwn ? 'own' : '';
      made.setAttribute('aria-pressed', String(name === this.open));
      return made;
    };
    // What begins with a dot is the session's, such as what has been done of lessons.
    const own = [...this.texts.keys()].filter((name) => !name.startsWith('.')).sort().map((name) => button(name, true));
    const given = Object.keys(this.plans).filter((name) => !this.texts.has(name)).map((name) => button(name, false));
    const head = (text) => Object.assign(document.createElement('h2'), { textContent: text });
    this.list.replaceChildren(...(own.length ? [head('Yours'), ...own] : []), head('With the program'), ...given);
  }

  edit(name, text, isNew) {
    if (!this.isSaved && !confirm(`${this.name.value} has changes that are not saved. Leave them?`)) return;
    this.open = name;
    this.name.value = name;
    this.bytes = isText(text) ? null : text;
    setText(this.editor, isText(text) ? text : '');
    this.editor.dispatch({ selection: { anchor: 0 }, scrollIntoView: true });
    this.isSaved = true;
    this.status.textContent = this.bytes ? 'This is no text: it can be downloaded or deleted.' : isNew && this.plans[name] ? 'A plan of the program: saving keeps a copy of your own.' : '';
    this.show();
  }

  save() {
    const name = this.name.value.trim().replace(/^\/+/, '');
    if (this.bytes) return false;
    if (!name || name.endsWith('/')) {
      this.status.textContent = 'A file needs a name, such as my.plan.';
      return false;
    }
    const text = textOf(this.editor);
    this.open = name;
    this.isSaved = true;
    this.engine.setFile(name, text);
    this.put(name, text);
    this.status.textContent = `Saved in this browser.`;
    return true;
  }

  run() {
    const isGiven = this.plans[this.name.value] === textOf(this.editor);
    if (isGiven || this.save()) this.prompt.add(`(load ${JSON.stringify(this.name.value)})`);
  }

  check() {
    this.status.textContent = 'Checking …';
    this.engine.worker.postMessage({ check: { name: this.name.value || 'my.plan', text: textOf(this.editor) } });
  }

  showFindings(findings) {
    const lines = findings.map(({ line, column, message }) => `${line ?? '?'}:${column ?? '?'}: ${message}`);
    this.status.textContent = lines.length ? lines.join('\n') : 'No mistakes found.';
  }

  download() {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(new Blob([this.bytes ?? textOf(this.editor)]));
    link.download = (this.name.value || 'my.plan').split('/').at(-1);
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }

  delete() {
    const name = this.name.value;
    if (!this.texts.has(name) || !confirm(`Delete ${name}?`)) return;
    this.engine.setFile(name, this.plans[name] ?? null);
    this.put(name, null);
    this.isSaved = true;
    setText(this.editor, '');
    this.status.textContent = `${name} is deleted.`;
  }

  async take(files) {
    for (const file of files) {
      const text = contentsOf(await file.arrayBuffer());
      if (isText(text)) this.engine.setFile(file.name, text);
      this.put(file.name, text);
      this.isSaved = true;
      this.edit(file.name, text, false);
    }
  }
}
