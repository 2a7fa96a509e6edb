// The past: fetched in pieces of a few seconds, some of which are kept.

const PIECE = 2;
const MOST_PIECES = 40;

class Past {
  constructor() { this.clear(); }

  clear() {
    this.pieces = new Map();
    this.span = [0, 0];
  }

  // The state at a time if it is here; otherwise null. It is fetched then, and `come` is called
  // with whether that succeeded.
  at(time, come) {
    const number = Math.floor(time / PIECE);
    const piece = this.pieces.get(number);
    if (piece && piece.states && (piece.isWhole || time <= piece.until)) return this.pick(piece, time);
    if (!piece || (piece.states && !piece.isLoading)) this.fetch(number, come);
    return null;
  }

  // The last time that is here and not after another; null if there is none.
  lastKnown(time) {
    let last = null;
    for (const [number, { states, isWhole, until }] of this.pieces) {
      const begin = number * PIECE;
      if (!states || begin > time) continue;
      last = Math.max(last ?? begin, Math.min(time, isWhole ? begin + PIECE - 1e-6 : until));
    }
    return last;
  }

  pick(piece, time) {
    const { states } = piece;
    let low = 0, high = states.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (states[middle].t <= time) low = middle;
      else high = middle - 1;
    }
    return states[low] || null;
  }

  async fetch(number, come) {
    const until = Math.min((number + 1) * PIECE, this.span[1]);
    const isWhole = this.span[1] > (number + 1) * PIECE + 0.1;
    const { pieces } = this;
    const before = pieces.get(number);
    pieces.set(number, { ...before, isLoading: true });
    try {
      const answer = await fetch(`past?from=${number * PIECE}&to=${(number + 1) * PIECE}`);
      if (!answer.ok) throw new Error(answer.statusText);
      const frames = await answer.json();
      const states = [];
      for (const frame of frames) states.push(follow(states.at(-1) || EMPTY, frame));
      pieces.delete(number);
      pieces.set(number, { states, isWhole, until, isLoading: false });
      while (pieces.size > MOST_PIECES) pieces.delete(pieces.keys().next().value);
      come(true);
    } catch {
      // What has been fetched before can still be shown.
      if (before?.states) pieces.set(number, { ...before, isLoading: false });
      else pieces.delete(number);
      // Others may have taken the connection: it is tried again, but not at once.
      setTimeout(() => come(false), 300);
    }
  }
}
