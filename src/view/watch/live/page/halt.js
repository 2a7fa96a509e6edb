// Why the session does not go on: the condition, and the ways to continue.

const HALTS = {
  stopped: 'Stopped at the prompt',
  interrupted: 'Interrupted',
  aborted: 'Ended by a condition',
};

function showHalt() {
  const { halt } = page;
  const isLinked = page.link === 'live';
  $('halt').hidden = !halt;
  document.body.classList.toggle('halted', !!halt || !isLinked);
  const state = !isLinked ? $('link-text').textContent : halt ? halt.kind : '';
  document.title = state ? `${state} – planwright` : 'planwright';
  if (isLinked && !page.isRecording) linked(halt ? 'halted' : 'live', halt ? halt.kind : 'live');
  if (!halt) return;
  const level = halt.level > 1 ? `, level ${halt.level}` : '';
  // A run that is over has ended at its last moment.
  $('halt-title').textContent = HALTS[halt.kind] + level + (page.isRecording ? `, at ${past.span[1].toFixed(2)} s` : '');
  $('halt-class').textContent = halt.class.toLowerCase();
  $('halt-report').textContent = halt.kind === 'interrupted' ? '' : halt.report;
  $('halt-place').textContent = halt.place;
  $('halt-choices').replaceChildren(...halt.choices.map((choice) => {
    const item = document.createElement('li');
    const [, name, text] = /^(?:\[([^\]]*)\] )?(.*)$/s.exec(choice);
    if (name) {
      const what = document.createElement('b');
      what.textContent = name.toLowerCase();
      item.append(what, ' ');
    }
    item.append(text);
    return item;
  }));
  $('halt-remark').hidden = !halt.choices.length;
}
