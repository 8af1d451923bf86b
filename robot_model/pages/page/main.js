// SPDX-License-Identifier: BSD-3-Clause
// Puts the page together: buttons, keys, pointer, theme, and the loop that draws.
'use strict';

(function () {
  const data = swept.data, playback = swept.playback;
  const byId = (id) => document.getElementById(id);
  let picture = true; // the browser has WebGL

  function setTheme(dark) {
    document.documentElement.dataset.theme = dark ? 'dark' : 'light';
    if (!picture) return;
    swept.scene.paint();
    swept.overlays.paint();
    swept.panel.pick(swept.panel.picked());
  }
  const isDark = () => document.documentElement.dataset.theme === 'dark';

  // A button that is on or off.
  function toggler(id, apply) {
    return () => {
      const on = byId(id).getAttribute('aria-pressed') !== 'true';
      byId(id).setAttribute('aria-pressed', on);
      apply(on);
    };
  }
  const actions = {
    covers: toggler('tool-covers', (on) => swept.overlays.showCovers(on)),
    looks: () => swept.looks.toggle(),
    world: toggler('tool-world', (on) => swept.scene.seeThrough(on)),
    ghosts: toggler('tool-ghosts', (on) => swept.overlays.showEnds(on)),
    reset: () => swept.views.reset(),
    front: () => swept.views.preset('front'),
    side: () => swept.views.preset('side'),
    top: () => swept.views.preset('top'),
    isometric: () => swept.views.preset('isometric'),
    fit: () => swept.views.fit(),
    worst: () => swept.paths.showWorst(),
    plots: () => swept.plots.toggle(),
    picture: () => swept.views.savePicture(),
    link: () => swept.views.link(),
    shadows: () => swept.pace.toggle(),
    theme: () => setTheme(!isDark()),
    help: () => { byId('help').hidden = !byId('help').hidden; }
  };
  const keys = {
    c: actions.covers, x: actions.world, g: actions.ghosts, r: actions.reset, d: actions.theme,
    h: actions.help, '?': actions.help, ' ': playback.toggle, '1': actions.front,
    '2': actions.side, '3': actions.top, '4': actions.isometric, f: actions.fit,
    w: actions.worst, t: actions.plots, p: actions.picture, l: actions.link, s: actions.shadows,
    v: actions.looks, n: () => swept.paths.next(), a: () => swept.bodies.showAll(),
    '/': () => { byId('bodies-box').open = true; byId('bodies-filter').focus(); },
    Escape: () => {
      if (!byId('help').hidden) byId('help').hidden = true;
      else if (swept.liveBodies && swept.scene.isMoved()) swept.liveBodies.putBack();
      else if (playback.state.values) playback.setTime(playback.state.time);
      else {
        swept.panel.pick(-1);
        swept.plots.pin(-1);
      }
    }
  };

  // Keys that a control with the focus takes itself.
  function isTaken(event) {
    const target = event.target;
    if (event.key === 'Escape') {
      if (target.tagName === 'INPUT') target.blur();
      return false;
    }
    if (target.tagName === 'SELECT' || target.type === 'text' || target.type === 'number') return true;
    const moves = /^Arrow/.test(event.key), presses = event.key === ' ';
    if (target.type === 'range') return moves && target.id !== 'scrub';
    return presses && (target.type === 'checkbox' || target.tagName === 'SUMMARY');
  }

  const keysWithoutPicture = ['d', 'h', '?', ' ', 'w', 'l', 'n', 't', 'Escape'];

  function onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    const action = picture || keysWithoutPicture.includes(event.key) ? keys[event.key] : undefined;
    if (isTaken(event) || (way === undefined && action === undefined)) return;
    // A button that has the focus would take the blank for a click.
    event.preventDefault();
    if (way === undefined) action();
    else if (event.shiftKey) playback.skip(way);
    else playback.step(way);
  }

  // A press that hardly moves picks; one that moves turns the view.
  function listenForPicks() {
    const canvas = swept.scene.canvas;
    let down = null;
    canvas.addEventListener('pointerdown', (event) => {
      down = event.isPrimary && event.button === 0 ? {x: event.clientX, y: event.clientY} : null;
    });
    canvas.addEventListener('pointerup', (event) => {
      if (down === null || Math.hypot(event.clientX - down.x, event.clientY - down.y) > 5) return;
      const at = canvas.getBoundingClientRect();
      const hit = swept.scene.hitAt(event.clientX - at.left, event.clientY - at.top);
      swept.panel.pick(hit.body);
      if (hit.body < 0 && hit.link) swept.notice(hit.link + ' has no collision geometry: it is not checked');
    });
  }

  // At the contact of a trajectory, if that is off the curve.
  function touchesBeside(entry, t) {
    const contact = entry && entry.curve ? entry.curve.contact : null;
    return contact !== null && contact.beside && Math.abs(t - entry.contacts[0].t) < 0.01;
  }

  function showMoment(state) {
    const at = data.locate(state.time);
    if (!picture) return;
    if (state.values || data.isTimed)
      swept.scene.poseLinks(swept.kinematics.poses(state.values || swept.kinematics.valuesAt(state.time)));
    else swept.scene.pose(at.frame);
    if (data.moving.length > 0) swept.scene.poseMoving(data.clockAt(state.time));
    // Contacts are of what was checked.
    const known = state.values === null && !swept.scene.isMoved();
    const entry = !known ? null : (data.isPath ? data.motions : data.states)[at.index];
    if (entry !== showMoment.entry) swept.overlays.showContacts(entry ? entry.contacts : []);
    showMoment.entry = entry;
    swept.overlays.showBeside(touchesBeside(entry, at.t) ? entry : null);
  }

  function loop(now) {
    playback.tick(now);
    const drawn = picture && swept.scene.draw();
    if (drawn) swept.overlays.placeLabels();
    swept.pace.frame(now, drawn);
    window.requestAnimationFrame(loop);
  }

  function buildPicture() {
    try {
      const size = swept.scene.build();
      swept.overlays.build(size);
      listenForPicks();
    } catch (error) {
      if (swept.scene.canvas.dataset.fitted !== undefined) throw error;
      picture = false;
      byId('no-webgl').hidden = false;
      for (const id of ['tools', 'views', 'picked-tools', 'bodies-box']) byId(id).hidden = true;
      swept.scene.canvas.hidden = true;
    }
  }

  function wire() {
    for (const name of Object.keys(actions))
      byId('tool-' + name).addEventListener('click', actions[name]);
    byId('tool-ghosts').hidden = !data.isPath;
    byId('tool-looks').hidden = data.visuals.length === 0;
    // Nothing is nearer to anything where nothing is judged.
    byId('tool-worst').hidden = data.clearances === null;
    byId('help').addEventListener('click', actions.help);
    document.addEventListener('keydown', onKey);
    // Not the window's size alone: what is below the picture grows and shrinks, too.
    new ResizeObserver(() => {
      if (picture) swept.scene.fit();
      playback.tell();
    }).observe(byId('stage'));
    window.addEventListener('hashchange', () => swept.views.open(window.location.hash, picture));
  }

  // A line in the corner, for a while.
  swept.notice = function (text) {
    byId('notice').textContent = text;
    byId('notice').hidden = false;
    clearTimeout(swept.notice.timer);
    swept.notice.timer = setTimeout(() => { byId('notice').hidden = true; }, 6000);
  };

  // What is wrong, when something is, unless the address asks for another moment or view.
  function openFirst() {
    // A motion opens at its first contact.
    const met = data.paths.length > 1 ? -1 : data.motions.findIndex((motion) => motion.contacts.length > 0);
    const first = met < 0 ? 0 : data.timeOf(met, data.motions[met].contacts[0].t);
    playback.setTime(data.opens_at === null ? first : data.opens_at);
    const asked = swept.views.open(window.location.hash, picture);
    if (asked || data.opens_at === null || !picture) return;
    const contacts = data.states[data.opens_at].contacts;
    if (contacts.length > 0) swept.views.focus(contacts);
  }

  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  document.documentElement.dataset.theme = dark.matches ? 'dark' : 'light';
  if (dark.addEventListener) dark.addEventListener('change', (event) => setTheme(event.matches));
  buildPicture();
  swept.timeline.build();
  swept.panel.build();
  swept.trajectory.build();
  swept.constraints.build();
  playback.onChange(showMoment);
  wire();
  swept.paths.build();
  swept.joints.build();
  if (picture) swept.bodies.build();
  if (picture) {
    swept.scene.fit(); // all that is around it is there now
    swept.views.reset();
  }
  openFirst();
  window.requestAnimationFrame(loop);
  swept.ready = true;
})();
