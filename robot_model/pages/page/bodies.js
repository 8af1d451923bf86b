// SPDX-License-Identifier: BSD-3-Clause
// The list of bodies: which are shown. What is proven is about all of them.
'use strict';

swept.bodies = (function () {
  const data = swept.data;
  const byId = (id) => document.getElementById(id);
  const shown = data.bodies.map(() => true);
  const rows = [];

  function apply() {
    rows.forEach((row, i) => { row.box.checked = shown[i]; });
    shown.forEach((on, i) => swept.scene.setVisible(i, on));
    swept.overlays.hideGhosts(shown);
    const hidden = shown.filter((on) => !on).length;
    byId('bodies-count').textContent = data.bodies.length - hidden + ' of ' + data.bodies.length + ' shown';
    byId('hidden-note').hidden = hidden === 0;
    byId('hidden-note').textContent =
        hidden + (hidden === 1 ? ' body is' : ' bodies are') + ' hidden; what is proven is about all';
  }

  function set(index, on) {
    shown[index] = on;
    apply();
  }
  function only(index) {
    shown.forEach((on, i) => { shown[i] = i === index; });
    apply();
  }
  // Of those that the filter leaves.
  function setListed(on) {
    rows.forEach((row, i) => { if (!row.item.hidden) shown[i] = on; });
    apply();
  }

  function filter(text) {
    const wanted = text.trim().toLowerCase();
    rows.forEach((row, i) => {
      const body = data.bodies[i];
      row.item.hidden = !(body.name + ' ' + body.kind).toLowerCase().includes(wanted);
    });
  }

  function addRow(body, index) {
    const item = document.createElement('li'), label = document.createElement('label');
    const box = document.createElement('input'), name = document.createElement('span');
    const alone = document.createElement('button');
    box.type = 'checkbox';
    box.checked = true;
    box.addEventListener('change', () => set(index, box.checked));
    name.textContent = body.name;
    name.className = 'name';
    const kind = document.createElement('span');
    kind.className = 'amount';
    kind.textContent = body.kind;
    label.append(box, name, kind);
    alone.textContent = 'only';
    alone.setAttribute('aria-label', 'only ' + body.name);
    alone.addEventListener('click', () => only(index));
    item.append(label, alone);
    byId('bodies').append(item);
    rows.push({item: item, box: box});
  }

  function build() {
    data.bodies.forEach(addRow);
    byId('bodies-filter').addEventListener('input', (event) => filter(event.target.value));
    byId('bodies-all').addEventListener('click', () => setListed(true));
    byId('bodies-none').addEventListener('click', () => setListed(false));
    apply();
  }

  return {
    build, set, only, showAll: () => { shown.fill(true); apply(); },
    hidden: () => shown.map((on, i) => (on ? -1 : i)).filter((i) => i >= 0),
    hide: (indices) => {
      shown.forEach((on, i) => { shown[i] = !indices.includes(i); });
      apply();
    }
  };
})();
