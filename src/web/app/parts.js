// What the page is made of: texts, and packed parts. A packed part is in the page, or, where the page is a folder, in
// a file beside it.

import { XzReadableStream } from 'xz-decompress';
import { fromText } from './base85.js';

export const partText = (id) => document.getElementById(id).textContent.trim();

// Where a packed part is: its text, or the address of its file.
export const placeOf = (id) => {
  const text = document.getElementById(id)?.textContent;
  return text ? { text } : { address: new URL(`${id}.xz`, document.baseURI).href };
};

// A part, as it is unpacked.
export async function unpacked({ text, address }) {
  const packed = text
    ? new Blob([fromText(text)]).stream()
    : await fetch(address).then((answer) => {
      if (!answer.ok) throw new Error(`${address}: ${answer.status} ${answer.statusText}`);
      return answer.body;
    });
  return new Response(new XzReadableStream(packed));
}
