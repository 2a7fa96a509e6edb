// Browsers compile code anew, and better, once it has run for a while, for all workers of the program. So that this has
// happened before somebody runs a plan, another session carries the bottle, and is thrown away; at the latest when
// somebody has typed an input, which needs the machine more.

const PLAN = '(load "plans/tutorial/move-bottle.plan")';

// Comes back with how the plan ended; with nothing if it did not run to its end.
export async function warmUp(engine) {
  // Whoever pays for data or power has a slower first plan instead.
  if (navigator.connection?.saveData || navigator.hardwareConcurrency < 2) return undefined;
  const [module, code] = await engine.parts();
  const worker = engine.makeWorker();
  const done = await new Promise((end) => {
    engine.addEventListener('input', () => end(), { once: true });
    worker.onmessage = ({ data }) => {
      if (data.ready) worker.postMessage({ open: { seed: 0, files: {} } });
      else if (data.open) worker.postMessage({ evaluate: { text: PLAN, again: true } });
      else if (data.done || data.crashed || data.failed) end(data.done);
    };
    worker.onerror = () => end();
    worker.postMessage({ wasm: module, code });
  });
  worker.terminate();
  return done;
}
