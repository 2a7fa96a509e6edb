// Begins: workers unpack the program, which takes the longest, while the page's texts, and its script, which does all
// else, are unpacked here. The workers run this script, too.

import { placeOf, unpacked } from './parts.js';

// The parts at some places, one after the other.
async function serve({ data: places }) {
  try {
    const parts = [];
    for (const place of places) parts.push(await (await unpacked(place)).arrayBuffer());
    postMessage({ parts }, parts);
  } catch (error) {
    postMessage({ failed: String(error?.message ?? error) });
  }
}

// Parts by their names, unpacked by a worker.
function unpackedAside(script, ids) {
  return new Promise((go, fail) => {
    const worker = new Worker(script);
    worker.onerror = (event) => fail(new Error(event.message));
    worker.onmessage = ({ data: { parts, failed } }) => {
      worker.terminate();
      if (parts) go(parts);
      else fail(new Error(failed));
    };
    worker.postMessage(ids.map(placeOf));
  });
}

// The program, whose halves are unpacked at the same time, and what sessions start from.
async function program(script) {
  const [[first], [second, library]] = await Promise.all([
    unpackedAside(script, ['program-1']), unpackedAside(script, ['program-2', 'library']),
  ]);
  const whole = new Uint8Array(first.byteLength + second.byteLength);
  whole.set(new Uint8Array(first));
  whole.set(new Uint8Array(second), first.byteLength);
  return [await WebAssembly.compile(whole), library];
}

function begin() {
  const script = URL.createObjectURL(new Blob([document.currentScript.textContent], { type: 'text/javascript' }));
  self.program = program(script);
  // A failure is reported when a session begins.
  self.program.catch(() => {});
  unpacked(placeOf('page')).then((whole) => whole.json()).then(({ texts, script: main }) => {
    for (const [id, text] of Object.entries(texts)) {
      document.body.append(Object.assign(document.createElement('script'), { type: 'text/plain', id, textContent: text }));
    }
    document.body.append(Object.assign(document.createElement('script'), { textContent: main }));
  }).catch((error) => {
    document.getElementById('progress').textContent = `The page cannot be loaded (${error.message}).`;
  });
}

if (self.document) begin();
else onmessage = serve;
