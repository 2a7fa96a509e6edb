// Drives a headless Chromium over the DevTools protocol, through pipes; needs no packages.

import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const FLAGS = [
  '--headless', '--no-sandbox', '--disable-gpu', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
  '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
  '--disable-sync', '--disable-dev-shm-usage', '--hide-scrollbars', '--mute-audio', '--remote-debugging-pipe',
];

/** What the protocol says of a page that has been left while it was asked. */
const LEFT = /navigated or closed|Cannot find (default execution )?context/;

export const sleep = (seconds) => new Promise((done) => setTimeout(done, seconds * 1000));

/** A browser with a profile of its own; `close` ends it and deletes the profile. */
export class Browser {
  constructor(executable) {
    this.profile = mkdtempSync(join(tmpdir(), 'planwright-browser-'));
    this.process = spawn(executable, [...FLAGS, `--user-data-dir=${this.profile}`], {
      stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'],
      detached: true,
    });
    this.ended = new Promise((done) => { this.process.on('exit', done); });
    this.last = 0;
    this.waiting = new Map();
    this.hearers = [];
    let text = '';
    this.process.stdio[4].setEncoding('utf8').on('data', (piece) => {
      const messages = (text + piece).split('\0');
      text = messages.pop();
      messages.forEach((message) => this.take(JSON.parse(message)));
    });
  }

  take(message) {
    const waiting = this.waiting.get(message.id);
    if (waiting) {
      this.waiting.delete(message.id);
      if (message.error) waiting.fail(new Error(`${waiting.method}: ${message.error.message}`));
      else waiting.done(message.result);
    } else {
      this.hearers.forEach((hear) => hear(message));
    }
  }

  send(method, params = {}, sessionId = undefined) {
    this.last += 1;
    const id = this.last;
    this.process.stdio[3].write(`${JSON.stringify({ id, method, params, sessionId })}\0`);
    return new Promise((done, fail) => this.waiting.set(id, { done, fail, method }));
  }

  /** Opens an address in a tab of its own. */
  async open(address, { width = 1280, height = 800, dark = false } = {}) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const tab = new Tab(this, sessionId, targetId);
    await tab.send('Page.enable');
    await tab.send('Runtime.enable');
    await tab.send('Log.enable');
    await tab.send('Emulation.setDeviceMetricsOverride', { width, height, deviceScaleFactor: 1, mobile: false });
    await tab.send('Emulation.setEmulatedMedia', {
      features: [{ name: 'prefers-color-scheme', value: dark ? 'dark' : 'light' }],
    });
    await tab.send('Page.navigate', { url: address });
    return tab;
  }

  /**
   * The share of two pictures that looks different, from 0 to 1, and 1 if their sizes differ: of squares of 16
   * pixels, those whose mean colour differs by more than a tenth. So letters drawn by another font, or a number that
   * differs, count little; what is absent, moved or of another colour counts.
   */
  async difference(file, other) {
    const tab = await this.open('about:blank');
    const sources = [file, other].map((name) => `data:image/png;base64,${readFileSync(name).toString('base64')}`);
    const share = await tab.value(`(async () => {
      const [a, b] = await Promise.all(${JSON.stringify(sources)}.map(async (source) => {
        const image = await createImageBitmap(await (await fetch(source)).blob());
        const canvas = new OffscreenCanvas(image.width, image.height);
        const context = canvas.getContext('2d');
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, image.width, image.height);
      }));
      if (a.width !== b.width || a.height !== b.height) return 1;
      const columns = Math.floor(a.width / 16), rows = Math.floor(a.height / 16);
      let different = 0;
      for (let square = 0; square < columns * rows; square += 1) {
        const sums = [0, 0, 0];
        for (let pixel = 0; pixel < 256; pixel += 1) {
          const row = Math.floor(square / columns) * 16 + (pixel >> 4);
          const at = (row * a.width + (square % columns) * 16 + (pixel & 15)) * 4;
          for (let colour = 0; colour < 3; colour += 1) sums[colour] += a.data[at + colour] - b.data[at + colour];
        }
        if (sums.some((sum) => Math.abs(sum) > 25.5 * 256)) different += 1;
      }
      return different / (columns * rows);
    })()`);
    await this.send('Target.closeTarget', { targetId: tab.target });
    return share;
  }

  async close() {
    await Promise.race([this.send('Browser.close').catch(() => {}), sleep(3)]);
    // Its helpers write into the profile, too: all of its group ends.
    try { process.kill(-this.process.pid, 'SIGKILL'); } catch { /* it has ended */ }
    await this.ended;
    for (let tries = 50; ; tries -= 1) {
      try {
        rmSync(this.profile, { recursive: true, force: true });
        return;
      } catch (error) {
        // What remains is the system's to delete; it says nothing about what was checked.
        if (tries === 0) return console.log(`left ${this.profile}: ${error.message}`);
        await sleep(0.1);
      }
    }
  }
}

