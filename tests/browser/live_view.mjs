// Opens the live view in headless Chromium and uses it as a person would.
//
//   node tests/browser/live_view.mjs PLANWRIGHT CHROMIUM [FOLDER FOR PICTURES]

import { spawn, spawnSync } from 'node:child_process';
import { createServer } from 'node:http';
import { mkdirSync, mkdtempSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Browser, sleep } from './browser.mjs';
import { connections } from './connection.mjs';
import { savedRun } from './saved_run.mjs';

const [program, chromium, pictures = 'target/browser'] = process.argv.slice(2);
const PLAN = 'plans/tutorial/move-bottle.plan';
mkdirSync(pictures, { recursive: true });

const children = [];
let failures = 0;

function check(is, what) {
  console.log(`${is ? 'ok    ' : 'FAILED'} ${what}`);
  if (!is) failures += 1;
}

/** Starts planwright; returns the process and the address of its page. */
async function start(...args) {
  const child = spawn(program, args, { stdio: ['ignore', 'pipe', 'pipe'] });
  children.push(child);
  let told = '';
  for (const stream of [child.stdout, child.stderr]) stream.setEncoding('utf8').on('data', (text) => { told += text; });
  for (let i = 0; i < 600; i++) {
    const address = /http:\S+/.exec(told);
    if (address) return { child, address: address[0] };
    await sleep(0.05);
  }
  throw new Error(`no address: ${told}`);
}

const get = (tab, what) => tab.value(`(() => { const { counts, page, orbit, scene, past } = planwright; return ${what}; })()`);
const until = (tab, what, seconds) => tab.until(`(() => { const { counts, page, orbit, scene, past } = planwright; return ${what}; })()`, seconds);
const far = (a, b) => Math.hypot(...a.map((v, i) => v - b[i]));
const BASE = 'page.shown.places.get(page.views.base).slice(0, 3)';
const BOTTLE = '[...scene.nodes.values()].find((node) => node.type === "bottle")';

