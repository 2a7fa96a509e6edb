// A saved run: the page is a file, which holds what it would otherwise ask the server for.

// What was packed as zlib and base64.
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text), (char) => char.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Response(stream).arrayBuffer();
}

const textOf = async (packed) => JSON.parse(new TextDecoder().decode(await unpacked(packed)));

// The pieces of the past in a file: each has the time at which it begins, and frames.
class SavedPieces {
  constructor(pieces) { this.pieces = pieces; }

  // A piece lasts until the next one begins.
  numberAt(time) {
    let low = 0, high = this.pieces.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (this.pieces[middle][0] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  begin(number) { return this.pieces[number][0]; }

  end(number) { return this.pieces[number + 1]?.[0] ?? Infinity; }

  async frames(number) { return this.pieces[number] ? textOf(this.pieces[number][1]) : []; }
}

async function openRun(text) {
  try {
    const run = JSON.parse(text);
    const { views, span, nodes, news, halt } = await textOf(run.head);
    HEARD.hello({ recording: true, saved: true, views });
    past.store = new SavedPieces(run.pieces);
    past.span = span;
    scene.addNodes(nodes);
    HEARD.news(news);
    if (page.time < span[0]) page.time = span[0];
    const meshes = await unpacked(run.meshes);
    if (stage) for (const mesh of meshesIn(meshes)) stage.load(mesh);
    if (halt) {
      linked('halted', 'saved run, failed');
      HEARD.halt(halt);
    }
    showTransport();
    page.isDirty = true;
  } catch (error) {
    linked('lost', 'unreadable');
    notice('link', `This file cannot be shown: ${error.message}`);
  }
}
