// The tutorial beside the prompt: chapters, whose forms run by a click; where one is; and the way back to
// the beginning of a chapter.

import { keep, kept } from './keep.js';

const plain = (text) => text.replace(/\s+/g, ' ').trim();

export class Tutorial {
  constructor(engine, prompt, root) {
    this.engine = engine;
    this.prompt = prompt;
    this.chapters = JSON.parse(document.getElementById('tutorial-data').textContent);
    this.select = root.querySelector('#chapter');
    this.body = root.querySelector('#chapter-text');
    this.at = 0;
    // The steps that have been taken, by chapter.
    this.done = {};
    this.chapters.forEach(({ title }, number) => this.select.add(new Option(title, String(number))));
    this.select.addEventListener('change', () => this.show(Number(this.select.value)));
    root.querySelector('#chapter-back').addEventListener('click', () => this.show(this.at - 1));
    root.querySelector('#chapter-on').addEventListener('click', () => this.show(this.at + 1));
    root.querySelector('#chapter-afresh').addEventListener('click', () => this.beginChapter());
    this.body.addEventListener('click', (event) => this.click(event));
    engine.addEventListener('done', ({ detail }) => this.see(detail.input.text));
    kept('tutorial', { at: 0, done: {} }).then(({ at, done }) => {
      this.done = done;
      this.show(at, false);
    });
  }

  steps() {
    return [...this.body.querySelectorAll('.step')];
  }

  show(number, isChosen = true) {
    if (!this.chapters[number]) return;
    this.at = number;
    this.select.value = String(number);
    this.body.innerHTML = this.chapters[number].html;
    this.body.scrollTop = 0;
    this.mark();
    if (isChosen) this.save();
  }

  save() {
    keep('tutorial', { at: this.at, done: this.done });
  }

  // Shows which steps have been taken, and the next one.
  mark() {
    const done = new Set(this.done[this.at] ?? []);
    const last = Math.max(-1, ...done);
    this.steps().forEach((step, number) => {
      step.classList.toggle('done', done.has(number));
      step.classList.toggle('here', number === last + 1);
      step.querySelector('.try').title = number === last + 1 ? 'You are here: evaluate this' : 'Evaluate this';
    });
  }

  // An input may be a step of this chapter, whether it was clicked or typed: the first one that has not
  // been taken.
  see(text) {
    const done = this.done[this.at] ?? [];
    const steps = this.steps();
    const number = steps.findIndex((step, at) => !done.includes(at) && plain(step.querySelector('.try').dataset.input) === plain(text));
    if (number < 0) return;
    this.done[this.at] = [...done, number];
    this.mark();
    this.save();
  }

  click(event) {
    const link = event.target.closest('a[href^="#"]');
    if (link) {
      event.preventDefault();
      const wanted = link.getAttribute('href').slice(1).replaceAll('-', ' ');
      const number = this.chapters.findIndex(({ title }) => title.toLowerCase().replace(/[^\w ]/g, '') === wanted);
      this.show(number);
      return;
    }
    const button = event.target.closest('.try');
    if (button) this.prompt.add(button.dataset.input);
  }

  // A new session, in which everything before this chapter has been done.
  async beginChapter() {
    const inputs = [];
    const page = document.createElement('div');
    for (const { html } of this.chapters.slice(0, this.at)) {
      page.innerHTML = html;
      for (const button of page.querySelectorAll('.try')) inputs.push({ text: button.dataset.input });
    }
    delete this.done[this.at];
    this.mark();
    this.save();
    this.prompt.clear();
    await this.engine.begin({ inputs, leaves: true });
    this.prompt.remark(`The session is as at the beginning of “${this.chapters[this.at].title}”.`);
  }
}
