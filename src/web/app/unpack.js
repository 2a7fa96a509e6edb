// A worker that unpacks the program and what sessions start from, while the page builds itself.

import { unpacked } from './parts.js';

onmessage = async ({ data: { program, library } }) => {
  try {
    // Both at once: one waits for its file or for the compiler while the other is unpacked.
    const [module, code] = await Promise.all([
      WebAssembly.compileStreaming(unpacked(program, 'application/wasm')),
      unpacked(library, 'application/octet-stream').then((whole) => whole.arrayBuffer()),
    ]);
    postMessage({ parts: [module, code] }, [code]);
  } catch (error) {
    postMessage({ failed: String(error?.message ?? error) });
  }
};
