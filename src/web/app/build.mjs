// node build.mjs WASM REPOSITORY OUT [PRESET]: puts the page together, as one file and as a folder. What xz
// does with the preset 9 takes it a quarter of a minute; with 1, a few seconds, and the page is larger.
import { build } from 'esbuild';
import { marked } from 'marked';
import { spawnSync } from 'node:child_process';
import { mkdirSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { toText } from './base85.js';
import { inputsOf } from './session_blocks.js';

const [wasmPath, repository, out, preset = '9'] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const read = (...path) => readFileSync(join(...path), 'utf8');
const escaped = (text) => text.replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');

// What sessions start from: the program itself compiles its library and its plans.
async function compiledLibrary(wasm) {
  let code = null, failed = null, memory = null;
  const take = (at, count) => Buffer.from(memory.buffer, at, count);
  const page = {
    now: () => performance.now(),
    wait() {},
    breathe() {},
    text(at, count) { failed = take(at, count).toString(); },
    bytes(whatAt, whatCount, at, count) { code = Buffer.from(take(at, count)); },
  };
  const { instance } = await WebAssembly.instantiate(wasm, { page });
  memory = instance.exports.memory;
  instance.exports.precompile();
  if (!code) throw new Error(`the library cannot be compiled: ${failed}`);
  return code;
}

// A chapter of the tutorial: its session blocks have a button at each input.
function chapter(markdown) {
  const renderer = new marked.Renderer();
  renderer.code = ({ text, lang }) => {
    if (lang !== 'session') return `<pre><code>${escaped(text)}</code></pre>\n`;
    const inputs = inputsOf(text).map(({ prompt, text: input, shown }) =>
      `<div class="step"><button class="try" type="button" data-input="${escaped(input)}" aria-label="Evaluate">▶</button>`
      + `<pre><b class="prompt">${escaped(prompt)} </b><code>${escaped(input)}</code>${shown ? `\n<samp>${escaped(shown)}</samp>` : ''}</pre></div>`);
    return `<div class="session">${inputs.join('')}</div>\n`;
  };
  // Other documents are not in the page.
  renderer.link = ({ href, text }) => (href.startsWith('#') ? `<a href="${escaped(href)}">${text}</a>` : `<cite>${text}</cite>`);
  renderer.image = ({ text }) => `<em>${escaped(text)}</em>`;
  return marked.parse(markdown, { renderer });
}

function tutorial() {
  const [head, ...rest] = read(repository, 'docs/tutorial.md').split(/^## /m);
  const start = head.replace(/^# .*\n/, '').replace(/^- \[.*\n/gm, '').replace(/`cargo run[^`]*` in a clone of the repository\nstarts the prompt\./, '').replace(/`cargo run[^`]*` in a clone of the repository starts the prompt\.\s/, '');
  const chapters = rest.map((text) => {
    const [title] = text.split('\n', 1);
    return { title, html: chapter(text.slice(title.length)) };
  });
  return [{ title: 'Welcome', html: chapter(start) }, ...chapters];
}

// The plans that come with the program, which can be read and copied.
function plans() {
  const all = {};
  for (const folder of ['tutorial', 'exercises', 'demos', 'sweeps']) {
    for (const file of readdirSync(join(repository, 'plans', folder)).sort()) {
      if (file.endsWith('.plan')) all[`plans/${folder}/${file}`] = read(repository, 'plans', folder, file);
    }
  }
  return all;
}

// The page unpacks what it loads itself, so that any server will do. Much of the code occurs many times, far apart:
// xz finds that, and gzip does not. The dictionary is what a browser must hold while it unpacks.
function packed(bytes) {
  const args = ['--format=xz', '--check=crc32', '--stdout', `--lzma2=preset=${preset},dict=32MiB`];
  const { status, stdout, stderr, error } = spawnSync('xz', args, { input: bytes, maxBuffer: 1 << 28 });
  if (status !== 0) throw error ?? new Error(`xz: ${stderr}`);
  return stdout;
}

const wasm = readFileSync(wasmPath);
const script = async (name) => {
  const bundled = await build({
    entryPoints: [join(here, name)], bundle: true, minify: true, format: 'iife', target: 'es2022', write: false, legalComments: 'none',
  });
  return bundled.outputFiles[0].text;
};
const texts = {
  'tutorial-data': JSON.stringify(tutorial()),
  'plans-data': JSON.stringify(plans()),
  worker: read(here, 'worker.js'),
  shim: read(here, 'view_shim.js'),
};
const boot = (await script('boot.js')).replaceAll('</script', '<\\/script');
const page = (policy, parts) => read(here, 'index.html')
  .replace('<!--policy-->', () => `<meta http-equiv="Content-Security-Policy" content="${policy}">`)
  .replace('/*style*/', () => read(here, 'style.css'))
  .replace('<!--parts-->', () => `${parts}<script>${boot}</script>`);
const rules = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; "
  + "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'";

// The second part of the program is unpacked before the library.
const half = Math.ceil(wasm.length * 0.55);
// Each is a part of the one file, and a file of the folder.
const parts = {
  page: packed(JSON.stringify({ texts, script: await script('main.js') })),
  'program-1': packed(wasm.subarray(0, half)),
  'program-2': packed(wasm.subarray(half)),
  library: packed(await compiledLibrary(wasm)),
};
const inPage = Object.entries(parts).map(([id, bytes]) => `<script type="text/plain" id="${id}">${toText(bytes)}</script>\n`);
const one = page(rules, inPage.join('')), index = page(`${rules}; connect-src 'self'`, '');
mkdirSync(join(out, 'site'), { recursive: true });
for (const name of readdirSync(join(out, 'site'))) rmSync(join(out, 'site', name));
writeFileSync(join(out, 'planwright.html'), one);
writeFileSync(join(out, 'site', 'index.html'), index);
for (const [id, bytes] of Object.entries(parts)) writeFileSync(join(out, 'site', `${id}.xz`), bytes);
const MB = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
const files = { 'index.html': Buffer.byteLength(index), ...Object.fromEntries(Object.entries(parts).map(([id, bytes]) => [id, bytes.length])) };
const sum = Object.values(files).reduce((a, b) => a + b);
console.log(`planwright.html: ${MB(Buffer.byteLength(one))}; site: ${MB(sum)} `
  + `(${Object.entries(files).map(([name, bytes]) => `${name} ${MB(bytes)}`).join(', ')}), with ${MB(wasm.length)} of WebAssembly`);
