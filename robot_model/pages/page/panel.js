// SPDX-License-Identifier: BSD-3-Clause
// Beside the picture: verdict, motions or states, contacts, facts; and the card of a picked body.
'use strict';

swept.panel = (function () {
  const data = swept.data, playback = swept.playback;
  const byId = (id) => document.getElementById(id);
  const picks = []; // called when another body is picked
  let picked = -1;

  function make(tag, className, parent, text) {
    const element = document.createElement(tag);
    element.className = className;
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }
  function addFact(list, name, value) {
    make('dt', '', list, name);
    make('dd', name === 'command' ? 'command' : '', list, value);
  }

  const least = (values) => values.reduce(
      (a, b) => (a === null ? b : b === null ? a : Math.min(a, b)), null);

  function verdictAmount(entry) {
    if (entry.verdict === 'collision')
      return data.isPath ? 'free until ' + data.momentText(entry, entry.free_until) : 'collision';
    if (!entry.verdict) return '';
    const bound = data.isPath ? least(entry.pieces.lower) : entry.clearance;
    return ({undecided: 'undecided, ', violation: 'off a constraint, '}[entry.verdict] || '') +
        (bound === null ? 'no pair to check' : '\u2265 ' + data.millimetres(bound));
  }

  function addList() {
    const entries = data.isPath ? data.motions : data.states;
    byId('list').textContent = '';
    byId('list-title').textContent = data.isTimed ? 'trajectory' : data.isPath ? 'motions' : 'states';
    entries.forEach((entry, index) => {
      const button = make('button', '', make('li', '', byId('list')));
      make('span', 'dot ' + (entry.verdict || 'unjudged'), button);
      make('span', 'name', button, entry.label);
      make('span', 'amount', button, verdictAmount(entry));
      button.addEventListener('click', () => {
        playback.pause();
        playback.setTime(data.timeOf(index, 0));
      });
    });
  }

  function addContacts() {
    const entries = data.isPath ? data.motions : data.states;
    byId('contacts').textContent = '';
    byId('contacts-title').hidden = true;
    entries.forEach((entry, index) => entry.contacts.forEach((contact) => {
      byId('contacts-title').hidden = false;
      const button = make('button', '', make('li', '', byId('contacts')));
      make('span', 'dot collision', button);
      make('span', 'name', button, contact.body_a + ' – ' + contact.body_b);
      make('span', 'amount', button, entry.label + (data.isPath ? ', ' + data.momentText(entry, contact.t) : ''));
      button.addEventListener('click', () => {
        playback.pause();
        playback.setTime(data.timeOf(index, data.isPath ? contact.t : 0));
      });
    }));
  }

  function addValues(values) {
    const box = byId('values');
    box.textContent = '';
    if (values.length === 0) return;
    make('h2', '', box, 'configuration');
    const list = make('dl', '', box);
    data.variables.forEach((variable, i) => {
      if (values[i] !== null) addFact(list, variable.name, values[i].toFixed(4) + ' ' + variable.unit);
    });
  }

  // The rows of a body in a table of clearances, of what is shown.
  function course(body, table) {
    const all = data.clearances, values = [];
    const first = Math.round(data.firstFrame() / all.stride);
    const rows = table.distance.length / all.bodies;
    for (let row = first; row < rows && row * all.stride <= data.lastFrame(); ++row) {
      const at = row * all.bodies + body;
      values.push({distance: table.distance[at], partner: table.partner[at]});
    }
    return values;
  }

  // The world's course, and dashed that of the robot itself.
  function drawCharts(body) {
    const courses = ['world', 'self'].map((kind) => course(body, data.clearances[kind]))
        .map((values) => values.filter((v) => v.partner >= 0));
    const most = Math.max(1e-3, ...courses.flat().map((v) => v.distance));
    byId('picked-chart').textContent = '';
    courses.forEach((values, i) => {
      if (values.length > 1) drawCourse(values, most, i === 0 ? 'none' : '3 2');
    });
  }

  function drawCourse(values, most, dashes) {
    const chart = byId('picked-chart');
    const points = values.map((v, i) => (100 * i / (values.length - 1)).toFixed(2) + ',' +
        (27 - 25 * v.distance / most).toFixed(2));
    const line = document.createElementNS(chart.namespaceURI, 'polyline');
    line.setAttribute('points', points.join(' '));
    line.setAttribute('fill', 'none');
    line.setAttribute('stroke', 'var(--pick)');
    line.setAttribute('vector-effect', 'non-scaling-stroke');
    line.setAttribute('stroke-width', '1.6');
    line.setAttribute('stroke-dasharray', dashes);
    chart.append(line);
  }

  const withPartner = (near) => data.bodies[near.partner].name + ', ' +
      data.millimetres(near.distance);

  function showPickedClearance() {
    const list = byId('picked-facts'), body = data.bodies[picked];
    list.textContent = '';
    const frame = data.locate(playback.state.time).frame;
    const byHand = playback.state.values !== null || swept.scene.isMoved(); // of which no distance is known
    const near = byHand ? null : data.nearest(picked, frame);
    if (byHand && !data.live) addFact(list, 'nearest now', 'moved by hand: not checked');
    else if (!byHand && data.clearances && data.hasRow(frame))
      addFact(list, 'nearest now', near ? withPartner(near) : 'no pair to check');
    if (near && data.isPath) {
      const all = course(picked, data.clearances);
      const tightest = all.reduce((a, b) => (b.distance < a.distance ? b : a));
      addFact(list, 'over the path', withPartner(tightest));
    }
    // Links that are always near each other would hide the world.
    const world = data.nearest(picked, frame, 'world'), self = data.nearest(picked, frame, 'self');
    if (!byHand && world && self) {
      addFact(list, 'world now', withPartner(world));
      addFact(list, 'itself now', withPartner(self));
    }
    if (body.padding > 0) addFact(list, 'padding', data.millimetres(body.padding));
    swept.scene.highlight(picked, near ? near.partner : -1);
  }

  function pick(body) {
    picked = body;
    byId('picked').hidden = body < 0;
    if (body < 0) swept.scene.highlight(-1, -1);
    else fillCard(body);
    picks.forEach((listener) => listener());
  }

  function fillCard(body) {
    const shapes = data.bodies[body].parts.map((part) => part.shape);
    byId('picked-name').textContent = data.bodies[body].name;
    byId('picked-kind').textContent =
        {link: 'link', attached: 'attached body', world: 'body of the world', drawing: 'drawing'}[data.bodies[body].kind] +
        ': ' + shapes.slice(0, 4).join('; ') + (shapes.length > 4 ? '; and ' + (shapes.length - 4) + ' more' : '');
    const charted = data.isPath && data.nearest(body, 0) !== null;
    byId('picked-chart').style.display = charted ? 'block' : 'none';
    if (charted) drawCharts(body);
    showPickedClearance();
  }

  function show(state) {
    const at = data.locate(state.time);
    byId('list').querySelectorAll('button').forEach(
        (button, i) => button.setAttribute('aria-current', i === at.index));
    if (!data.isPath && data.states[at.index]) addValues(data.states[at.index].values);
    if (picked >= 0) showPickedClearance();
  }

  function addFacts() {
    for (const [name, value] of data.facts) addFact(byId('facts'), name, value);
    const covers = swept.overlays.covers;
    if (covers.balls > 0)
      addFact(byId('facts'), 'covers', covers.balls + ' balls shown; the finest have ' + covers.finest);
  }

  function build() {
    const robot = data.facts.find((fact) => fact[0] === 'robot')[1];
    document.title = robot + ', ' + data.title;
    byId('title').textContent = data.title + ' \u00b7 ' + robot;
    byId('verdict').textContent = data.headline;
    byId('panel').dataset.tone = data.tone;
    byId('clouds').hidden = data.clouds === '';
    byId('clouds').textContent = data.clouds === '' ? '' : 'The proof is for: ' + data.clouds.trim();
    for (const shape of data.geometries.filter((s) => s.kind === 'balls' && s.drawn < s.of))
      byId('clouds').append('\nDrawn are only ' + shape.drawn + ' of ' + shape.of + ' balls.');
    // Headlines are short; what is longer is below them.
    byId('reason').hidden = data.reason === '';
    byId('reason-text').textContent = data.reason;
    rebuild();
    addFacts();
    byId('picked-close').addEventListener('click', () => pick(-1));
    byId('picked-only').addEventListener('click', () => swept.bodies.only(picked));
    byId('picked-hide').addEventListener('click', () => {
      swept.bodies.set(picked, false);
      pick(-1);
    });
    playback.onChange(show);
  }

  // What differs from path to path.
  function rebuild() {
    pick(-1);
    addList();
    addContacts();
  }

  return {build, rebuild, pick, picked: () => picked, onPick: (listener) => picks.push(listener)};
})();
