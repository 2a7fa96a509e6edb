// The page: puts the parts together.

import { Console } from './console.js';
import { Engine } from './engine.js';
import { UserFiles } from './files.js';
import { isLasting } from './keep.js';
import { LiveView } from './live_view.js';
import { keepSession, lastSession, ownSession } from './sessions.js';
import { linkOf, sharedSession } from './share.js';
import { Sweeper } from './sweep.js';
import { Tutorial } from './tutorial.js';
import { warmUp } from './warm_up.js';

const find = (id) => document.getElementById(id);

// On small screens one pane is shown at a time; on large ones the left pane is the tutorial or the files.
function showPane(name) {
  document.body.dataset.pane = name;
  if (name === 'tutorial' || name === 'files') document.body.dataset.left = name;
  for (const button of document.querySelectorAll('#panes button')) button.setAttribute('aria-pressed', String(button.dataset.pane === name));
}

const files = new UserFiles(find('files'));
const engine = new Engine(() => files.all());
const prompt = new Console(engine, find('prompt'));
const view = new LiveView(engine, find('view-frame'));
const tutorial = new Tutorial(engine, prompt, find('tutorial'));

const sweeper = new Sweeper(engine, prompt, files, find('files'));
files.onText = (text) => sweeper.show(text);

find('panes').addEventListener('click', (event) => {
  const { pane } = event.target.closest('button')?.dataset ?? {};
  if (pane) showPane(pane);
});
find('new-session').addEventListener('click', () => {
  prompt.clear();
  keepSession({ seed: 0, inputs: [] });
  engine.begin();
});
find('share').addEventListener('click', async () => {
  const link = await linkOf({ seed: engine.seed, inputs: engine.inputs, files: Object.fromEntries([...files.texts].filter(([, contents]) => typeof contents === 'string')) });
  const isCopied = await navigator.clipboard?.writeText(link).then(() => true, () => false);
  prompt.remark(isCopied ? 'The link is copied: it holds the inputs of this session and your files.' : `This link holds the session: ${link}`);
});
// Ctrl-C interrupts wherever the focus is, unless something is selected to be copied.
document.addEventListener('keydown', (event) => {
  if (event.key === 'c' && event.ctrlKey && !getSelection().toString() && engine.isBusy) engine.interrupt();
});

engine.addEventListener('done', () => keepSession(engine));
engine.addEventListener('idle', () => {
  performance.mark('prompt');
  window.planwright.warm = warmUp(engine);
}, { once: true });
window.addEventListener('beforeunload', (event) => { if (!files.isSaved) event.preventDefault(); });
// For tests and for the curious.
window.planwright = { engine, prompt, view, tutorial, files, sweeper, showPane };

async function start() {
  showPane('prompt');
  document.body.dataset.left = 'tutorial';
  await files.load();
  files.attach(engine, prompt);
  const shared = await sharedSession();
  const earlier = shared ? null : await ownSession();
  if (!(await isLasting())) prompt.remark('This browser keeps nothing: files and the session are lost when the page is left.');
  await engine.begin(earlier ?? {});
  if (earlier) prompt.remark('This is the session that you left. “New session” begins another one.');
  else prompt.remark('A simulated robot in its kitchen, programmed in plans. Enter evaluates a whole form, Tab completes, Ctrl-C interrupts. (help) lists what you can do.');
  const last = earlier || shared ? null : await lastSession();
  if (last) {
    const back = Object.assign(document.createElement('button'), { type: 'button', textContent: `Bring back the last session (${last.inputs.length} inputs)` });
    back.addEventListener('click', () => { back.disabled = true; engine.begin(last); });
    prompt.append(back);
  }
  if (shared?.error) prompt.remark(shared.error);
  else if (shared) offer(shared);
  prompt.editor.focus();
}

// What a stranger has put into a link is shown before it is evaluated.
function offer({ seed, inputs, files: texts }) {
  const box = find('offer');
  find('offer-text').textContent = inputs.map(({ text }) => text).join('\n\n');
  const names = Object.keys(texts);
  find('offer-files').textContent = names.length ? `It brings files: ${names.join(', ')}. Yours of the same names are replaced.` : '';
  box.showModal();
  find('offer-run').onclick = async () => {
    box.close();
    for (const [name, text] of Object.entries(texts)) files.put(name, String(text));
    history.replaceState(null, '', location.href.split(/[?#]/)[0]);
    prompt.clear();
    await engine.begin({ seed });
    for (const { text, interruptedAt } of inputs) await engine.run({ text, interruptedAt });
  };
  find('offer-leave').onclick = () => box.close();
}

start();
