// Time: pause, speed, and the slider over the past.

const SPEEDS = [['¼', 0.25], ['½', 0.5], ['1×', 1], ['2×', 2], ['4×', 4], ['max', null]];
for (const [text, speed] of SPEEDS) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = text;
  button.title = speed ? `${speed} simulated seconds per real second` : 'As fast as possible';
  button.addEventListener('click', () => {
    if (page.time === null) ask(`speed ${speed ?? 'max'}`);
    else page.pastSpeed = speed ?? 16;
    showTransport();
  });
  $('speeds').append(button);
}

// Asks the session to change its pace, the only thing it can be asked for.
async function ask(what) {
  // What it has changed comes as a message; without a connection, nothing can be asked for.
  const answer = await fetch('pace', { method: 'POST', body: what }).catch(() => null);
  notice('pace', answer?.ok || page.link !== 'live' ? '' : 'The session has not heard that; try again.');
}

function play() {
  if (page.time === null) {
    if (page.pace && page.link === 'live') ask(page.pace.paused ? 'go' : 'pause');
  } else {
    page.isPlaying = !page.isPlaying;
    if (page.isPlaying && page.time >= past.span[1] - 1e-3) page.time = past.span[0];
  }
  showTransport();
}

function goTo(time) {
  page.time = Math.max(past.span[0], Math.min(past.span[1], time));
  page.isDirty = true;
  showTransport();
}

function goLive() {
  page.isPlaying = false;
  page.time = page.isRecording ? past.span[1] : null;
  page.isDirty = true;
  showTransport();
}

function showTransport() {
  const isNow = page.time === null;
  const isLinked = page.link === 'live';
  const isFixed = isNow && (!page.pace || !isLinked);
  const isGoing = isNow ? !page.pace?.paused && isLinked : page.isPlaying;
  $('play').classList.toggle('go', !isGoing);
  $('play').title = `${isGoing ? 'Pause' : 'Resume'} (space)`;
  $('play').disabled = isFixed;
  $('live').setAttribute('aria-pressed', String(isNow && isLinked));
  $('live').disabled = isNow && !isLinked;
  $('live').textContent = isLinked ? 'live' : 'last';
  $('live').title = isLinked ? 'Back to the present (End)' : 'The last that was seen (End)';
  $('live').hidden = page.isRecording;
  const speed = isNow ? page.pace?.speed ?? null : (page.pastSpeed === 16 ? null : page.pastSpeed);
  [...$('speeds').children].forEach((button, i) => {
    button.setAttribute('aria-pressed', String(SPEEDS[i][1] === speed && (!isNow || !!page.pace)));
    button.disabled = isFixed;
  });
}

$('play').addEventListener('click', play);
$('live').addEventListener('click', goLive);
$('slider').addEventListener('input', () => {
  page.isPlaying = false;
  goTo(Number($('slider').value));
});

window.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.id === 'slider' || event.target.tagName === 'INPUT') return;
  const step = event.shiftKey ? 1 : 0.1;
  const now = page.time ?? past.span[1];
  const keys = {
    ' ': play, End: goLive, Home: () => goTo(past.span[0]), Escape: unselect,
    f: () => stepFailure(1), F: () => stepFailure(-1), l: () => stepLine(1), L: () => stepLine(-1),
    ArrowLeft: () => goTo(now - step), ArrowRight: () => goTo(now + step),
    ',': () => goTo(now - 1 / 30), '.': () => goTo(now + 1 / 30),
  };
  if (!keys[event.key] || (event.key === ' ' && event.target.tagName === 'BUTTON')) return;
  event.preventDefault();
  keys[event.key]();
});
