// node build.mjs WASM REPOSITORY OUT: puts the page together, as one file and as a folder.
import { build } from 'esbuild';
import { marked } from 'marked';
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { toText } from './base85.js';
import { inputsOf } from './session_blocks.js';

const [wasmPath, repository, out] = process.argv.slice(2);
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

const inline = (text) => text.replaceAll('</script', '<\\/script');
const part = (id, text) => `<script type="text/plain" id="${id}">${text}</script>\n`;
const data = (id, value) => `<script type="application/json" id="${id}">${JSON.stringify(value).replaceAll('<', '\\u003c')}</script>\n`;

const wasm = readFileSync(wasmPath);
const packed = gzipSync(wasm, { level: 9 }), code = gzipSync(await compiledLibrary(wasm), { level: 9 });
const bundled = await build({
  entryPoints: [join(here, 'main.js')], bundle: true, minify: true, format: 'iife', target: 'es2022', write: false, legalComments: 'none',
});
const program = bundled.outputFiles[0].text;
const common = data('tutorial-data', tutorial()) + data('plans-data', plans())
  + part('worker', inline(read(here, 'worker.js'))) + part('shim', inline(read(here, 'view_shim.js')));
const page = (policy, parts) => read(here, 'index.html')
  .replace('<!--policy-->', () => `<meta http-equiv="Content-Security-Policy" content="${policy}">`)
  .replace('/*style*/', () => read(here, 'style.css'))
  .replace('<!--parts-->', () => `${parts}<script>${inline(program)}</script>`);
const rules = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; "
  + "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'";

mkdirSync(join(out, 'site'), { recursive: true });
const one = page(rules, common + part('wasm', toText(packed)) + part('code', toText(code)));
writeFileSync(join(out, 'planwright.html'), one);
writeFileSync(join(out, 'site', 'index.html'), page(`${rules}; connect-src 'self'`, common));
writeFileSync(join(out, 'site', 'planwright.wasm.gz'), packed);
writeFileSync(join(out, 'site', 'library.gz'), code);
const site = gzipSync(Buffer.from(page(rules, common)), { level: 9 }).length + packed.length + code.length;
const MB = (bytes) => `${(bytes / 1e6).toFixed(2)} MB`;
console.log(`planwright.html: ${MB(Buffer.byteLength(one))}; site: ${MB(site)} (${MB(wasm.length)} of WebAssembly)`);
