// What the page keeps in the browser: one record for each thing, by name, so that several tabs do not
// overwrite what the others keep.

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

// All whose names begin in the same way, by the rest of their names.
export async function keptWith(prefix) {
  const names = (await store('readonly', (all) => all.getAllKeys())) ?? [...memory.keys()];
  const found = new Map();
  for (const name of names) if (name.startsWith(prefix)) found.set(name.slice(prefix.length), await kept(name));
  return found;
}

export async function keep(name, value) {
  memory.set(name, value);
  await store('readwrite', (all) => all.put(value, name));
}

export async function forget(name) {
  memory.delete(name);
  await store('readwrite', (all) => all.delete(name));
}

export async function isLasting() {
  return (await database) !== null;
}
