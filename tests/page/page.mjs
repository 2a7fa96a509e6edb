// Uses the page in headless Chromium as a person would, and compares it with the program.
//
//   node tests/page/page.mjs PLANWRIGHT CHROMIUM FOLDER OF THE PAGE [FOLDER FOR PICTURES]

import { spawnSync } from 'node:child_process';
import { createServer } from 'node:http';
import { mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { Browser, sleep } from '../browser/browser.mjs';

const [program, chromium, folder, pictures = 'target/browser'] = process.argv.slice(2);
const page = `file://${resolve(folder, 'planwright.html')}`;
const axe = readFileSync(join(folder, 'app/node_modules/axe-core/axe.min.js'), 'utf8');
mkdirSync(pictures, { recursive: true });

let failures = 0;
function check(is, what) {
  console.log(`${is ? 'ok    ' : 'FAILED'} ${what}`);
  if (!is) failures += 1;
}

const IDLE = 'window.planwright?.engine.ways && !planwright.engine.isBusy';
const LINES = 'document.querySelector("#lines").innerText';
const text = (value) => JSON.stringify(value);

async function opened(browser, address, options) {
  const tab = await browser.open(address, options);
  await tab.until(IDLE, 60);
  return tab;
}

// Evaluates an input, at the greatest pace; comes back with how it ended.
const evaluate = (tab, input) => tab.value(`planwright.engine.setPace('speed max'), planwright.prompt.add(${text(input)})`);

async function key(tab, name, code, modifiers = 0, typed = undefined) {
  const event = { key: name, code: name.length === 1 ? `Key${name.toUpperCase()}` : name, windowsVirtualKeyCode: code, modifiers, text: typed };
  await tab.send('Input.dispatchKeyEvent', { type: typed ? 'keyDown' : 'rawKeyDown', ...event });
  await tab.send('Input.dispatchKeyEvent', { type: 'keyUp', ...event });
}
const enter = (tab) => key(tab, 'Enter', 13, 0, '\r');
const CONTROL = 2, SHIFT = 8;

async function type(tab, input) {
  await tab.send('Input.insertText', { text: input });
  await enter(tab);
}

// What the program says of the same inputs.
function native(inputs) {
  const done = spawnSync(program, [], { input: `${inputs.join('\n')}\n(pw:world-hash)\n`, encoding: 'utf8', maxBuffer: 1 << 28 });
  return /"([0-9a-f]{16})"\s*$/.exec(done.stdout.trimEnd())?.[1] ?? done.stdout.slice(-400) + done.stderr;
}

async function opens(browser) {
  // The time that the browser takes to start is not the page's.
  await browser.send('Browser.getVersion');
  const begin = Date.now();
  const tab = await opened(browser, page, { width: 1440, height: 860 });
  const seconds = (Date.now() - begin) / 1000;
  const opening = (await tab.value('performance.getEntriesByName("prompt")[0].startTime')) / 1000;
  check(seconds < 20, `the first prompt after ${seconds.toFixed(2)} s from opening the file, ${opening.toFixed(2)} s of these in the page (bar 2 s on a quiet machine)`);
  await tab.until('document.querySelector("#view-frame").contentWindow.planwright?.counts.drawn > 2', 30);
  await tab.until('[...document.querySelector("#view-frame").contentWindow.planwright.scene.nodes.values()].filter((node) => node.mesh).length > 60', 30);
  check(true, 'the live view shows the kitchen');
  return tab;
}

async function walk(tab) {
  await type(tab, '(in-package :pp-tut)');
  await tab.until(`${LINES}.includes('CRAM-PICK-PLACE-TUTORIAL')`);
  check(await tab.value('document.querySelector("#prompt-name").textContent') === 'PP-TUT>', 'what is typed is evaluated, and the prompt follows');
  await type(tab, '(+ 1');
  await type(tab, '2)');
  await tab.until(`/\\(\\+ 1\\n\\s*2\\)\\s*3/.test(${LINES})`);
  check(true, 'Enter continues an input that is not whole');
  // The session is asked at each Enter; the next lines are there before it has answered.
  const pressed = { type: 'keyDown', key: 'Enter', code: 'Enter', windowsVirtualKeyCode: 13, text: '\r' };
  await Promise.all(['(list 1', '2', '3)', '(list 4', '5)'].flatMap((text) => [
    tab.send('Input.insertText', { text }), tab.send('Input.dispatchKeyEvent', pressed), tab.send('Input.dispatchKeyEvent', { ...pressed, type: 'keyUp', text: undefined }),
  ]));
  await tab.until(`/\\(list 1\\n\\s*2\\n\\s*3\\)\\s*\\(1 2 3\\)[^]*\\(list 4\\n\\s*5\\)\\s*\\(4 5\\)/.test(${LINES})`);
  check(true, 'however fast lines are typed, each ends where Enter was pressed');
  await tab.send('Input.insertText', { text: '(park-a' });
  await tab.until('document.querySelector(".cm-tooltip-autocomplete li")', 10);
  const offered = await tab.value('document.querySelector(".cm-tooltip-autocomplete").innerText');
  check(/park-arms/.test(offered), `words are completed: ${offered.replaceAll('\n', ' ').slice(0, 60)}`);
  await sleep(0.3);
  await key(tab, 'Tab', 9);
  await tab.until('planwright.prompt.editor.state.doc.toString() === "(park-arm"', 5);
  await tab.send('Input.insertText', { text: ' ' });
  await tab.until('document.querySelector("#hint b")?.textContent === "arm"', 5);
  check(true, 'Tab takes a completion, and the hint says what it takes');
  await key(tab, 'c', 67, CONTROL);
  check(await tab.value('planwright.prompt.editor.state.doc.toString()') === '', 'Ctrl-C clears the input');

  await type(tab, '(car 5)');
  await tab.until('document.querySelectorAll(".restart:enabled").length === 3', 10);
  await tab.picture(join(pictures, 'page-debugger.png'));
  await tab.press('.restart:nth-of-type(3)');
  await tab.until('document.querySelector("#prompt-name").textContent === "PP-TUT>"', 10);
  check(await tab.value('document.querySelectorAll(".restart:enabled").length') === 0, 'a restart is chosen by a click');

  await type(tab, '(loop)');
  await sleep(1);
  const begin = Date.now();
  await key(tab, 'c', 67, CONTROL);
  await tab.until(IDLE, 10);
  check(Date.now() - begin < 8000, `Ctrl-C is heard after ${Date.now() - begin} ms`);
  await type(tab, 'q');
  await tab.until(IDLE, 10);
  await tab.value('planwright.engine.setPace("speed 1")');
  await type(tab, '(with-simulated-robot (perform (a motion (type moving-torso) (joint-angle 0.3))))');
  await sleep(0.7);
  check(await tab.value('planwright.engine.isBusy'), 'motions take their time at the pace of real time');
  await key(tab, 'c', 67, CONTROL);
  await tab.until(IDLE, 10);
  check(await tab.value('document.querySelector("#prompt-name").textContent') === 'PP-TUT stopped>', 'and are interrupted');
  await evaluate(tab, '0');
  await evaluate(tab, '(pw:picture :width 320 :height 240)');
  await tab.until('document.querySelector("#lines img")?.naturalWidth === 320', 10);
  check(true, 'pictures are shown');
}

async function tutorial(tab) {
  await tab.value('planwright.tutorial.show(3)');
  check(/Objects/.test(await tab.value('document.querySelector("#chapter").selectedOptions[0].text')), 'the tutorial has its chapters');
  await tab.value('planwright.engine.setPace("speed max")');
  await tab.press('#chapter-afresh');
  await tab.until(`/as at the beginning of .*Objects/.test(${LINES})`, 60);
  check(await tab.value('document.querySelector("#prompt-name").textContent') === 'PP-TUT>', 'a chapter begins where the one before it ends');
  await tab.press('.step.here .try');
  await tab.until('document.querySelectorAll(".step.done").length === 1', 20);
  await tab.press('.step.here .try');
  await tab.until(`${LINES}.includes('-0.90000 0.82078')`, 20);
  check(await tab.value('document.querySelectorAll(".step.done").length') === 2, 'a step is taken by a click, and marked');
  await tab.until(IDLE, 20);
  await sleep(1);
  const picture = join(pictures, 'page.png'), share = await tab.browser.difference(await tab.picture(picture), 'docs/pictures/page.png');
  check(share < 0.05, `docs/pictures/page.png shows the page as it is, but for ${(share * 100).toFixed(1)} % (otherwise copy ${picture})`);
}

async function isKept(browser, tab) {
  await tab.value('planwright.files.edit("own.plan", "(defun six () 6)\\n", true), planwright.files.save()');
  await evaluate(tab, '(load "own.plan")');
  const inputs = await tab.value('planwright.engine.inputs.length');
  const hash = (await evaluate(tab, '(six)')).hash;
  await sleep(0.5);
  await tab.value('window.isOld = true');
  await tab.send('Page.reload');
  await tab.until(`!window.isOld && window.planwright?.engine.inputs.length === ${inputs + 1} && ${IDLE}`, 60);
  const again = await evaluate(tab, '(six)');
  check(again.hash === hash && (await tab.value(LINES)).includes('that you left'), 'files and the session are there after the page was loaded again, to the bit');
  const link = await tab.value(`(async () => {
    let link = null;
    Object.defineProperty(navigator, 'clipboard', { value: { writeText: async (text) => { link = text; } }, configurable: true });
    document.querySelector('#share').click();
    for (let i = 0; i < 100 && !link; i++) await new Promise((go) => setTimeout(go, 50));
    return link;
  })()`);
  const other = await opened(browser, link);
  await other.until('document.querySelector("#offer").open', 10);
  check((await other.value('document.querySelector("#offer-text").innerText')).includes('(six)'), 'a shared link shows what it holds');
  await other.press('#offer-run');
  await other.until(`planwright.engine.inputs.length === ${inputs + 2} && !planwright.engine.isBusy`, 60);
  const shared = await evaluate(other, '(six)');
  check(shared.hash === hash, 'and comes to the same bits');
}

async function sameBits(browser) {
  const tab = await opened(browser, page);
  const warm = await tab.value('planwright.warm');
  check(warm && !warm.level, 'a plan has run to its end before somebody runs one');
  const fresh = () => tab.value('planwright.engine.begin()');
  const compare = async (what, inputs) => {
    await fresh();
    const begin = Date.now();
    let done;
    for (const input of inputs) {
      done = await evaluate(tab, input);
      if (done.level) done = await evaluate(tab, 'q');
    }
    const seconds = (Date.now() - begin) / 1000;
    const before = Date.now();
    const expected = native(inputs);
    check(done.hash === expected, `${what}: ${done.hash}, the program ${expected}; ${seconds.toFixed(2)} s, the program ${((Date.now() - before) / 1000).toFixed(2)} s`);
  };
  await compare('move-bottle', ['(load "plans/tutorial/move-bottle.plan")']);
  await compare('table setting', ['(load "plans/demos/table-setting.plan")', '(in-package :pp-tut)']);
  const chapters = await tab.value('planwright.tutorial.chapters.slice(0, 19).map(({ html }) => html).join("")');
  const steps = [...chapters.matchAll(/data-input="([^"]*)"/g)].map(([, input]) => input.replaceAll('&quot;', '"').replaceAll('&lt;', '<').replaceAll('&amp;', '&'));
  await compare(`the tutorial's ${steps.length} inputs`, steps);

  await tab.value(`planwright.showPane('files'), planwright.files.edit('plans/sweeps/move-bottle.plan', planwright.files.plans['plans/sweeps/move-bottle.plan'], false)`);
  await tab.value(`document.querySelector('#sweep-worlds').value = 20, document.querySelector('#sweep-seed').value = 7, planwright.sweeper.run()`);
  const records = await tab.value('planwright.sweeper.records?.join("\\n")');
  const args = ['sweep', 'plans/sweeps/move-bottle.plan', '--worlds', '20', '--seed', '7'];
  const expected = spawnSync(program, [...args, '--json'], { encoding: 'utf8' }).stdout.trimEnd();
  check(records === expected && expected.split('\n').length === 20, `a sweep of 20 worlds gives the same records (${await tab.value('document.querySelector("#sweep-progress").textContent')})`);
  const summary = spawnSync(program, args, { encoding: 'utf8' }).stdout;
  check(summary.includes((await tab.value('planwright.sweeper.summary')).trimEnd()), 'and the same summary');
  await tab.picture(join(pictures, 'page-sweep.png'));
}

async function goesOn(browser) {
  const tab = await opened(browser, page);
  await evaluate(tab, '(defparameter *kept* 17)');
  for (const [what, input] of [
    ['parentheses without end', `(read-from-string (make-string 200000 :initial-element #\\()))`],
    ['a deep list', `(let ((l '())) (dotimes (i 100000) (setf l (list l))) (print l) nil)`],
    ['a deep quotation', `(eval (let ((l 1)) (dotimes (i 100000) (setf l (list 'progn l))) l))`],
    ['a recursion without end', '(labels ((f (x) (1+ (f x)))) (f 1))'],
    ['memory without end', `(let ((l '())) (loop (push (make-array 100000) l)))`],
    ['output without end', '(dotimes (i 100000) (print i))'],
    ['control characters', '(format t "~a[31m<b>~a" (code-char 27) (code-char 7))'],
  ]) {
    const { level } = await evaluate(tab, input);
    if (level) await evaluate(tab, 'q');
    const kept = await evaluate(tab, '(print *kept*)');
    check(kept.outcome === 'finished' && !kept.level, `the session goes on after ${what}`);
  }
  check(await tab.value('document.querySelectorAll("#lines b:not(.prompt)").length') === 0, 'output is text');
  await tab.value(`planwright.engine.crash('for a trial')`);
  await tab.until(`${IDLE} && ${LINES}.includes('ended unexpectedly')`, 60);
  const back = await evaluate(tab, '(print *kept*)');
  check(back.outcome === 'finished', 'a session that crashed is put back');
}

async function phone(browser) {
  const tab = await opened(browser, page, { width: 390, height: 844, dark: true });
  await tab.send('Emulation.setDeviceMetricsOverride', { width: 390, height: 844, deviceScaleFactor: 2, mobile: true });
  for (const pane of ['tutorial', 'files', 'prompt', 'view']) {
    await tab.press(`#panes [data-pane="${pane}"]`);
    await sleep(0.5);
    check(await tab.value('document.documentElement.scrollWidth <= 390'), `a phone shows the pane ${pane} without sideways scrolling`);
    await tab.picture(join(pictures, `page-phone-${pane}.png`));
  }
}

// What keeps somebody from reading a page, by its rules.
async function barriers(tab) {
  await tab.value(axe);
  return tab.value(`axe.run(document, { iframes: false }).then(({ violations }) => violations.map(({ id, nodes }) => id + ': ' + nodes.map(({ target }) => target).join(' ')))`);
}

async function withoutBarriers(browser) {
  for (const dark of [false, true]) {
    const tab = await opened(browser, page, { width: 1440, height: 860, dark });
    await evaluate(tab, '(car 5)');
    await evaluate(tab, '(print "x")');
    for (const pane of ['tutorial', 'files']) {
      await tab.value(`planwright.showPane('${pane}')`);
      const found = await barriers(tab);
      check(found.length === 0, `axe finds nothing (${dark ? 'dark' : 'light'}, ${pane}): ${found.join('; ')}`);
    }
  }
}

// A saved run that has failed, one without a task, the report of a sweep, and the pages of a class and of a student, as the program writes them.
async function reportsWithoutBarriers(browser) {
  const folder = mkdtempSync(join(tmpdir(), 'planwright-reports-'));
  const file = (name) => join(folder, name);
  writeFileSync(file('fails.plan'), '(in-package :pp-tut) (roslisp:ros-warn (test) "soon") (with-simulated-robot (park-arms) (perform (a motion (type moving-torso) (joint-angle 5))))');
  writeFileSync(file('idle.plan'), '(+ 40 2)');
  for (const args of [
    ['run', file('idle.plan'), '--record', file('idle.mcap')], ['view', file('idle.mcap'), '--html', file('idle.html')],
    ['run', file('fails.plan'), '--record', file('run.mcap')], ['view', file('run.mcap'), '--html', file('run.html')],
    ['sweep', 'plans/sweeps/move-bottle.plan', '--worlds', '8', '--seed', '42', '--html', file('sweep.html')],
    ['grade', 'bring-the-bottle', file('fails.plan'), '--html', file('class')],
  ]) spawnSync(program, args);
  for (const name of ['idle', 'run', 'sweep', 'class/index', 'class/fails']) {
    for (const [kind, options] of [['desktop', {}], ['phone', { width: 390, height: 844 }], ['dark', { dark: true }]]) {
      const tab = await browser.open(`file://${file(`${name}.html`)}`, options);
      await tab.until('document.querySelector("h1")', 20);
      await sleep(1);
      const found = await barriers(tab);
      check(found.length === 0, `axe finds nothing (${name}, ${kind}): ${found.join('; ')}`);
    }
  }
  rmSync(folder, { recursive: true });
}

async function byKeyboard(browser) {
  const tab = await opened(browser, page, { width: 1440, height: 860 });
  const focused = () => tab.value(`(() => { const at = document.activeElement; return at.id || at.getAttribute('aria-label') || at.tagName; })()`);
  await tab.until('document.activeElement.getAttribute("aria-label") === "Next input"', 10);
  check(await focused() === 'Next input', 'the prompt has the focus');
  // Escape, then Tab, leaves an editor; the robot is behind it, all else before it.
  await key(tab, 'Escape', 27);
  const seen = [];
  for (let i = 0; i < 24; i += 1) {
    await key(tab, 'Tab', 9, SHIFT);
    seen.push(await focused());
  }
  check(['chapter', 'chapter-text', 'share'].every((id) => seen.includes(id)), `the keyboard reaches what there is: ${[...new Set(seen)].join(' ')}`);
}

async function fromServer(browser) {
  const served = [];
  const server = createServer((request, answer) => {
    const name = request.url.split(/[?#]/)[0].replace(/^\/$/, '/index.html');
    served.push(name);
    // Cross-origin isolation: what is shared between page and worker is allowed.
    const headers = { 'Cross-Origin-Opener-Policy': 'same-origin', 'Cross-Origin-Embedder-Policy': 'require-corp' };
    try {
      const bytes = readFileSync(join(folder, 'site', name));
      answer.writeHead(200, { ...headers, 'Content-Type': name.endsWith('html') ? 'text/html' : 'application/octet-stream' });
      answer.end(bytes);
    } catch {
      answer.writeHead(404).end();
    }
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const address = `http://127.0.0.1:${server.address().port}/`;
  const tab = await browser.open(address);
  await tab.until(IDLE, 60);
  check(['/index.html', '/page.xz', '/program-1.xz', '/program-2.xz', '/library.xz'].every((name) => served.includes(name)) && served.length === 5, `from a server it takes five files: ${served.join(' ')}`);
  // Where nothing can be suspended, memory is shared; where neither can be, the worker is ended.
  for (const [way, before] of [['shared memory', 'delete WebAssembly.Suspending;'], ['a new worker', 'delete WebAssembly.Suspending;']]) {
    await tab.value(`(async () => {
      planwright.engine.sources.worker = URL.createObjectURL(new Blob([${text(before)} + document.getElementById('worker').textContent], { type: 'text/javascript' }));
      ${way === 'a new worker' ? "Object.defineProperty(self, 'crossOriginIsolated', { value: false });" : ''}
      await planwright.engine.begin();
      await planwright.engine.run({ text: '(defparameter *kept* 17)' });
    })()`);
    tab.value(`void planwright.prompt.add('(loop)')`);
    await sleep(1);
    await tab.value('planwright.engine.interrupt()');
    await tab.until(`!planwright.engine.isBusy && planwright.engine.inputs.length`, 20);
    const kept = await evaluate(tab, '(print *kept*)');
    check(kept.outcome === 'finished', `an endless loop is interrupted by ${way}`);
  }
  server.close();
}

const browser = new Browser(chromium);
const asked = [];
browser.hearers.push(({ method, params }) => {
  if (method === 'Network.requestWillBeSent' && !/^(file|blob|data|about):|^http:\/\/127\.0\.0\.1:/.test(params.request.url)) asked.push(params.request.url);
});
try {
  const tab = await opens(browser);
  await tab.send('Network.enable');
  await walk(tab);
  await tutorial(tab);
  await isKept(browser, tab);
  check(tab.errors.length === 0, `the page reports no errors: ${tab.errors.join('; ')}`);
  await sameBits(browser);
  await goesOn(browser);
  await phone(browser);
  await withoutBarriers(browser);
  await reportsWithoutBarriers(browser);
  await byKeyboard(browser);
  await fromServer(browser);
  check(asked.length === 0, `no request leaves the page: ${asked.join(' ')}`);
} catch (error) {
  check(false, error.stack);
} finally {
  await browser.close();
}
console.log(failures ? `${failures} failed` : 'the page works');
process.exit(failures ? 1 : 0);
