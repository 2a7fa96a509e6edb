// The worker: one WebAssembly instance, which has one session. What comes in are the page's
// requests, the files of the program, and interrupts; what goes out are the session's messages.
//
// While an input is evaluated, the session breathes now and then. How the page is heard at a breath
// depends on the browser: the stack is suspended (`suspends`), or the page writes into memory that both
// share (`shared`), or it is not heard at all and can only end the worker.

// Milliseconds between two messages about the live view, and between two breaths.
const BETWEEN_NEWS = 15, BETWEEN_BREATHS = 25;
// What shared memory holds: an interrupt, a cell to wait at, the number of changes of pace, and the pace.
const INTERRUPT = 0, CELL = 1, PACES = 2, PACE = 3;

let wasm, shared = null, isBusy = false, heardPaces = 0, lastNews = 0, lastBreath = 0;
const suspends = typeof WebAssembly.Suspending === 'function';
const waiting = [];
const decoder = new TextDecoder(), encoder = new TextEncoder();

const bytesAt = (at, count) => new Uint8Array(wasm.memory.buffer, at, count);
// Text of shared memory cannot be decoded in place, and bytes are sent away.
const textAt = (at, count) => decoder.decode(bytesAt(at, count).slice());

function write(bytes) {
  const at = wasm.room(bytes.length);
  bytesAt(at, bytes.length).set(bytes);
  return bytes.length;
}

const hear = (request) => wasm.hear(write(encoder.encode(JSON.stringify(request))));

// Lets the worker's other messages in, without the delay of timers.
const channel = new MessageChannel(), turns = [];
channel.port1.onmessage = () => turns.shift()();
const turn = () => new Promise((go) => { turns.push(go); channel.port2.postMessage(0); });

function readShared() {
  if (Atomics.exchange(shared, INTERRUPT, 0)) wasm.interrupt();
  const paces = Atomics.load(shared, PACES);
  if (paces === heardPaces) return;
  heardPaces = paces;
  const pace = Atomics.load(shared, PACE);
  hear({ pace: pace === -1 ? 'pause' : pace === -2 ? 'go' : pace === -3 ? 'speed max' : `speed ${pace / 1000}` });
}

// Output is collected, so that a program that prints much does not send as many messages.
let output = null;

function send(message, transfer) {
  if (message.text !== undefined && output?.kind === message.kind && output.text.length < 50000) {
    output.text += message.text;
    return;
  }
  const before = output;
  output = message.text !== undefined ? message : null;
  if (before) postMessage(before);
  if (message.text === undefined) postMessage(message, transfer);
}

function sendNews() {
  lastNews = performance.now();
  if (output) postMessage(output);
  output = null;
  wasm.show_news();
}

function breathe() {
  const now = performance.now();
  if (now - lastNews >= BETWEEN_NEWS) sendNews();
  if (!isBusy || now - lastBreath < BETWEEN_BREATHS) return undefined;
  lastBreath = now;
  if (suspends) return turn();
  if (shared) readShared();
  return undefined;
}

function wait(milliseconds) {
  sendNews();
  if (!isBusy) return undefined;
  if (suspends) return milliseconds < 1 ? turn() : new Promise((go) => { setTimeout(go, milliseconds); });
  if (shared) {
    Atomics.wait(shared, CELL, 0, milliseconds);
    readShared();
    return undefined;
  }
  const end = performance.now() + milliseconds;
  while (performance.now() < end);
  return undefined;
}

const pausing = (f) => (suspends ? new WebAssembly.Suspending(f) : f);

const imports = {
  page: {
    now: () => performance.now(),
    wait: pausing(wait),
    breathe: pausing(breathe),
    text(at, count) {
      const message = JSON.parse(textAt(at, count));
      send(message);
      // A page that gets nodes needs their meshes.
      const nodes = message.news?.find(([name]) => name === 'nodes');
      if (nodes) waiting.unshift({ meshes: nodes[1][0].id });
      if (nodes && !isAnswering) answerNow();
    },
    bytes(whatAt, whatCount, at, count) {
      const bytes = bytesAt(at, count).slice();
      send({ what: textAt(whatAt, whatCount), bytes: bytes.buffer }, [bytes.buffer]);
    },
  },
};

// Requests that are answered while an input is evaluated.
const isQuick = (request) => ['meshes', 'past', 'pace', 'file', 'enter', 'viewPage'].some((name) => name in request);
let isAnswering = false;

// Answers the quick requests that wait.
function answerNow() {
  isAnswering = true;
  // An answer may bring another request. It is not asked for from within.
  setTimeout(() => {
    isAnswering = false;
    for (let at = 0; at < waiting.length;) {
      if (isQuick(waiting[at])) hear(waiting.splice(at, 1)[0]);
      else at += 1;
    }
  });
}

const evaluating = () => (suspends ? WebAssembly.promising(wasm.hear) : wasm.hear);

async function work() {
  if (isBusy) return;
  try {
    while (waiting.length) {
      const request = waiting.shift();
      if (isQuick(request)) {
        hear(request);
        continue;
      }
      isBusy = true;
      await evaluating()(write(encoder.encode(JSON.stringify(request))));
      isBusy = false;
      sendNews();
    }
  } catch (error) {
    // Memory is exhausted, or there is a defect: this instance cannot go on.
    postMessage({ crashed: String(error?.message ?? error), memory: wasm.memory.buffer.byteLength });
  }
}

onmessage = async ({ data }) => {
  if (data.wasm) {
    shared = data.shared ? new Int32Array(data.shared) : null;
    const instance = await WebAssembly.instantiate(data.wasm, imports);
    wasm = instance.exports;
    if (data.code) wasm.provide(write(new Uint8Array(data.code)));
    postMessage({ ready: { suspends, shares: Boolean(shared) } });
    return;
  }
  if (data.interrupt) {
    wasm.interrupt();
    return;
  }
  waiting.push(data);
  if (!isBusy) work();
  else if (isQuick(data)) answerNow();
};
