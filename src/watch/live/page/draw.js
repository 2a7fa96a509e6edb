// When to draw, and what changes on the page at the same time.

const seconds = (t) => `${t.toFixed(2)} s`;

function showTime() {
  const slider = $('slider');
  const [start, end] = past.span;
  // A plan that has just begun must not make the slider jump.
  slider.min = start;
  slider.max = Math.max(end, start + 0.01);
  slider.value = page.time ?? end;
  $('now').textContent = seconds(page.time ?? scene.live.t);
  $('end').textContent = page.time === null ? '' : `of ${seconds(end)}`;
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
      if (!page.isRecording && !page.isOver) goLive();
      showTransport();
    }
  }
  if (orbit.advance(now)) page.isDirty = true;
  if (tasks.isDirty) page.isDirty = true;
  if (document.hidden) return;
  // A scene that has come to rest is drawn once more at the best quality.
  const isFine = !page.isDirty && stage?.coarse > 0 && !isRefined && now - lastDraw > 250;
  if (!page.isDirty && !isFine) return;
  isRefined = isFine;
  if (!isFine) lastDraw = now;
  page.isDirty = false;
  if (page.time === null) page.shown = scene.live;
  else page.shown = past.at(page.time, () => { page.isDirty = true; }) ?? page.shown;
  if (stage) {
    const { eye, matrix, fov } = bodyView(page.shown);
    stage.resize(isFine);
    const view = stage.projection(fov, matrix);
    stage.draw(page.shown, { eye, view, selected: page.selected, isFine, isThroughCamera: page.bound === 'robot' });
    if (!isFine) adapt(passed);
  }
  counts.drawn += 1;
  showTime();
  showCard(page.shown);
  tasks.render(page.time ?? Infinity);
  log.render(page.time ?? Infinity);
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
requestAnimationFrame(tick);