async function liveView(browser) {
  const { child, address } = await start('run', PLAN, '--view');
  // The plan waits for the page, however long a browser takes to open it.
  const paused = await fetch(`${address}pace`, { method: 'POST', body: 'pause', headers: { Origin: new URL(address).origin } });
  check(paused.ok, 'the run is paused before the page is open');
  const tab = await browser.open(address);
  await tab.until('!!window.planwright && planwright.counts.drawn > 2 && planwright.scene.nodes.size > 60');
  await until(tab, '[...scene.nodes.values()].filter((node) => node.mesh).length > 60');
  check(await tab.value('document.querySelector("#link").dataset.state') === 'live', 'the page opens and is connected');

  // Movement.
  await until(tab, 'page.pace.paused', 5);
  await tab.press('#play');
  const before = await get(tab, BASE);
  const measured = await tab.value(`new Promise((done) => {
    const [from, begin, drawn] = [planwright.counts.updates, performance.now(), planwright.counts.drawn];
    setTimeout(() => {
      const seconds = (performance.now() - begin) / 1000;
      done([(planwright.counts.updates - from) / seconds, (planwright.counts.drawn - drawn) / seconds]);
    }, 4000);
  })`);
  const [updates, drawn] = measured.map((rate) => rate.toFixed(1));
  check(measured[0] >= 30, `${updates} scene updates per second (at least 30), ${drawn} pictures per second drawn in software`);
  const moved = async () => far(before, await get(tab, BASE)) > 0.2;
  for (let i = 0; i < 200 && !await moved(); i++) await sleep(0.2);
  check(await moved(), 'the robot drives');
  // A picture may take longer than the whole plan on a slow machine.
  await tab.press('#play');
  await until(tab, 'page.pace.paused', 5);
  await tab.picture(join(pictures, 'live.png'));
  const stopped = await get(tab, 'past.span[1]');

  // The mouse.
  const [x, y] = [430, 420];
  let then = await get(tab, '[orbit.azimuth, orbit.elevation]');
  await tab.drag([x, y], [120, 40]);
  check(far(then, await get(tab, '[orbit.azimuth, orbit.elevation]')) > 0.3, 'dragging with the left button rotates');
  then = await get(tab, 'orbit.at');
  await tab.drag([x, y], [90, 30], 'right');
  check(far(then, await get(tab, 'orbit.at')) > 0.1, 'dragging with the right button moves');
  const distance = await get(tab, 'orbit.distance');
  await tab.wheel(x, y, -300);
  await until(tab, `orbit.distance < ${distance} * 0.9`, 5);
  check(true, 'the wheel zooms');
  then = await get(tab, 'orbit.at');
  await tab.click(x, y, 2);
  await until(tab, `Math.hypot(...orbit.at.map((v, i) => v - ${JSON.stringify(then)}[i])) > 0.05`, 10);
  check(true, 'a double click centres');

  // Views.
  for (const name of ['top', 'island', 'robot', 'follow', 'table']) {
    await tab.press(`#views [data-view=${name}]`);
    await until(tab, `page.named === '${name}' && !orbit.way`, 10);
    check(true, `view: ${name}`);
    if (name === 'top' || name === 'robot') await tab.picture(join(pictures, `${name}.png`));
  }

  // A click names the bottle, wherever it is.
  const at = await tab.value(`planwright.screenOf(${BOTTLE.replaceAll('scene', 'planwright.scene')}.id)`);
  await tab.click(...at);
  await tab.until('/^BOTTLE-1/.test(document.querySelector("#card").innerText)', 10);
  const card = await tab.value('document.querySelector("#card").innerText');
  check(/^BOTTLE-1/.test(card) && /type\s+bottle/.test(card) && /position/.test(card), `a click names the bottle: ${card.replaceAll(/\s+/g, ' ')}`);
  await tab.picture(join(pictures, 'bottle.png'));

  // Pause and speed.
  check(await get(tab, 'past.span[1]') === stopped, 'a pause stops simulated time');
  await tab.press('#play');
  await until(tab, `past.span[1] > ${stopped}`, 10);
  check(true, 'simulated time goes on after the pause');
  await tab.press('#speeds button:nth-child(3)');

  // The object in the hand. The page pauses as soon as it is held, or it may be put down before the
  // card is read.
  await until(tab, 'page.shown.held.length > 0 && (document.querySelector("#play").click(), true)', 40);
  await tab.until('/held by\\s+r_gripper/.test(document.querySelector("#card").innerText)', 10);
  check(true, 'the page names the hand that holds the bottle');
  await until(tab, 'page.pace.paused', 5);
  await tab.press('#play');

  // The past, while the session goes on.
  const place = await tab.value(`(() => { const b = document.querySelector('#slider').getBoundingClientRect(); return [b.x, b.y + b.height / 2, b.width]; })()`);
  await tab.click(place[0] + place[2] * 0.3, place[1]);
  await until(tab, 'page.time !== null && Math.abs(page.shown.t - page.time) < 0.1', 10);
  const [time, end] = await get(tab, '[page.time, past.span[1]]');
  check(time > end * 0.1 && time < end * 0.5, `the slider goes back, to ${time.toFixed(2)} of ${end.toFixed(2)} s`);
  const earlier = await get(tab, BASE);
  await until(tab, `past.span[1] > ${end} + 0.5`, 10);
  check(far(earlier, await get(tab, BASE)) < 1e-3, 'the past stands still while the session goes on');
  await tab.picture(join(pictures, 'past.png'));
  await tab.click(place[0] + place[2] * 0.6, place[1]);
  await until(tab, `page.time > ${time} + 0.5 && Math.abs(page.shown.t - page.time) < 0.1`, 10);
  check(true, 'the slider also goes forward');
  const began = await get(tab, 'page.time');
  await tab.press('#play');
  await until(tab, `page.shown.t > ${began} + 0.5`, 10);
  check(true, 'the past plays');
  await tab.press('#live');
  await until(tab, `page.time === null && scene.live.t - page.shown.t < 1 && page.shown.t > ${end}`, 10);
  check(true, 'the view returns to the present');

  // To the end.
  await tab.press('#speeds button:nth-child(6)');
  await tab.until('/The bottle stands at/.test(document.querySelector("#log-lines").innerText)', 60);
  await tab.until('document.querySelector("#task-list .task").classList.contains("succeeded")', 10);
  check(await tab.value('document.querySelectorAll("#task-list .failed").length') === 0, 'the page shows that the plan succeeded');
  await tab.picture(join(pictures, 'end.png'));
  check(tab.errors.length === 0, `no error on the console ${tab.errors.join('; ')}`);
  await tab.send('Page.navigate', { url: 'about:blank' });
  const ended = await Promise.race([new Promise((done) => child.on('exit', done)), sleep(10).then(() => 'late')]);
  check(ended === 0, `the run ends when the page is closed (${ended})`);
}

