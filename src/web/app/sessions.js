// The sessions of tabs: each tab comes back to its own when it is loaded again; a new one can take up
// the last one of another that is gone.

import { forget, keep, kept, keptWith } from './keep.js';

// Number of sessions that are kept.
const MAX_KEPT = 10;

// The name of this tab, which it has as long as it is there.
function tabName() {
  try {
    sessionStorage.tab ??= crypto.randomUUID?.() ?? String(Math.random());
    return sessionStorage.tab;
  } catch {
    return 'only';
  }
}

const name = tabName();

export const keepSession = ({ seed, inputs }) => (inputs.length
  ? keep(`session:${name}`, { seed, inputs, at: Date.now() })
  : forget(`session:${name}`));

export const ownSession = () => kept(`session:${name}`, null);

// The last session of another tab, unless that is open; those that are too many are forgotten.
export async function lastSession() {
  const all = [...await keptWith('session:')].filter(([tab]) => tab !== name).sort(([, a], [, b]) => b.at - a.at);
  for (const [tab] of all.splice(MAX_KEPT)) forget(`session:${tab}`);
  const { held = [] } = (await navigator.locks?.query().catch(() => null)) ?? {};
  const open = new Set(held.map((lock) => lock.name));
  return all.find(([tab]) => !open.has(`planwright:${tab}`))?.[1] ?? null;
}

// Others see that the tab is open.
navigator.locks?.request(`planwright:${name}`, () => new Promise(() => {})).catch(() => {});
