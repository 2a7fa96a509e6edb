// A student's walk: opens planwright.html and goes through the tutorial to the bottle that is grasped in spite of
// failures, by mouse and keyboard alone; then the same inputs are typed in a terminal. Says how long each takes.
//
//   node tests/page/walk.mjs [PLANWRIGHT [CHROMIUM [PAGE [LAST CHAPTER]]]]

import { spawnSync } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { Browser, sleep } from '../browser/browser.mjs';

const [program = 'target/release/planwright', chromium = '/usr/bin/chromium', page = 'target/page/planwright.html', last = '11'] = process.argv.slice(2);
const pictures = 'target/browser';
mkdirSync(pictures, { recursive: true });

// The session waits for an input.
const IDLE = 'window.planwright?.engine.ways && !planwright.engine.isBusy';
const LINES = 'document.querySelector("#lines").innerText';
const text = (value) => JSON.stringify(value);

async function enter(tab) {
  const key = { key: 'Enter', code: 'Enter', windowsVirtualKeyCode: 13 };
  await tab.send('Input.dispatchKeyEvent', { type: 'keyDown', text: '\r', ...key });
  await tab.send('Input.dispatchKeyEvent', { type: 'keyUp', ...key });
}

// Types an input line by line; the editor indents.
async function type(tab, input) {
  for (const line of input.split('\n')) {
    await tab.send('Input.insertText', { text: line.trim() });
    await enter(tab);
  }
}

// Clicks what there is, after scrolling it into view.
async function click(tab, selector) {
  await tab.value(`document.querySelector(${text(selector)}).scrollIntoView({ block: 'center' })`);
  await tab.press(selector);
}

// The live view goes as fast as it can: its button `max`.
async function hurry(tab) {
  const [x, y] = await tab.until(`(() => {
    const frame = document.querySelector('#view-frame');
    const max = [...frame.contentDocument?.querySelectorAll('button') ?? []].find((button) => button.textContent.trim() === 'max');
    if (!max?.getBoundingClientRect().width) return null;
    max.scrollIntoView({ inline: 'center' });
    const outer = frame.getBoundingClientRect(), inner = max.getBoundingClientRect();
    return [outer.x + inner.x + inner.width / 2, outer.y + inner.y + inner.height / 2];
  })()`, 30);
  await tab.click(x, y);
}

// Goes through the chapters; comes back with what was typed or clicked, and the times.
async function inPage(browser) {
  const begin = Date.now(), since = () => (Date.now() - begin) / 1000;
  const tab = await browser.open(`file://${resolve(page)}`, { width: 1440, height: 860 });
  await tab.until(IDLE, 60);
  const opened = since();
  await hurry(tab);
  const inputs = [], counts = { clicked: 0, typed: 0 };
  let shown = '';
  const given = async (how, input) => {
    counts[how] += 1;
    inputs.push(input);
    await tab.until(`planwright.engine.inputs.length === ${inputs.length} && !planwright.engine.isBusy`, 60);
  };
  for (let chapter = 1; chapter <= Number(last); chapter += 1) {
    await tab.press('#chapter-on');
    await tab.until(`document.querySelector('#chapter').selectedOptions[0].text.startsWith('${chapter} ')`, 5);
    const steps = await tab.value(`[...document.querySelectorAll('.step')].map((step) => ({
      input: step.querySelector('.try').dataset.input, shown: step.querySelector('samp')?.innerText ?? '',
      prompt: step.querySelector('.prompt').innerText.trim() }))`);
    for (const [at, { input, prompt, shown: expected }] of steps.entries()) {
      // What stopped before is left by its last restart, unless the tutorial goes on there.
      if (!/\]>$/.test(prompt) && await tab.value('document.querySelectorAll(".restart:enabled").length')) {
        const restart = `restart-${inputs.length}`;
        const number = await tab.value(`(() => {
          const button = [...document.querySelectorAll('.restart:enabled')].at(-1);
          button.id = '${restart}';
          return button.innerText.split(':')[0];
        })()`);
        await click(tab, `#${restart}`);
        await given('clicked', number);
      }
      if (at % 2) {
        await tab.press('#typed .cm-content');
        await type(tab, input);
        await given('typed', input);
      } else {
        await click(tab, `.step.here .try[data-input=${text(input).replaceAll('\\n', '\\a ')}]`);
        await given('clicked', input);
      }
      shown = expected;
    }
    const done = await tab.value('document.querySelectorAll(".step.done").length');
    if (done !== steps.length) throw new Error(`chapter ${chapter}: ${done} of ${steps.length} steps are marked as done`);
  }
  const seconds = since();
  if (!(await tab.value(LINES)).trimEnd().endsWith(shown.trimEnd())) throw new Error(`the page does not end with ${shown}`);
  await tab.until('document.querySelector("#view-frame").contentWindow.planwright?.counts.drawn > 2', 30);
  await sleep(0.5);
  await tab.picture(join(pictures, 'page-walk.png'));
  if (tab.errors.length) throw new Error(tab.errors.join('; '));
  return { opened, seconds, inputs, counts, shown };
}

const browser = new Browser(chromium);
try {
  const { opened, seconds, inputs, counts, shown } = await inPage(browser);
  console.log(`in the page: prompt after ${opened.toFixed(1)} s, chapter ${last} done after ${seconds.toFixed(1)} s, by ${counts.clicked} clicks and ${counts.typed} typed inputs: ${shown}`);
  const terminal = spawnSync('python3', ['tests/page/walk_terminal.py', program, shown], { input: JSON.stringify(inputs), encoding: 'utf8' });
  process.stdout.write(terminal.stdout);
  if (terminal.status !== 0) throw new Error(terminal.stderr);
} catch (error) {
  console.log(`FAILED: ${error.stack}`);
  process.exitCode = 1;
} finally {
  await browser.close();
}
