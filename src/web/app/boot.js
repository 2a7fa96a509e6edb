// Begins: unpacks the page's texts and its script, which does all else.

import { placeOf, unpacked } from './parts.js';

unpacked(placeOf('page'), 'application/json').then((whole) => whole.json()).then(({ texts, script }) => {
  for (const [id, text] of Object.entries(texts)) {
    document.body.append(Object.assign(document.createElement('script'), { type: 'text/plain', id, textContent: text }));
  }
  document.body.append(Object.assign(document.createElement('script'), { textContent: script }));
}).catch((error) => {
  document.getElementById('progress').textContent = `The page cannot be loaded (${error.message}).`;
});
