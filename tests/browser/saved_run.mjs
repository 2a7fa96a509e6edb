// Uses the page of a saved run, which is a file, as a person would: with the mouse, with fingers and
// with keys, on a screen, on a large one and on a phone.

import { spawnSync } from 'node:child_process';
import { mkdirSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { sleep } from './browser.mjs';

const PARTS = '{ counts, page, orbit, scene, past, tasks, log }';
const get = (tab, what) => tab.value(`(() => { const ${PARTS} = planwright; return ${what}; })()`);
const until = (tab, what, seconds) => tab.until(`(() => { const ${PARTS} = planwright; return ${what}; })()`, seconds);
const text = (tab, selector) => tab.value(`document.querySelector(${JSON.stringify(selector)}).innerText`);
const MESHES = '[...scene.nodes.values()].filter((node) => node.mesh).length > 60';

/** The page (pixels) at which a task's bar begins, or a point inside of it. */
const BAR = (name, share) => `(() => {
  const lanes = document.querySelector('#lane-canvas').getBoundingClientRect();
  const { past, tasks } = planwright;
  const task = tasks.all().find((task) => task.name === '${name}' && task.what === 'action');
  const time = task.since + (task.end - task.since) * ${share};
  const x = lanes.x + 8 + time / past.span[1] * (lanes.width - 16);
  return [x, task.depth, task.since, task.end];
})()`;

export async function savedRun({ browser, check, program, pictures, folder, plan }) {
  const file = join(folder, 'run.html');
  const made = spawnSync(program, ['run', plan, '--html', file]);
  const { size } = statSync(file);
  check(made.status === 0 && size < 5e6, `a run is saved: ${size} bytes`);
  await screen({ browser, check, pictures, folder, file });
  await failed({ browser, check, program, pictures, folder });
  await failures({ browser, check, program, pictures, folder });
  await phone({ browser, check, pictures, file });
  await large({ browser, check, pictures, file });
}

async function open(browser, file, options) {
  const tab = await browser.open(`file://${file}`, options);
  await tab.until('!!window.planwright && planwright.counts.drawn > 0 && planwright.past.span[1] > 20', 40);
  await until(tab, MESHES, 20);
  return tab;
}

async function failed({ browser, check, program, pictures, folder }) {
  const [plan, file] = [join(folder, 'fails.plan'), join(folder, 'failed.html')];
  writeFileSync(plan, '(pp-tut:with-simulated-robot (pp-tut:park-arms) (exe:perform (desig:a motion (type moving-torso) (joint-angle 0.5))))');
  spawnSync(program, ['run', plan, '--html', file]);
  const tab = await browser.open(`file://${file}`);
  await tab.until('!!window.planwright && planwright.counts.drawn > 0 && planwright.past.span[1] > 1', 40);
  await tab.until('document.querySelector("#link").textContent === "saved run, failed"', 10);
  check(true, 'a saved run that failed says so');
  const why = await text(tab, '#halt');
  check(/ended by a condition, at \d+\.\d\d s/i.test(why) && /torso-goal-not-reached/.test(why) && /fails\.plan:1:/.test(why), `and why: ${why.replaceAll(/\s+/g, ' ').slice(0, 120)}`);
  await tab.press('#failure-on');
  await until(tab, 'page.task !== null', 5);
  for (let i = 0; i < 3; i += 1) await tab.press('#failure-on');
  await tab.until('document.querySelector("#notice").textContent === "There is none after this."', 5);
  check(true, 'where there is no further failure, that is said');
  await tab.picture(join(pictures, 'saved-failed.png'));
}

async function screen({ browser, check, pictures, folder, file }) {
  const tab = await open(browser, file, {});
  check(await text(tab, '#link') === 'saved run', 'the file opens without a server');

  // Lanes.
  const [x, , since] = await tab.value(BAR('picking-up', 0.1));
  const y = await tab.value('document.querySelector("#lane-canvas").getBoundingClientRect().y + 13 + 6');
  await tab.mouse('mouseMoved', x, y);
  await tab.until('!document.querySelector("#tip").hidden && /picking-up/.test(document.querySelector("#tip").innerText)', 5);
  await until(tab, `page.peek !== null && Math.abs(page.shown.t - page.peek) < 0.1`, 20);
  check(await get(tab, 'page.time') === 0, 'pointing at a task names it and shows that moment');
  await tab.click(x, y);
  await until(tab, `Math.abs(page.shown.t - ${since}) < 0.1`, 20);
  await until(tab, 'page.marked !== null', 30);
  const card = await text(tab, '#card');
  check(/picking-up/.test(card) && /grasp\s+LEFT-SIDE/.test(card) && /move-bottle\.plan:\d+/.test(card) && /BOTTLE-1/.test(card), `a click goes to a task and tells about it: ${card.replaceAll(/\s+/g, ' ').slice(0, 90)} …`);
  const used = await get(tab, '[...page.marked.ids].map((id) => scene.nodes.get(id).name)');
  check(used.includes('BOTTLE-1') && used.includes('r_gripper_palm_link') && !used.some((name) => /^l_/.test(name) || name === 'base_link'), `what the task used is marked, and nothing else: ${used.length} things`);
  const picture = join(pictures, 'task.png'), share = await browser.difference(await tab.picture(picture), 'docs/pictures/live-view.png');
  check(share < 0.05, `docs/pictures/live-view.png shows the page as it is, but for ${(share * 100).toFixed(1)} % (otherwise copy ${picture})`);

  // A part of the time.
  const all = await get(tab, 'past.span[1]');
  await tab.wheel(x, y, -300);
  await tab.wheel(x, y, -300);
  await tab.until(`document.querySelector("#slider").max - document.querySelector("#slider").min < ${all} / 2`, 5);
  await tab.picture(join(pictures, 'zoomed.png'));
  await tab.mouse('mouseMoved', 400, 300);
  await tab.value('document.querySelector("#lane-canvas").dispatchEvent(new MouseEvent("dblclick", { bubbles: true }))');
  await tab.until(`document.querySelector("#slider").max - document.querySelector("#slider").min > ${all} * 0.99`, 5);
  check(true, 'the wheel zooms into the time, a double click shows all of it');

  // The address.
  await tab.until('/task=a/.test(location.hash)', 5);
  await tab.press('[data-layer=frames]');
  await tab.drag([400, 300], [80, 20]);
  await tab.until('/layers=frames/.test(location.hash)', 5);
  const before = await get(tab, '[orbit.azimuth, orbit.elevation, page.time]');
  await sleep(1.5);
  await tab.send('Page.reload', {});
  await sleep(0.5);
  await tab.until('!!window.planwright && planwright.counts.drawn > 0 && planwright.past.span[1] > 20', 40);
  await until(tab, 'page.task?.name === "picking-up"', 20);
  const after = await get(tab, '[orbit.azimuth, orbit.elevation, page.time]');
  check(before.every((v, i) => Math.abs(v - after[i]) < 2e-3), `time, view and selection last when the page is loaded again: ${after.map((v) => v.toFixed(2)).join(', ')}`);
  await until(tab, MESHES, 20);
  await tab.press('[data-layer=frames]');

  // Rows of tasks, lines of the log.
  const lifting = await tab.value('(() => { const line = [...document.querySelectorAll("#log-lines .line")].find((line) => /Lifting/.test(line.textContent)); line.click(); return parseFloat(line.textContent); })()');
  await until(tab, `${lifting} > 6 && Math.abs(page.time - ${lifting}) < 0.01`, 10);
  check(true, 'a line of the log leads to its time');
  for (const [key, way] of [['l', 1], ['L', -1], ['.', 1], [',', -1], ['ArrowRight', 1], ['ArrowLeft', -1]]) {
    const then = await get(tab, 'page.time');
    await tab.value(`document.body.dispatchEvent(new KeyboardEvent('keydown', { key: '${key}', bubbles: true }))`);
    check((await get(tab, 'page.time') - then) * way > 0, `key ${key}`);
  }
  await tab.value('document.querySelector("#canvas").focus()');
  const turned = await get(tab, 'orbit.azimuth');
  await tab.send('Input.dispatchKeyEvent', { type: 'keyDown', key: 'ArrowLeft', code: 'ArrowLeft', windowsVirtualKeyCode: 37 });
  check(Math.abs(await get(tab, 'orbit.azimuth') - turned) > 0.05, 'arrow keys turn the view');
  await tab.value('document.querySelector("#lane-canvas").focus()');
  const ways = [];
  for (const [key, code] of [['ArrowUp', 38], ['ArrowDown', 40], ['ArrowRight', 39], ['ArrowLeft', 37]]) {
    await tab.send('Input.dispatchKeyEvent', { type: 'keyDown', key, code: key, windowsVirtualKeyCode: code });
    await sleep(0.3);
    ways.push(await text(tab, '#path'));
  }
  check(ways.join(', ') === 'plan, plan › par 1 of 3, plan › par 2 of 3, plan › par 1 of 3', `with the bars in focus they go from task to task: ${ways.join(', ')}`);
  const whole = await tab.value('document.querySelector("#slider").max - document.querySelector("#slider").min');
  for (const key of ['+', '0']) {
    await tab.send('Input.dispatchKeyEvent', { type: 'keyDown', key, text: key });
    await tab.until(`(document.querySelector("#slider").max - document.querySelector("#slider").min < ${whole} * 0.8) === ${key === '+'}`, 5);
  }
  check(true, 'and zoom');

  // Forces.
  await tab.press('#card .close');
  await tab.press('#views [data-view=table]');
  await tab.press('[data-layer=forces]');
  await tab.value('(() => { const slider = document.querySelector("#slider"); slider.value = 7; slider.dispatchEvent(new Event("input")); })()');
  await tab.until('[...document.querySelectorAll("#labels span")].some((label) => /^[12]\\.\\d N$/.test(label.textContent))', 20);
  check(/10 N = 20 cm/.test(await text(tab, '#scale')), 'forces have their numbers and a scale');
  await sleep(1);
  await tab.picture(join(pictures, 'forces.png'));
  await tab.press('[data-layer=forces]');
  await tab.until('document.querySelector("#scale").hidden && !document.querySelectorAll("#labels span").length', 10);
  check(true, 'forces can be hidden');

  // A thing, its forms, distances, and where it is dragged.
  await tab.value('(() => { const slider = document.querySelector("#slider"); slider.value = 0; slider.dispatchEvent(new Event("input")); })()');
  await until(tab, 'page.shown.t < 0.1 && !orbit.way', 20);
  await sleep(1);
  const bottle = () => tab.value('planwright.screenOf([...planwright.scene.nodes.values()].find((node) => node.type === "bottle").id)');
  const at = await bottle();
  await tab.click(...at);
  await tab.until('/^BOTTLE-1/.test(document.querySelector("#card").innerText)', 10);
  const forms = await text(tab, '#card .forms');
  check(/'bottle-1/.test(forms) && /\(make-pose "map" '\(\(-1\.6/.test(forms), 'a click on a thing offers forms');
  await tab.press('#tools button:nth-child(1)');
  await tab.click(...at);
  await tab.click(at[0] + 60, at[1] + 60);
  await tab.until('/\\d\\.\\d{3} m /.test(document.querySelector("#ruler").innerText)', 10);
  check(true, `a distance is measured: ${(await text(tab, '#ruler')).slice(0, 8)}`);
  await tab.press('#tools button:nth-child(1)');
  await tab.press('#tools button:nth-child(2)');
  await tab.drag(at, [40, 20]);
  await tab.until('/\\(move-object \'bottle-1/.test(document.querySelector("#card .forms")?.innerText)', 10);
  check(true, `dragging offers the form that moves: ${/\(move-object.*/.exec(await text(tab, '#card .forms'))[0]}`);
  await tab.picture(join(pictures, 'dragged.png'));
  await tab.press('#tools button:nth-child(2)');

  // Panels.
  await tab.press('[data-tab=scene]');
  await tab.value('(() => { const filter = document.querySelector("#scene-filter"); filter.value = "bottle-1"; filter.dispatchEvent(new Event("input")); })()');
  await tab.until('document.querySelectorAll(".thing").length === 1', 10);
  await tab.press('.thing button:nth-child(4)');
  await until(tab, 'page.hidden.size === 1', 5);
  await tab.press('.thing button:nth-child(4)');
  await tab.press('.thing button:nth-child(3)');
  await tab.until('[...document.querySelectorAll("#labels span")].some((label) => label.textContent === "BOTTLE-1")', 10);
  check(true, 'things are hidden and named');
  await tab.press('[data-tab=joints]');
  await tab.until('document.querySelectorAll(".joint").length > 40', 10);
  await tab.value('[...document.querySelectorAll(".joint")].find((row) => /r_elbow_flex/.test(row.textContent)).click()');
  await tab.until('!document.querySelector("#joint-plot").hidden', 5);
  await tab.until('planwright.page && document.querySelector("#joint-plot").height > 100', 5);
  check(true, 'joints are plotted');
  for (const mode of ['colour', 'depth', 'segments']) {
    if (mode === 'colour') await tab.press('#tools button:last-child');
    else await tab.press(`[data-mode=${mode}]`);
    await sleep(1);
    await tab.picture(join(pictures, `inset-${mode}.png`));
  }
  check(await tab.value('!document.querySelector("#inset").hidden'), 'the robot’s eyes are shown in the corner');

  // Pictures.
  const downloads = join(folder, 'downloads');
  mkdirSync(downloads);
  await browser.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: downloads });
  await tab.press('#tools button:nth-child(3)');
  for (let i = 0; i < 100 && !readdirSync(downloads).some((name) => name.endsWith('.png')); i++) await sleep(0.1);
  await tab.press('#film');
  await sleep(4);
  await tab.press('#film');
  for (let i = 0; i < 100 && !readdirSync(downloads).some((name) => name.endsWith('.webm')); i++) await sleep(0.1);
  const saved = readdirSync(downloads).map((name) => `${name} ${statSync(join(downloads, name)).size}`);
  check(saved.length === 2 && saved.every((one) => Number(one.split(' ')[1]) > 5000), `a picture and a video are saved: ${saved.join(', ')}`);
  const heap = await tab.value('performance.memory.usedJSHeapSize');
  check(heap < 150e6, `${(heap / 1e6).toFixed(1)} MB of heap`);
  check(tab.errors.length === 0, `no error on the console ${tab.errors.join('; ')}`);
}

async function failures({ browser, check, program, pictures, folder }) {
  const file = join(folder, 'failing.html');
  spawnSync(program, ['run', 'plans/tutorial/changing-grasp.plan', '--html', file]);
  const tab = await open(browser, file, { dark: true });
  await tab.press('#failure-on');
  await until(tab, 'page.time > 0 && page.task !== null', 10);
  const [first, name] = await get(tab, '[page.time, page.task.name]');
  // The card is drawn with the next picture.
  await tab.until('/failed/.test(document.querySelector("#card").innerText)', 10);
  const card = await text(tab, '#card');
  check(/unreachable/.test(card), `the next failure: ${name} at ${first.toFixed(2)} s`);
  await tab.press('#failure-on');
  const second = await get(tab, '[page.time, page.task.id]');
  await tab.press('#failure-back');
  check(second[0] >= first && await get(tab, 'page.time') <= second[0], 'and back to the one before');
  await until(tab, 'page.isKnown', 20);
  await sleep(1);
  await tab.picture(join(pictures, 'failure.png'));
  check(tab.errors.length === 0, `no error on the console ${tab.errors.join('; ')}`);
}

async function phone({ browser, check, pictures, file }) {
  const tab = await open(browser, file, { width: 390, height: 844 });
  await tab.send('Emulation.setTouchEmulationEnabled', { enabled: true, maxTouchPoints: 5 });
  await sleep(0.5);
  const small = await tab.value(`[...document.querySelectorAll('button, input')]
    .filter((one) => one.checkVisibility() && one.getBoundingClientRect().width)
    .map((one) => [one.id || one.textContent, one.getBoundingClientRect()])
    .filter(([, box]) => box.width < 44 || box.height < 44).map(([name]) => name)`);
  check(small.length === 0, `targets of 44 pixels ${small.join(', ')}`);
  check(await tab.value('document.documentElement.scrollWidth') === 390, 'nothing is wider than a phone');
  const touch = (type, points) => tab.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y], id) => ({ x, y, id })) });
  const stroke = async (...ways) => {
    await touch('touchStart', ways.map(([from]) => from));
    for (let i = 1; i <= 6; i++) await touch('touchMove', ways.map(([[x, y], [dx, dy]]) => [x + dx * i / 6, y + dy * i / 6]));
    await touch('touchEnd', []);
    await sleep(0.3);
    return get(tab, '[orbit.distance, orbit.azimuth, ...orbit.at]');
  };
  const state = await get(tab, '[orbit.distance, orbit.azimuth, ...orbit.at]');
  const pinched = await stroke([[150, 250], [-50, 0]], [[250, 250], [50, 0]]);
  check(pinched[0] < state[0] * 0.7 && pinched[1] === state[1], 'pinching zooms');
  const moved = await stroke([[150, 250], [0, 50]], [[250, 250], [0, 50]]);
  check(Math.abs(moved[0] / pinched[0] - 1) < 0.1 && Math.abs(moved[4] - pinched[4]) > 0.05, 'two fingers move');
  const turned = await stroke([[150, 250], [70, 0]]);
  check(Math.abs(turned[1] - moved[1]) > 0.2, 'one finger turns');
  await tab.press('#views [data-view=table]');
  await sleep(2);
  const at = await tab.value('planwright.screenOf([...planwright.scene.nodes.values()].find((node) => node.type === "bottle").id)');
  await touch('touchStart', [at]);
  await touch('touchEnd', []);
  await tab.until('/^BOTTLE-1/.test(document.querySelector("#card").innerText)', 10);
  check(true, 'a tap selects');
  await tab.picture(join(pictures, 'phone.png'));
  await tab.press('#more');
  await tab.press('[data-tab=log]');
  await sleep(1);
  check(await tab.value('document.querySelector("#log").getBoundingClientRect().height') > 60, 'the log is a panel');
  await tab.picture(join(pictures, 'phone-log.png'));
  check(tab.errors.length === 0, `no error on the console ${tab.errors.join('; ')}`);
}

async function large({ browser, check, pictures, file }) {
  const tab = await open(browser, `${file}#t=8&view=table`, { width: 1920, height: 1080 });
  await until(tab, 'Math.abs(page.shown.t - 8) < 0.1', 20);
  await sleep(1.5);
  await tab.picture(join(pictures, 'large.png'));
  check(tab.errors.length === 0, `no error on the console ${tab.errors.join('; ')}`);
}