/** A tab, with the errors that its page has reported. */
export class Tab {
  constructor(browser, session, target) {
    Object.assign(this, { browser, session, target, errors: [] });
    browser.hearers.push(({ sessionId, method, params }) => {
      if (sessionId !== session) return;
      if (method === 'Runtime.exceptionThrown') this.errors.push(params.exceptionDetails.exception?.description ?? params.exceptionDetails.text);
      if (method === 'Log.entryAdded' && params.entry.level === 'error') this.errors.push(params.entry.text);
      if (method === 'Runtime.consoleAPICalled' && params.type === 'error') this.errors.push(JSON.stringify(params.args));
    });
  }

  send(method, params) { return this.browser.send(method, params, this.session); }

  /** The value of an expression in the page. */
  async value(expression) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  }

  /** Waits until an expression is true. A page that is being loaded anew has no value meanwhile. */
  async until(expression, seconds = 20) {
    const end = Date.now() + seconds * 1000;
    while (Date.now() < end) {
      const value = await this.value(expression).catch((error) => {
        if (!LEFT.test(error.message)) throw error;
      });
      if (value) return value;
      await sleep(0.05);
    }
    throw new Error(`not within ${seconds} s: ${expression}`);
  }

  mouse(type, x, y, more = {}) {
    return this.send('Input.dispatchMouseEvent', { type, x, y, pointerType: 'mouse', ...more });
  }

  async click(x, y, clickCount = 1) {
    for (let count = 1; count <= clickCount; count++) {
      await this.mouse('mousePressed', x, y, { button: 'left', buttons: 1, clickCount: count });
      await this.mouse('mouseReleased', x, y, { button: 'left', buttons: 0, clickCount: count });
    }
  }

  /** Clicks the middle of an element. */
  async press(selector) {
    const [x, y] = await this.value(`(() => {
      const box = document.querySelector(${JSON.stringify(selector)}).getBoundingClientRect();
      return [box.x + box.width / 2, box.y + box.height / 2];
    })()`);
    await this.click(x, y);
  }

  async drag([x, y], [dx, dy], button = 'left') {
    const buttons = button === 'left' ? 1 : 2;
    await this.mouse('mousePressed', x, y, { button, buttons, clickCount: 1 });
    for (let i = 1; i <= 5; i++) {
      await this.mouse('mouseMoved', x + dx * i / 5, y + dy * i / 5, { button, buttons });
    }
    await this.mouse('mouseReleased', x + dx, y + dy, { button, buttons: 0, clickCount: 1 });
  }

  wheel(x, y, deltaY) { return this.mouse('mouseWheel', x, y, { deltaX: 0, deltaY }); }

  /** Saves a screenshot of the tab as a PNG file, and returns the file's name. */
  async picture(file) {
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    writeFileSync(file, Buffer.from(data, 'base64'));
    return file;
  }
}
