// SPDX-License-Identifier: BSD-3-Clause
// Moves the picked body of the world, by its card or by dragging it. Only in pages that prove.
'use strict';

swept.liveBodies = (function () {
  const data = swept.data, scene = swept.scene, live = swept.live, playback = swept.playback;
  const canvas = scene.canvas, byId = (id) => document.getElementById(id);
  const kWays = [['x', 'm'], ['y', 'm'], ['z', 'm'], ['turn', '°']]; // in the model frame; about z
  const moves = new Map(); // index of a body -> {by: [x, y, z in m, turn in degrees], parts: where they are}
  const rows = [];
  let box = null, place = null;

  const byOf = (body) => (moves.has(body) ? moves.get(body).by : [0, 0, 0, 0]);

  // Bodies turn about the middle of what they consist of.
  function middleOf(body) {
    const middle = new THREE.Vector3(), parts = data.bodies[body].parts;
    for (const part of parts) middle.add(new THREE.Vector3().fromArray(data.floats(part.pose)));
    return middle.divideScalar(parts.length);
  }
  function motionOf(body, [x, y, z, degrees]) {
    const middle = middleOf(body), turn = new THREE.Quaternion().setFromAxisAngle(
        new THREE.Vector3(0, 0, 1), degrees * Math.PI / 180);
    const position = new THREE.Vector3(x, y, z).add(middle).sub(middle.clone().applyQuaternion(turn));
    return {position: position, quaternion: turn};
  }

  function move(body, by) {
    if (live.state.module === null) return swept.notice('the checker is not there yet');
    const home = by.every((value) => value === 0), motion = motionOf(body, by);
    const numbers = [...motion.position.toArray(), ...motion.quaternion.toArray()];
    try {
      const parts = live.moveBody(data.bodies[body].name, numbers);
      if (home) moves.delete(body);
      else moves.set(body, {by: by, parts: parts});
    } catch (error) {
      return swept.notice(error.message);
    }
    scene.moveBody(body, home ? null : motion);
    return tell();
  }

  function putBack(bodies = [...moves.keys()]) {
    bodies.forEach((body) => move(body, [0, 0, 0, 0]));
  }

  function tell() {
    byId('moved-note').hidden = moves.size === 0;
    byId('moved-note').textContent = moves.size +
        (moves.size === 1 ? ' body is' : ' bodies are') + ' moved; what is recorded is about where the files have them';
    playback.tell();
    show();
  }

  // The card of the picked body.
  function show() {
    const body = swept.panel.picked();
    box.hidden = body < 0 || data.bodies[body].kind !== 'world';
    if (box.hidden) return;
    byOf(body).forEach((value, i) => {
      rows[i].range.value = value;
      rows[i].number.value = Number(value.toFixed(4));
    });
    byId('picked-back').disabled = !moves.has(body);
    place.textContent = moves.has(body) && moves.get(body).parts.length === 1
        ? 'now at ' + moves.get(body).parts[0].position.map((value) => value.toFixed(4)).join(', ') : '';
  }

  function make(tag, className, parent, text) {
    const element = document.createElement(tag);
    element.className = className;
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }

  function change(way, text) {
    const value = text === '' ? NaN : Number(text), body = swept.panel.picked();
    if (!Number.isFinite(value)) return show();
    const by = byOf(body).slice();
    by[way] = value;
    return move(body, by);
  }

  function addRow([name, unit], way) {
    const row = make('div', 'slider', box);
    make('span', 'name', row, name);
    const most = unit === '°' ? 180 : Math.max(0.5, Math.ceil(scene.size()) / 2);
    const [range, number] = ['range', 'number'].map((type) => {
      const input = make('input', '', row);
      Object.assign(input, {type: type, step: type === 'number' ? 'any' : unit === '°' ? 1 : 0.001});
      if (type === 'range') Object.assign(input, {min: -most, max: most});
      input.setAttribute('aria-label', 'move, ' + name + ', ' + unit);
      return input;
    });
    make('span', 'amount', row, unit);
    range.addEventListener('input', () => change(way, range.value));
    number.addEventListener('change', () => change(way, number.value));
    rows.push({range: range, number: number});
  }

  function addCard() {
    box = make('div', '', byId('picked'));
    box.id = 'picked-move';
    kWays.forEach(addRow);
    place = make('p', 'follower', box);
    const back = make('button', '', make('p', 'row', box), 'put back');
    back.id = 'picked-back';
    back.addEventListener('click', () => putBack([swept.panel.picked()]));
    const note = make('p', '', byId('notes'));
    note.id = 'moved-note';
    note.setAttribute('role', 'status');
    note.hidden = true;
    make('p', '', document.querySelector('#help > div'),
         'Drag a picked body of the world to move it: level, or with shift up and down.');
  }

  // Where the ray through a pixel meets a plane; null: nowhere.
  function onPlane(event, normal, point) {
    const at = canvas.getBoundingClientRect(), caster = new THREE.Raycaster();
    caster.setFromCamera(new THREE.Vector2(2 * (event.clientX - at.left) / at.width - 1,
                                           1 - 2 * (event.clientY - at.top) / at.height), scene.camera);
    return caster.ray.intersectPlane(
        new THREE.Plane().setFromNormalAndCoplanarPoint(normal, point), new THREE.Vector3());
  }

  // A press on the picked body of the world drags it: level, or with shift up and down. Null: another press.
  function dragFrom(event) {
    const body = swept.panel.picked();
    if (!event.isPrimary || event.button !== 0 || body < 0 || data.bodies[body].kind !== 'world') return null;
    const at = canvas.getBoundingClientRect();
    const hit = scene.hitAt(event.clientX - at.left, event.clientY - at.top);
    if (hit.body !== body) return null;
    const normal = new THREE.Vector3(0, 0, 1);
    if (event.shiftKey && scene.camera.getWorldDirection(normal).setZ(0).length() < 0.1) {
      swept.notice('look from the side to move a body up or down');
      return null;
    }
    return {body: body, from: hit.point, by: byOf(body), rises: event.shiftKey, normal: normal.normalize(),
            x: event.clientX, y: event.clientY, begun: false};
  }
  function dragTo(event, drag) {
    // As for picking: what hardly moves is a click.
    drag.begun = drag.begun || Math.hypot(event.clientX - drag.x, event.clientY - drag.y) > 5;
    const to = drag.begun ? onPlane(event, drag.normal, drag.from) : null;
    if (to === null) return;
    to.sub(drag.from);
    const [x, y, z, turn] = drag.by;
    move(drag.body, drag.rises ? [x, y, z + to.z, turn] : [x + to.x, y + to.y, z, turn]);
  }
  function listenForDrags() {
    let drag = null;
    canvas.addEventListener('pointerdown', (event) => {
      drag = dragFrom(event);
      if (drag === null) return;
      canvas.setPointerCapture(event.pointerId);
      scene.controls().enabled = false; // elsewhere a drag turns the view
    });
    canvas.addEventListener('pointermove', (event) => { if (drag !== null) dragTo(event, drag); });
    for (const end of ['pointerup', 'pointercancel'])
      canvas.addEventListener(end, () => {
        drag = null;
        scene.controls().enabled = true;
      });
  }

  addCard();
  if (!canvas.hidden) listenForDrags();
  swept.panel.onPick(show);
  show();
  return {move, putBack, moves};
})();
