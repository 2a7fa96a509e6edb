// The state of the page.

const $ = (id) => document.getElementById(id);
const canvas = $('canvas');
const scene = new Scene();
const orbit = new Orbit();
const past = new Past();
const tasks = new Tasks($('task-list'), $('task-count'));
const log = new Log($('log-lines'));

let stage = null;
try {
  stage = new Stage(canvas, scene);
} catch (error) {
  notice(error.message);
}

const page = {
  // Null while it shows the present, else the time (s) that it shows.
  time: null,
  isPlaying: false,
  isRecording: false,
  isOver: false,
  pace: null,
  pastSpeed: 1,
  // A view that follows the robot.
  bound: null,
  selected: null,
  views: null,
  shown: EMPTY,
  isDirty: true,
};

// Counts for tests.
const counts = { updates: 0, drawn: 0, errors: 0 };
window.planwright = { counts, page, orbit, scene, past, screenOf };
window.addEventListener('error', () => { counts.errors += 1; });

function notice(text) {
  $('notice').textContent = text;
  $('notice').hidden = !text;
}

function linked(state, text) {
  $('link').dataset.state = state;
  $('link-text').textContent = text;
}
