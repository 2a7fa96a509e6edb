// Comes before the scripts of the live view's page: its session is in the page around it, which
// takes the place of its server.
(() => {
  const { liveView } = window.parent;
  const json = (value) => ({ ok: true, status: 200, json: async () => value });

  class LocalSource {
    static CLOSED = 2;
    readyState = 1;
    listeners = new Map();
    constructor() { liveView.connect((name, data) => this.listeners.get(name)?.({ data: JSON.stringify(data) })); }
    addEventListener(name, hear) { this.listeners.set(name, hear); }
    close() { this.listeners.clear(); }
  }

  window.EventSource = LocalSource;
  // What is looked at is not kept in the address of the page around.
  window.history.replaceState = () => {};
  window.fetch = async (what, options) => {
    const [name, query] = String(what).split('?');
    const asked = new URLSearchParams(query);
    if (name === 'meshes') return { ok: true, status: 200, arrayBuffer: async () => liveView.meshes(Number(asked.get('from'))) };
    if (name === 'past') return json(await liveView.past(Number(asked.get('from')), Number(asked.get('to'))));
    if (name === 'pace') liveView.setPace(options.body);
    return json(null);
  };
})();
