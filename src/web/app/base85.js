// Bytes as text of the page: five characters for four bytes, none of which ends a script or begins a
// comment in HTML.

const SIGNS = [...Array(94).keys()].map((at) => String.fromCharCode(33 + at)).filter((sign) => !'<&"\'`\\'.includes(sign)).slice(0, 85).join('');

// The text of bytes, after the number of bytes and a space.
export function toText(bytes) {
  const view = new DataView(new ArrayBuffer(Math.ceil(bytes.length / 4) * 4));
  new Uint8Array(view.buffer).set(bytes);
  const pieces = [`${bytes.length} `];
  for (let at = 0; at < view.byteLength; at += 4) {
    let word = view.getUint32(at), piece = '';
    for (let i = 0; i < 5; i += 1) {
      piece = SIGNS[word % 85] + piece;
      word = Math.floor(word / 85);
    }
    pieces.push(piece);
  }
  return pieces.join('');
}

export function fromText(text) {
  const values = new Uint8Array(128);
  for (let at = 0; at < SIGNS.length; at += 1) values[SIGNS.charCodeAt(at)] = at;
  const start = text.indexOf(' ') + 1;
  const length = Number(text.slice(0, start));
  const view = new DataView(new ArrayBuffer(Math.ceil(length / 4) * 4));
  for (let at = 0, from = start; at < view.byteLength; at += 4, from += 5) {
    let word = 0;
    for (let i = 0; i < 5; i += 1) word = word * 85 + values[text.charCodeAt(from + i)];
    view.setUint32(at, word);
  }
  return new Uint8Array(view.buffer, 0, length);
}
