// Links that hold a session: its seed and its inputs, from which it comes to the same bits.

const toText = (bytes) => btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
const fromText = (text) => Uint8Array.from(atob(text.replaceAll('-', '+').replaceAll('_', '/')), (char) => char.charCodeAt(0));

async function through(bytes, stream) {
  return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

export async function linkOf({ seed, inputs, files }) {
  const bytes = new TextEncoder().encode(JSON.stringify({ seed, inputs, files }));
  const packed = await through(bytes, new CompressionStream('deflate-raw'));
  let text = '';
  for (let at = 0; at < packed.length; at += 3072) text += toText(packed.subarray(at, at + 3072));
  return `${location.href.split(/[?#]/)[0]}#session=${text}`;
}

// The session in the page's address; null if there is none.
export async function sharedSession() {
  const [, packed] = /[#&]session=([\w-]+)/.exec(location.hash) ?? [];
  const plan = new URLSearchParams(location.search).get('plan');
  try {
    if (packed) {
      const bytes = await through(fromText(packed), new DecompressionStream('deflate-raw'));
      const { seed, inputs, files = {} } = JSON.parse(new TextDecoder().decode(bytes));
      const isInput = (input) => typeof input?.text === 'string';
      if (!Number.isSafeInteger(seed) || !Array.isArray(inputs) || !inputs.every(isInput)) throw new Error('it holds no session');
      return { seed, inputs, files };
    }
    if (plan?.trim().startsWith('(') || plan?.trim().startsWith(';')) return { seed: 0, inputs: [{ text: plan }], files: {} };
    if (plan) return { seed: 0, inputs: [{ text: `(load ${JSON.stringify(plan)})` }], files: {} };
  } catch (error) {
    return { error: `The link cannot be read: ${error.message}.` };
  }
  return null;
}
