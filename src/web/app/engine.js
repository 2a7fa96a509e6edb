// The session: starts the worker, sends requests, and brings a session back by its inputs.

import { partText } from './parts.js';

const PACES = { pause: -1, go: -2, 'speed max': -3 };

export class Engine extends EventTarget {
  constructor(files) {
    super();
    // The files that the session sees, by name.
    this.files = files;
    this.seed = 0;
    // The inputs of the session.
    this.inputs = [];
    this.isBusy = true;
    this.number = 0;
    this.answers = new Map();
    this.current = null;
    this.queue = [];
    // Where the scripts of workers are.
    this.sources = {};
  }

  // The program, and the code from which sessions start, which have been on their way since the page began.
  parts() {
    return self.program.catch(({ message }) => { throw new Error(`The program cannot be loaded (${message}).`); });
  }

  makeWorker(id = 'worker') {
    this.sources[id] ??= URL.createObjectURL(new Blob([partText(id)], { type: 'text/javascript' }));
    return new Worker(this.sources[id]);
  }

  // Begins a session. Inputs are evaluated without waiting, as those of a session that comes back.
  // `leaves` leaves the debugger after each of them.
  async begin({ seed = 0, inputs = [], leaves = false } = {}) {
    this.worker?.terminate();
    this.seed = seed;
    this.inputs = [];
    this.isBusy = true;
    this.current = null;
    this.queue = [];
    for (const give of this.answers.values()) give({});
    this.answers.clear();
    // It starts while the program is still unpacked.
    const worker = this.makeWorker();
    this.worker = worker;
    const [module, code] = await this.parts().catch((error) => {
      this.tell('message', { failed: error.message });
      return [];
    });
    if (!module || worker !== this.worker) return;
    worker.onmessage = ({ data }) => { if (worker === this.worker) this.hear(data); };
    worker.onerror = (event) => { if (worker === this.worker) this.crash(event.message); };
    this.shared = self.crossOriginIsolated ? new Int32Array(new SharedArrayBuffer(16)) : null;
    this.tell('begin', { seed });
    const ready = new Promise((go) => { this.isReady = go; });
    worker.postMessage({ wasm: module, code, shared: this.shared?.buffer });
    this.ways = await ready;
    const opened = new Promise((go) => { this.isOpen = go; });
    worker.postMessage({ open: { seed, files: this.files() } });
    const { failed } = await opened;
    if (failed) return;
    this.isBusy = false;
    this.tell('idle', {});
    for (let at = 0; at < inputs.length; at += 1) {
      this.tell('again', { at, of: inputs.length });
      const done = await this.run({ ...inputs[at], again: true });
      if (worker !== this.worker) return;
      if (leaves && done.level) await this.run({ text: 'q', again: true });
      // Somebody has interrupted what comes back.
      if (done.ending?.startsWith('interrupt') && inputs[at].interruptedAt == null) break;
    }
    if (inputs.length) this.tell('again', { at: inputs.length, of: inputs.length });
  }

  // Evaluates an input after those that wait; comes back with how it ended.
  run(input) {
    return new Promise((go) => {
      this.queue.push({ input, go });
      this.next();
    });
  }

  next() {
    if (this.isBusy || !this.queue.length) return;
    const { input, go } = this.queue.shift();
    this.isBusy = true;
    this.current = { input, go };
    this.tell('input', input);
    this.worker.postMessage({ evaluate: input });
  }

  // What waits is left out; what is evaluated ends as soon as it can.
  interrupt() {
    this.queue = [];
    if (!this.isBusy) return;
    if (this.ways?.suspends) this.worker.postMessage({ interrupt: true });
    else if (this.shared) {
      Atomics.store(this.shared, 0, 1);
      Atomics.notify(this.shared, 1);
    } else this.restart('This browser cannot interrupt a session. It has been put back to what it was before the input.');
  }

  // Begins again with the inputs so far, but for the one that is evaluated.
  restart(why) {
    const { seed, inputs } = this;
    this.current?.go({});
    this.begin({ seed, inputs: [...inputs] }).then(() => this.tell('remark', { text: why }));
  }

  crash(why) {
    this.restart(`The session has ended unexpectedly (${why}). It has been put back to what it was before the input.`);
  }

  // Asks something; comes back with the answer. What needs the session is not asked while it works.
  ask(name, what, isQuick = false) {
    if (this.isBusy && !isQuick) return Promise.resolve({});
    this.number += 1;
    const { number } = this;
    return new Promise((go) => {
      this.answers.set(number, go);
      this.worker.postMessage({ [name]: { ...what, number } });
    });
  }

  setFile(name, text) {
    this.worker?.postMessage({ file: { name, text } });
  }

  setPace(wanted) {
    if (this.isBusy && this.shared && !this.ways?.suspends) {
      Atomics.store(this.shared, 3, PACES[wanted] ?? Math.round(Number(wanted.split(' ')[1]) * 1000));
      Atomics.add(this.shared, 2, 1);
      Atomics.notify(this.shared, 1);
    } else this.worker?.postMessage({ pace: wanted });
  }

  tell(name, detail) {
    this.dispatchEvent(new CustomEvent(name, { detail }));
  }

  hear(data) {
    if (data.number !== undefined) {
      this.answers.get(data.number)?.(data);
      this.answers.delete(data.number);
    } else if (data.ready) this.isReady(data.ready);
    else if (data.open) {
      this.tell('open', data.open);
      this.isOpen(data.open);
    } else if (data.done) {
      const { input, go } = this.current;
      const { again, ...kept } = input;
      if (data.done.interruptedAt != null) kept.interruptedAt = data.done.interruptedAt;
      this.inputs.push(kept);
      this.current = null;
      this.isBusy = false;
      this.tell('done', { ...data.done, input });
      go(data.done);
      this.tell('idle', {});
      if (data.done.outcome !== 'quit') this.next();
    } else if (data.crashed) this.crash(data.crashed);
    else if (data.what !== undefined) this.tell('bytes', data);
    else {
      if (data.failed) this.isOpen?.(data);
      this.tell('message', data);
    }
  }
}
