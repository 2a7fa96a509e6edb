// What the page keeps in the browser: one record for each thing, by name.

const database = new Promise((go) => {
  try {
    const request = indexedDB.open('planwright', 1);
    request.onupgradeneeded = () => request.result.createObjectStore('kept');
    request.onsuccess = () => go(request.result);
    request.onerror = () => go(null);
  } catch {
    go(null);
  }
});

// Without a database, what is kept lasts as long as the page.
const memory = new Map();

async function store(mode, work) {
  const opened = await database;
  if (!opened) return undefined;
  return new Promise((go) => {
    const transaction = opened.transaction('kept', mode);
    const request = work(transaction.objectStore('kept'));
    transaction.oncomplete = () => go(request.result);
    transaction.onerror = transaction.onabort = () => go(undefined);
  });
}

export async function kept(name, otherwise) {
  return memory.get(name) ?? (await store('readonly', (all) => all.get(name))) ?? otherwise;
}

export async function keep(name, value) {
  memory.set(name, value);
  await store('readwrite', (all) => all.put(value, name));
}

export async function isLasting() {
  return (await database) !== null;
}
