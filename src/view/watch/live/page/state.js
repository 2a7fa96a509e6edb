// The state of the page.

const $ = (id) => document.getElementById(id);
const canvas = $('canvas');
const scene = new Scene();
const orbit = new Orbit();
const past = new Past();
const tasks = new Tasks($('task-list'), $('task-count'));
const log = new Log($('log-lines'));

const notices = new Map();
let stage = null;
try {
  stage = new Stage(canvas, scene);
} catch (error) {
  notice('stage', error.message);
}

const page = {
  // Null while it shows the present, else the time (s) that it shows.
  time: null,
  isPlaying: false,
  isRecording: false,
  // `live` while there is a connection to the session, else why there is none.
  link: 'connecting',
  // Why the session does not go on; null while it does.
  halt: null,
  pace: null,
  pastSpeed: 1,
  // A view that follows the robot.
  bound: null,
  selected: null,
  // The selected task, and the nodes that it used.
  task: null,
  marked: null,
  // The nodes that are not drawn.
  hidden: new Set(),
  // The nodes whose names are in the picture.
  labelled: new Set(),
  // Whether the next picture is to be saved.
  wantsPicture: false,
  // What was clicked, what is measured, and what has been dragged elsewhere.
  clicked: null,
  isMeasuring: false,
  measured: null,
  isDragging: false,
  moved: null,
  // Which panel is at the side.
  tab: 'plan',
  // A time that is shown in passing.
  peek: null,
  views: null,
  shown: EMPTY,
  // Whether `shown` is how the world was at the time that the page shows.
  isKnown: true,
  isDirty: true,
};

// Counts for tests.
const counts = { updates: 0, drawn: 0, errors: 0 };
window.planwright = { counts, page, orbit, scene, past, tasks, log, screenOf };
window.addEventListener('error', () => { counts.errors += 1; });

// Shows a notice about something, or with an empty text none any more.
function notice(about, text) {
  notices.set(about, text);
  const texts = [...notices.values()].filter(Boolean);
  $('notice').textContent = texts.join(' ');
  $('notice').hidden = !texts.length;
}

function linked(state, text) {
  $('link').dataset.state = state;
  $('link-text').textContent = text;
}

// A canvas that shows nothing any more must not look like a kitchen at rest.
canvas.addEventListener('webglcontextlost', (event) => {
  event.preventDefault();
  notice('stage', 'The browser has lost its graphics.');
});
canvas.addEventListener('webglcontextrestored', () => location.reload());
