// The live view when its session stops, dies, hangs, or is behind a tunnel: the page says so, and
// its clock is that of the scene it shows.

import { spawn } from 'node:child_process';
import { connect, createServer } from 'node:net';
import { join } from 'node:path';
import { sleep } from './browser.mjs';

// A stand-in for `ssh -L`: passes bytes from a port of its own to another.
class Tunnel {
  static async to(port) {
    const tunnel = new Tunnel();
    tunnel.target = port;
    tunnel.sockets = new Set();
    await tunnel.open(0);
    return tunnel;
  }

  async open(port = this.port) {
    this.server = createServer((near) => {
      const distant = connect(this.target, '127.0.0.1');
      for (const [a, b] of [[near, distant], [distant, near]]) {
        this.sockets.add(a);
        a.on('data', (bytes) => { if (!this.isStuck) b.write(bytes); });
        a.on('close', () => { this.sockets.delete(a); b.destroy(); });
        a.on('error', () => b.destroy());
      }
    });
    await new Promise((done) => this.server.listen(port, '127.0.0.1', done));
    this.port = this.server.address().port;
  }

  // From now on nothing passes, but nobody is told.
  hang() { this.isStuck = true; }

  async close() {
    this.isStuck = false;
    this.sockets.forEach((socket) => socket.destroy());
    await new Promise((done) => this.server.close(done));
  }
}

const LINK = 'document.querySelector("#link-text").textContent';
const NOW = 'Number.parseFloat(document.querySelector("#now").textContent)';
// Whether the clock is that of the scene, to the distance of two frames.
const AGREES = `(() => { const { page } = planwright; return page.shown.t <= ${NOW} + 0.005 && ${NOW} - page.shown.t < 0.1; })()`;
const CONTROLS = '[...document.querySelectorAll("#play, #speeds button, #live")].every((button) => button.disabled)';
const HALT = 'document.querySelector("#halt").innerText';

const opened = async (browser, address, options) => {
  const tab = await browser.open(address, options);
  await tab.until('!!window.planwright && planwright.counts.drawn > 2 && planwright.scene.nodes.size > 60', 30);
  return tab;
};

// A session at a prompt in a terminal, as `script` makes one; returns a function that types.
function atPrompt({ program, children }) {
  const child = spawn('script', ['-qfc', `${program} --view`, '/dev/null'], { stdio: ['pipe', 'pipe', 'pipe'] });
  children.push(child);
  const terminal = { told: '', type: (text) => child.stdin.write(`${text}\r`) };
  child.stdout.setEncoding('utf8').on('data', (text) => { terminal.told += text; });
  return terminal;
}

async function address(terminal) {
  for (let i = 0; i < 600; i++) {
    const found = /http:\S+/.exec(terminal.told);
    if (found) return found[0];
    await sleep(0.05);
  }
  throw new Error(`no address: ${terminal.told}`);
}

async function atTheDebugger({ browser, check, pictures, ...context }) {
  const terminal = atPrompt(context);
  const tab = await opened(browser, await address(terminal));
  terminal.type('(in-package :pp-tut)');
  terminal.type('(with-simulated-robot (cpl:par (park-arms) (perform (a motion (type moving-torso) (joint-angle 9)))))');
  await tab.until('planwright.page.halt?.kind === "stopped"', 60);
  await tab.until('document.querySelectorAll("#task-list .stopped").length > 1', 5);
  const text = await tab.value(HALT);
  check(/stopped at the prompt/i.test(text), 'the page says that the session is stopped');
  check(/torso-goal-not-reached/.test(text) && /out of joint limits/.test(text) && /retry-form/.test(text), `with the condition and the restarts: ${text.replaceAll(/\s+/g, ' ').slice(0, 160)}`);
  check(await tab.value(LINK) === 'stopped' && await tab.value('document.title') === 'stopped – planwright', 'also in the title and beside the connection');
  const running = await tab.value(`[...document.querySelectorAll('#task-list .running .name')].map((name) => name.textContent)`);
  check(!running.some((name) => /plan|par 2/.test(name)), `no task on the failed path goes on running (running: ${running.join(', ') || 'none'})`);
  check(await tab.value(AGREES), 'the clock is that of the scene');
  await tab.picture(join(pictures, 'stopped.png'));
  await tab.send('Emulation.setDeviceMetricsOverride', { width: 390, height: 844, deviceScaleFactor: 1, mobile: true });
  await sleep(1);
  await tab.picture(join(pictures, 'stopped-phone.png'));
  check(await tab.value('document.documentElement.scrollWidth <= 390'), 'a phone shows it without sideways scrolling');
  const later = await opened(browser, await address(terminal), { dark: true });
  await later.until('planwright.page.halt?.kind === "stopped"', 10);
  await sleep(1);
  await later.picture(join(pictures, 'stopped-dark.png'));
  check(true, 'a page that is opened later shows it, too');
  terminal.type('q');
  await tab.until('!planwright.page.halt && document.querySelector("#halt").hidden', 10);
  check(await tab.value(LINK) === 'live', 'after the decision the page is live again');
  terminal.type('(quit)');
  await tab.until('planwright.page.link === "over" || planwright.page.link === "gone"', 10);
  check(/^(session ended|disconnected)$/.test(await tab.value(LINK)), `the page says when the session is left: ${await tab.value(LINK)}`);
}