async function dark(browser, file) {
  const { child, address } = await start('view', file);
  const tab = await browser.open(address, { dark: true });
  await tab.until('!!window.planwright && planwright.counts.drawn > 0 && planwright.past.span[1] > 20', 30);
  await tab.press('#views [data-view=follow]');
  for (const share of [0.75, 0.25, 0.5]) {
    const span = await get(tab, 'past.span');
    const place = await tab.value(`(() => { const b = document.querySelector('#slider').getBoundingClientRect(); return [b.x, b.y + b.height / 2, b.width]; })()`);
    await tab.click(place[0] + place[2] * share, place[1]);
    await until(tab, `Math.abs(page.time / ${span[1]} - ${share}) < 0.1 && Math.abs(page.shown.t - page.time) < 0.1`, 15);
  }
  check(true, 'a recording is shown, and the slider goes back and forth');
  check(await tab.value('document.querySelectorAll("#task-list .task").length') > 4, 'the recording shows its tasks');
  await tab.picture(join(pictures, 'recording.png'));
  check(tab.errors.length === 0, `no error on the console ${tab.errors.join('; ')}`);
  child.kill();
}

// A page from another origin tries everything a page can try.
async function stranger(browser) {
  const { child, address } = await start('view', join(folder, 'run.mcap'));
  const server = createServer((request, response) => {
    response.writeHead(200, { 'Content-Type': 'text/html' });
    response.end('<!doctype html><link rel="icon" href="data:,"><title>stranger</title><iframe></iframe>');
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const tab = await browser.open(`http://127.0.0.1:${server.address().port}/`);
  await tab.until('document.title === "stranger"');
  const tried = await tab.value(`(async () => {
    const address = ${JSON.stringify(address)};
    const outcome = (promise) => promise.then((answer) => answer.type === 'opaque' ? 'opaque' : 'read ' + answer.status, () => 'refused');
    const events = new Promise((done) => {
      const source = new EventSource(address + 'events');
      source.onopen = () => done('read');
      source.onerror = () => { source.close(); done('refused'); };
    });
    const script = new Promise((done) => {
      const element = document.createElement('script');
      element.src = address + 'past?from=0&to=1';
      element.onload = () => done('read');
      element.onerror = () => done('refused');
      document.head.append(element);
    });
    const frame = new Promise((done) => {
      const element = document.querySelector('iframe');
      element.onload = () => { try { done(element.contentDocument ? 'read' : 'refused'); } catch { done('refused'); } };
      element.src = address;
    });
    return [
      await outcome(fetch(address)), await outcome(fetch(address + 'meshes')),
      await outcome(fetch(address + 'pace', { method: 'POST', body: 'pause' })),
      await events, await script, await frame,
    ];
  })()`);
  check(tried.every((outcome) => outcome === 'refused'), `another origin gets nothing: ${tried.join(', ')}`);
  server.close();
  child.kill();
}

const folder = mkdtempSync(join(tmpdir(), 'planwright-check-'));
const browser = new Browser(chromium);
try {
  await liveView(browser);
  const made = spawnSync(program, ['run', PLAN, '--record', join(folder, 'run.mcap')]);
  check(made.status === 0, 'a run is recorded');
  await dark(browser, join(folder, 'run.mcap'));
  await savedRun({ browser, check, program, pictures, folder, plan: PLAN });
  await stranger(browser);
  await connections({ browser, start, check, pictures, program, children, plan: PLAN });
} catch (error) {
  check(false, error.stack);
} finally {
  await browser.close();
  children.forEach((child) => child.kill('SIGKILL'));
  rmSync(folder, { recursive: true, force: true });
}
console.log(failures ? `${failures} failed` : 'all is well');
process.exit(failures ? 1 : 0);
