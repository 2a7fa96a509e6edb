// Messages from the session, and the connection to it.

// The server says something twice per second; after this long (ms) without a word it is gone, or
// the way to it is.
const SILENCE = 5000;
// Between two attempts to connect (ms): the first, and at most.
const RETRY = [500, 5000];

const LOST = {
  over: ['session ended', 'The session has ended.'],
  gone: ['disconnected', 'There is no connection to the session. Trying again …'],
  silent: ['no answer', 'The session does not answer. Trying again …'],
  other: ['another session', 'Another session has this address now; it has printed where its page is.'],
  full: ['too many pages', 'Too many pages show this session. Trying again …'],
};

let source = null, heard = 0, quiet = 0, attempts = 0, retry = null;

function connect() {
  const own = new EventSource('events');
  source = own;
  heard = performance.now();
  const on = (name, hear) => own.addEventListener(name, (event) => {
    if (own !== source) return;
    heard = performance.now();
    hear(JSON.parse(event.data), own);
    page.isDirty = true;
  });
  for (const [name, hear] of Object.entries(HEARD)) on(name, hear);
  own.addEventListener('error', async () => {
    if (own !== source) return;
    // An answer that is no stream comes from a server that does not know this page, or has no
    // room for it.
    const isRefused = own.readyState === EventSource.CLOSED;
    lose('gone');
    if (!isRefused) return;
    const status = await fetch('meshes?from=1e9').then((answer) => answer.status, () => 0);
    if (source || page.link !== 'gone') return;
    if (status === 404) lose('other');
    else if (status === 503) lose('full');
  });
}

// The connection is lost: from now on the page shows what it knows, and nothing can be asked for.
function lose(why) {
  source?.close();
  source = null;
  page.link = why;
  page.isPlaying = page.isPlaying && page.time !== null;
  const [state, text] = LOST[why];
  linked('lost', state);
  notice('link', text);
  showTransport();
  showHalt();
  clearTimeout(retry);
  // The page has the same address again when the session opens it again.
  const wait = Math.min(RETRY[1], RETRY[0] * 2 ** attempts);
  attempts += 1;
  if (why !== 'other') retry = setTimeout(connect, wait);
}

setInterval(() => {
  quiet = source && performance.now() - heard > SILENCE ? quiet + 1 : 0;
  // Words that have come while the page was busy or asleep are heard before the second time.
  if (quiet < 2) return;
  quiet = 0;
  lose('silent');
}, 1000);

const HEARD = {
  hello(hello) {
    attempts = 0;
    page.link = 'live';
    for (const node of scene.nodes.values()) stage?.unload(node);
    scene.clear();
    past.clear();
    tasks.clear();
    log.clear();
    jointPanel.clear();
    page.hidden.clear();
    page.labelled.clear();
    select(null);
    page.halt = null;
    page.isRecording = hello.recording;
    page.views = hello.views;
    if (stage) stage.camera = hello.views.camera;
    if (hello.recording) page.time ??= 0;
    linked('live', hello.saved ? 'saved run' : hello.recording ? 'recording' : 'live');
    notice('link', '');
    notice('past', '');
    makeViews();
    if (page.hasView) showViews();
    else {
      look(hello.views.fixed[0]?.name ?? 'follow', true);
      followAddress();
    }
    page.hasView = true;
    showTransport();
    showHalt();
  },

  nodes(nodes, own) {
    scene.addNodes(nodes);
    loadMeshes(nodes[0].id, own);
  },

  frame(frame) {
    scene.live = follow(scene.live, frame);
    counts.updates += 1;
  },

  span(span) {
    past.span = span;
    if (page.time !== null && page.time < span[0]) page.time = span[0];
  },

  news(list) {
    for (const news of list) {
      if (news.task) tasks.hear(news);
      else log.hear(news);
    }
  },

  pace(pace) {
    page.pace = pace;
    showTransport();
  },

  halt(halt) {
    page.halt = halt;
    showHalt();
  },

  alive() {},

  over() { lose('over'); },
};

// Until they are here, bodies are missing in the picture.
async function loadMeshes(first, own) {
  while (own === source) {
    try {
      const answer = await fetch(`meshes?from=${first}`);
      if (!answer.ok) throw new Error(answer.statusText);
      const meshes = await answer.arrayBuffer();
      if (own !== source) return;
      if (stage) for (const mesh of meshesIn(meshes)) stage.load(mesh);
      page.isDirty = true;
      return;
    } catch {
      await new Promise((done) => setTimeout(done, 500));
    }
  }
}
