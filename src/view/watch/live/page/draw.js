// When to draw, and what changes on the page at the same time.

const seconds = (t) => `${t.toFixed(2)} s`;

function showTime() {
  const slider = $('slider');
  const [start, end] = lanes.shown();
  // The clock tells the time of the scene that is shown, also while another one is fetched.
  const shown = page.isKnown ? page.peek ?? page.time ?? page.shown.t : page.shown.t;
  // A plan that has just begun must not make the slider jump.
  slider.min = start;
  slider.max = Math.max(end, start + 0.01);
  slider.value = page.time ?? slider.max;
  slider.setAttribute('aria-valuetext', seconds(Number(slider.value)));
  $('now').textContent = seconds(shown);
  $('end').textContent = page.time === null ? '' : `of ${seconds(past.span[1])}`;
}

let lastTick = 0, lastDraw = 0, slow = 0, isRefined = false;
function tick(now) {
  requestAnimationFrame(tick);
  const passed = Math.min(0.25, (now - lastTick) / 1000);
  lastTick = now;
  if (page.isPlaying && page.time !== null) {
    page.time = Math.min(past.span[1], page.time + passed * page.pastSpeed);
    page.isDirty = true;
    if (page.time >= past.span[1]) {
      page.isPlaying = false;
      film?.stop();
      if (!page.isRecording && page.link === 'live') goLive();
      showTransport();
    }
  }
  if (orbit.advance(now)) page.isDirty = true;
  if (page.sought || page.wanted !== undefined) findSought();
  if (tasks.isDirty) page.isDirty = true;
  if (document.hidden) return;
  // A scene that has come to rest is drawn once more at the best quality.
  const isFine = !page.isDirty && stage?.coarse > 0 && !isRefined && now - lastDraw > 250;
  if (!page.isDirty && !isFine) return;
  isRefined = isFine;
  if (!isFine) lastDraw = now;
  page.isDirty = false;
  const time = page.peek ?? page.time;
  const found = time === null ? scene.live : past.at(time, fetched);
  page.isKnown = !!found;
  if (found) page.shown = found;
  if (stage) {
    const { eye, matrix, fov } = bodyView(page.shown);
    stage.resize(isFine);
    const view = stage.projection(fov, matrix);
    stage.draw(dragged(page.shown), { eye, view, selected: page.selected, isFine, isThroughCamera: page.bound === 'robot' });
    inset.draw(dragged(page.shown));
    capture();
    if (!isFine) adapt(passed);
  }
  counts.drawn += 1;
  showTime();
  showCard(page.shown);
  showLabels();
  sceneTree.render(page.shown);
  jointPanel.render(page.shown, page.peek ?? page.time ?? past.span[1]);
  tasks.render(page.time ?? Infinity);
  lanes.render(page.time ?? Infinity, past.span, page.task);
  if (!lanes.hover) showPath(page.task);
  log.render(page.time ?? Infinity);
}

// A part of the past has come, or cannot be had: without a connection, the page goes to the last
// time that it knows.
function fetched(isHere) {
  page.isDirty = true;
  const isLost = !isHere && page.link !== 'live';
  notice('past', isLost ? 'That part of the past is not on this page.' : '');
  if (!isLost || page.time === null) return;
  page.isPlaying = false;
  page.time = past.lastKnown(page.time);
  showTransport();
}

// On slow graphics hardware the picture gets coarser rather than late.
function adapt(passed) {
  slow = passed > 0.045 ? slow + passed : Math.max(0, slow - passed);
  if (slow < 1.5) return;
  slow = 0;
  stage.coarse = Math.min(3, stage.coarse + 1);
}

new ResizeObserver(() => { page.isDirty = true; }).observe(canvas);
matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => { page.isDirty = true; });
showTransport();
const saved = $('run');
if (saved) {
  openRun(saved.textContent);
  // It is large, and has been read.
  saved.remove();
} else {
  connect();
}
requestAnimationFrame(tick);
