// The live view: a page of its own in a frame, which gets from here what its server would send.

import { partText } from './parts.js';

export class LiveView {
  constructor(engine, frame) {
    this.engine = engine;
    this.frame = frame;
    // What a page that connects later has to hear.
    this.heard = [];
    this.listen = null;
    // Meshes by the number of their first node, and who waits for them.
    this.loaded = [];
    this.wanted = [];
    window.liveView = this;
    engine.addEventListener('begin', () => this.clear());
    engine.addEventListener('open', () => this.open());
    engine.addEventListener('message', ({ detail }) => { if (detail.news) this.hear(detail.news); });
    engine.addEventListener('bytes', ({ detail }) => { if (detail.what === 'meshes') this.take(detail.bytes); });
    setInterval(() => this.listen?.('alive', {}), 1000);
  }

  clear() {
    this.heard = [];
    this.loaded = [];
    for (const go of this.wanted.splice(0)) go(new ArrayBuffer(0));
  }

  // The frame's page stays when another session begins: it is greeted again.
  async open() {
    if (this.isOpen) return;
    this.isOpen = true;
    const { page } = await this.engine.ask('viewPage', { script: partText('shim') }, true);
    this.frame.srcdoc = page;
  }

  connect(listen) {
    this.listen = listen;
    // The page adds its listeners after it has connected.
    setTimeout(() => { for (const [name, data] of this.heard.splice(0)) listen(name, data); });
  }

  hear(news) {
    for (const [name, data] of news) {
      if (this.listen) this.listen(name, data);
      else this.heard.push([name, data]);
    }
  }

  take(bytes) {
    const go = this.wanted.shift();
    if (go) go(bytes);
    else this.loaded.push(bytes);
  }

  // They are sent in the order of the nodes.
  meshes() {
    const bytes = this.loaded.shift();
    return bytes ?? new Promise((go) => { this.wanted.push(go); });
  }

  async past(from, to) {
    const { past } = await this.engine.ask('past', { from, to }, true);
    if (!past) throw new Error('the past is not here');
    return past;
  }

  setPace(wanted) {
    this.engine.setPace(wanted);
  }
}
