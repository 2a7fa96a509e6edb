// The past, in pieces: they are got when they are needed, and some of them are kept.

const MOST_PIECES = 40;

// The pieces that the server has: a few seconds each.
const SERVED = {
  PIECE: 2,
  numberAt(time) { return Math.floor(time / this.PIECE); },
  begin(number) { return number * this.PIECE; },
  end(number) { return (number + 1) * this.PIECE; },
  async frames(number) {
    const answer = await fetch(`past?from=${this.begin(number)}&to=${this.end(number)}`);
    if (!answer.ok) throw new Error(answer.statusText);
    return answer.json();
  },
};

class Past {
  constructor() {
    this.store = SERVED;
    this.clear();
  }

  clear() {
    this.pieces = new Map();
    this.span = [0, 0];
  }

  // The state at a time if it is here; otherwise null. It is fetched then, and `come` is called
  // with whether that succeeded.
  at(time, come) {
    const number = this.store.numberAt(time);
    const piece = this.pieces.get(number);
    if (piece && piece.states && (piece.isWhole || time <= piece.until)) return this.pick(piece, time);
    if (!piece || (piece.states && !piece.isLoading)) this.fetch(number, come);
    return null;
  }

  // The state at a time, as soon as it is here; null if it cannot be had.
  async get(time) {
    for (let i = 0; i < 50; i++) {
      let wake;
      const come = new Promise((done) => { wake = done; });
      const state = this.at(time, wake);
      if (state) return state;
      // Another caller may have asked for it.
      const isHere = await Promise.race([come, new Promise((done) => setTimeout(done, 100, true))]);
      if (!isHere) return null;
    }
    return null;
  }

  // The last time that is here and not after another; null if there is none.
  lastKnown(time) {
    let last = null;
    for (const [number, { states, isWhole, until }] of this.pieces) {
      const begin = this.store.begin(number);
      if (!states || begin > time) continue;
      last = Math.max(last ?? begin, Math.min(time, isWhole ? this.store.end(number) - 1e-6 : until));
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
    const until = Math.min(this.store.end(number), this.span[1]);
    const isWhole = this.span[1] > this.store.end(number) + 0.1;
    const { pieces } = this;
    const before = pieces.get(number);
    pieces.set(number, { ...before, isLoading: true });
    try {
      const frames = await this.store.frames(number);
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
