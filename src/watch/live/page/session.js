// Messages from the session.

const source = new EventSource('events');
const on = (name, hear) => source.addEventListener(name, (event) => {
  hear(JSON.parse(event.data));
  page.isDirty = true;
});

on('hello', (hello) => {
  scene.clear();
  past.clear();
  tasks.clear();
  log.clear();
  page.isRecording = hello.recording;
  page.views = hello.views;
  if (stage) stage.camera = hello.views.camera;
  page.time = hello.recording ? 0 : null;
  linked('live', hello.recording ? 'recording' : 'live');
  notice('');
  makeViews();
  if (!page.hasView) look(hello.views.fixed[0]?.name ?? 'follow', true);
  page.hasView = true;
});

on('nodes', async (nodes) => {
  scene.addNodes(nodes);
  const answer = await fetch(`meshes?from=${nodes[0].id}`);
  const meshes = await answer.arrayBuffer();
  if (stage) for (const mesh of meshesIn(meshes)) stage.load(mesh);
  page.isDirty = true;
});

on('frame', (frame) => {
  scene.live = follow(scene.live, frame);
  counts.updates += 1;
});

on('span', (span) => {
  past.span = span;
  if (page.isRecording && page.time < span[0]) page.time = span[0];
});

on('news', (list) => {
  for (const news of list) {
    if (news.task) tasks.hear(news);
    else log.hear(news);
  }
});

on('pace', (pace) => {
  page.pace = pace;
  showTransport();
});

on('over', () => {
  page.isOver = true;
  source.close();
  linked('lost', 'session ended');
  showTransport();
});

source.addEventListener('error', () => {
  if (!page.isOver) linked('lost', source.readyState === EventSource.CLOSED ? 'disconnected' : 'reconnecting');
});