async function killed({ browser, start, check, pictures, plan }) {
  const { child, address: page } = await start('run', plan, '--view');
  const tab = await opened(browser, page);
  await tab.until('planwright.past.span[1] > 3', 30);
  child.kill('SIGKILL');
  await tab.until('planwright.page.link === "gone"', 10);
  check(await tab.value(LINK) === 'disconnected', 'the page says that the server is dead');
  check(await tab.value(CONTROLS), 'its controls are off');
  check(await tab.value(AGREES), 'its clock is that of the scene');
  const time = await tab.value(NOW);
  await sleep(3);
  check(await tab.value(NOW) === time && await tab.value(AGREES), 'and stands still');
  await tab.picture(join(pictures, 'dead.png'));
  // The past was never asked for, so it is not here.
  const place = await tab.value(`(() => { const b = document.querySelector('#slider').getBoundingClientRect(); return [b.x, b.y + b.height / 2, b.width]; })()`);
  await tab.click(place[0] + place[2] * 0.3, place[1]);
  for (let i = 0; i < 20; i++) {
    if (!await tab.value(AGREES)) check(false, 'the clock disagrees with the scene in the past');
    await sleep(0.1);
  }
  check(/not on this page/.test(await tab.value('document.querySelector("#notice").textContent')), 'it says what it does not have');
  await tab.send('Emulation.setDeviceMetricsOverride', { width: 390, height: 844, deviceScaleFactor: 1, mobile: true });
  await sleep(1);
  await tab.picture(join(pictures, 'dead-phone.png'));
}

async function hanging({ browser, start, check, plan }) {
  const { child, address: page } = await start('run', plan, '--view');
  const tab = await opened(browser, page);
  child.kill('SIGSTOP');
  await tab.until('planwright.page.link === "silent"', 20);
  check(await tab.value(CONTROLS) && await tab.value(AGREES), 'a session that hangs is said to give no answer');
  child.kill('SIGCONT');
  await tab.until('planwright.page.link === "live" && planwright.scene.nodes.size > 60', 30);
  const time = await tab.value('planwright.past.span[1]');
  await tab.until(`planwright.past.span[1] > ${time} && [...planwright.scene.nodes.values()].filter((node) => node.mesh).length > 60`, 20);
  check(await tab.value(AGREES), 'and the page is live again when it goes on');
  child.kill('SIGKILL');
}

async function throughTunnel({ browser, start, check, plan }) {
  const port = 20000 + Math.floor(Math.random() * 20000);
  const { child, address: page } = await start('run', plan, '--view', '--view-port', String(port));
  check(page.startsWith(`http://127.0.0.1:${port}/`), 'the page has the port that was asked for');
  const tunnel = await Tunnel.to(port);
  const near = page.replace(`127.0.0.1:${port}`, `localhost:${tunnel.port}`);
  const tab = await opened(browser, near);
  check(await tab.value('planwright.page.link') === 'live', 'the page works through a tunnel with another port');
  await tab.press('#play');
  await tab.until('planwright.page.pace.paused', 5);
  await tab.press('#play');
  await tab.until('!planwright.page.pace.paused', 5);
  check(true, 'and its controls do, too');
  await tunnel.close();
  await tab.until('planwright.page.link === "gone"', 10);
  check(await tab.value(CONTROLS) && await tab.value(AGREES), 'the page says that the tunnel is closed');
  await tunnel.open();
  await tab.until('planwright.page.link === "live" && planwright.scene.nodes.size > 60', 30);
  check(true, 'it connects again when the tunnel is back');
  tunnel.hang();
  await tab.until('planwright.page.link === "silent"', 20);
  check(await tab.value(CONTROLS), 'a tunnel that passes nothing any more is noticed');
  await tunnel.close();
  await tunnel.open();
  await tab.until('planwright.page.link === "live" && planwright.scene.nodes.size > 60', 30);
  check(await tab.value(AGREES), 'and left behind');
  // Another session takes the port; it knows nothing of this page.
  child.kill('SIGKILL');
  await tab.until('planwright.page.link === "gone"', 10);
  const other = await start('run', plan, '--view', '--view-port', String(port));
  await tab.until('planwright.page.link === "other"', 20);
  check(await tab.value(LINK) === 'another session', 'another session at the same port is not taken for this one');
  other.child.kill('SIGKILL');
  await tunnel.close();
}

export async function connections(context) {
  await atTheDebugger(context);
  await killed(context);
  await hanging(context);
  await throughTunnel(context);
}
