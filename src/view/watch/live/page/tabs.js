// The panels at the side, one of which is shown; there is room for plan and log together where the
// page is high enough.

const TABS = { plan: 'plan', log: 'log', scene: 'scene', joints: 'joints' };

for (const [name, text] of Object.entries(TABS)) {
  const button = pushButton(text, `Show: ${text}`, () => showTab(name));
  button.dataset.tab = name;
  button.setAttribute('role', 'tab');
  $('tabs').append(button);
}

function showTab(name) {
  page.tab = name in TABS ? name : 'plan';
  $('side').dataset.tab = page.tab;
  for (const button of $('tabs').children) button.setAttribute('aria-selected', String(button.dataset.tab === page.tab));
  page.isDirty = true;
}
showTab('plan');
