// Sweeps on all cores: each worker has a WebAssembly instance of its own and runs one world after
// the other. What comes of a world does not depend on which worker runs it.

import { textOf } from './lisp_editor.js';

const MAX_WORKERS = 16;

// A worker that answers one request at a time.
class Hand {
  constructor(engine, [module, code]) {
    this.worker = engine.makeWorker();
    this.number = 0;
    this.worker.onmessage = ({ data }) => {
      if (data.ready) this.isReady();
      else if (data.number === this.number) this.take(data);
      else if (data.crashed || data.failed) this.take({ mistake: data.crashed ?? data.failed });
    };
    this.worker.onerror = (event) => this.take({ mistake: event.message });
    this.ready = new Promise((go) => { this.isReady = go; });
    this.worker.postMessage({ wasm: module, code });
  }

  async ask(name, what) {
    await this.ready;
    this.number += 1;
    return new Promise((take) => {
      this.take = take;
      this.worker.postMessage({ [name]: { ...what, number: this.number } });
    });
  }
}

export class Sweeper {
  constructor(engine, prompt, files, root) {
    Object.assign(this, { engine, prompt, files });
    const find = (id) => root.querySelector(id);
    this.bar = find('#sweep-bar');
    this.worlds = find('#sweep-worlds');
    this.seed = find('#sweep-seed');
    this.progress = find('#sweep-progress');
    this.start = find('#sweep-start');
    this.start.addEventListener('click', () => { if (this.isRunning) this.isRunning = false; else this.run(); });
  }

  // The bar is there if the file that is open has a sweep.
  show(text) {
    this.bar.hidden = !/\(\s*(?:\w+:)?defsweep\b/i.test(text) && !this.isRunning;
  }

  async run() {
    const file = this.files.name.value, text = textOf(this.files.editor);
    const seed = Number(this.seed.value) || 0;
    const count = navigator.hardwareConcurrency || 1;
    const parts = await this.engine.parts();
    const hands = Array.from({ length: Math.min(MAX_WORKERS, count) }, () => new Hand(this.engine, parts));
    this.isRunning = true;
    this.start.textContent = 'Stop';
    this.progress.textContent = 'Loading …';
    const begin = performance.now();
    try {
      for (const { worker } of hands) for (const [name, own] of Object.entries(this.files.all())) worker.postMessage({ file: { name, text: own } });
      const known = await Promise.all(hands.map((hand) => hand.ask('sweep', { file, text, seed })));
      const { sweep, mistake } = known[0];
      if (!sweep) throw new Error(mistake);
      const total = Number(this.worlds.value) || sweep.worlds;
      const records = await this.inAll(hands, total);
      const answer = await hands[0].ask('summary', { lines: records });
      if (answer.mistake) throw new Error(answer.mistake);
      const seconds = ((performance.now() - begin) / 1000).toFixed(1);
      this.progress.textContent = `${records.length} worlds in ${seconds} s on ${hands.length} cores.`;
      this.report(sweep.name, answer.summary, records);
    } catch (error) {
      this.progress.textContent = error.message;
    } finally {
      for (const { worker } of hands) worker.terminate();
      this.isRunning = false;
      this.start.textContent = 'Sweep';
    }
  }

  // The records of worlds as texts, in their order; of fewer worlds if the sweep is stopped.
  async inAll(hands, total) {
    const records = [];
    let next = 0, done = 0, successes = 0;
    await Promise.all(hands.map(async (hand) => {
      while (next < total && this.isRunning) {
        const world = next;
        next += 1;
        const { line, success, mistake } = await hand.ask('world', { world });
        if (!line) throw new Error(`world ${world}: ${mistake}`);
        records[world] = line;
        done += 1;
        successes += success;
        this.progress.textContent = `${done} of ${total} worlds, ${successes} ${successes === 1 ? 'success' : 'successes'}`;
      }
    }));
    return records.filter(Boolean);
  }

  report(name, summary, records) {
    this.prompt.remark(`The sweep ${name} has ended:`);
    const table = document.createElement('pre');
    table.className = 'wide';
    table.tabIndex = 0;
    table.textContent = summary;
    this.prompt.append(table);
    const link = document.createElement('a');
    const lines = records.map((line) => `${line}\n`).join('');
    link.href = URL.createObjectURL(new Blob([lines], { type: 'application/x-ndjson' }));
    link.download = `${name}.jsonl`;
    link.textContent = 'Download the records';
    this.prompt.append(link);
    this.prompt.last = null;
    this.prompt.toEnd();
    this.records = records;
    this.summary = summary;
  }
}
