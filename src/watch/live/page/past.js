// The past: fetched in pieces of a few seconds, some of which are kept.

const PIECE = 2;
const MOST_PIECES = 40;

class Past {
  constructor() { this.clear(); }

  clear() {
    this.pieces = new Map();
    this.span = [0, 0];
  }

  // The state at a time if it is here; otherwise it is fetched and `come` is called then.
  at(time, come) {
    const number = Math.floor(time / PIECE);
    const piece = this.pieces.get(number);
    if (piece && piece.states && (piece.isWhole || time <= piece.until)) return this.pick(piece, time);
    if (!piece || (piece.states && !piece.isLoading)) this.fetch(number, come);
    return piece && piece.states ? this.pick(piece, time) : null;
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
    const before = this.pieces.get(number);
    this.pieces.set(number, { ...before, isLoading: true });
    try {
      const answer = await fetch(`past?from=${number * PIECE}&to=${(number + 1) * PIECE}`);
      const frames = await answer.json();
      const states = [];
      for (const frame of frames) states.push(follow(states.at(-1) || EMPTY, frame));
      this.pieces.delete(number);
      this.pieces.set(number, { states, isWhole, until, isLoading: false });
      while (this.pieces.size > MOST_PIECES) this.pieces.delete(this.pieces.keys().next().value);
      come();
    } catch {
      // The session is gone; what has been fetched can still be shown.
      if (before && before.states) this.pieces.set(number, { ...before, isWhole: true });
      else this.pieces.delete(number);
    }
  }
}
