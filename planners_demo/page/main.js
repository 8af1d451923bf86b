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
    world: toggler('tool-world', (on) => swept.scene.seeThrough(on)),
    ghosts: toggler('tool-ghosts', (on) => swept.overlays.showEnds(on)),
    reset: () => swept.scene.resetView(),
    theme: () => setTheme(!isDark()),
    help: () => { byId('help').hidden = !byId('help').hidden; }
  };
  const keys = {
    c: actions.covers, x: actions.world, g: actions.ghosts, r: actions.reset, d: actions.theme,
    h: actions.help, '?': actions.help, ' ': playback.toggle,
    Escape: () => {
      if (byId('help').hidden) swept.panel.pick(-1);
      else byId('help').hidden = true;
    }
  };

  function onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = {ArrowLeft: -1, ArrowRight: 1}[event.key];
    const action = keys[event.key];
    if (event.target.tagName === 'SELECT' || (way === undefined && action === undefined)) return;
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
      swept.panel.pick(swept.scene.bodyAt(event.clientX - at.left, event.clientY - at.top));
    });
  }

  function showMoment(state) {
    const at = data.locate(state.time);
    if (!picture) return;
    swept.scene.pose(at.frame);
    const entry = (data.isPath ? data.motions : data.states)[at.index];
    if (entry !== showMoment.entry) swept.overlays.showContacts(entry ? entry.contacts : []);
    showMoment.entry = entry;
  }

  function loop(now) {
    playback.tick(now);
    if (picture && swept.scene.draw()) swept.overlays.placeLabels();
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
      byId('tools').hidden = true;
      swept.scene.canvas.hidden = true;
    }
  }

  function wire() {
    for (const name of Object.keys(actions))
      byId('tool-' + name).addEventListener('click', actions[name]);
    byId('tool-ghosts').hidden = !data.isPath;
    byId('help').addEventListener('click', actions.help);
    document.addEventListener('keydown', onKey);
    window.addEventListener('resize', () => {
      if (picture) swept.scene.fit();
      playback.setTime(playback.state.time);
    });
  }

  const dark = window.matchMedia('(prefers-color-scheme: dark)');
  document.documentElement.dataset.theme = dark.matches ? 'dark' : 'light';
  if (dark.addEventListener) dark.addEventListener('change', (event) => setTheme(event.matches));
  buildPicture();
  swept.timeline.build();
  swept.panel.build();
  playback.onChange(showMoment);
  wire();
  // page.html#t=0.4 begins at 40 % of the path; without, a path begins at its first contact.
  const share = /^#t=([0-9.]+)$/.exec(window.location.hash);
  const met = data.motions.findIndex((motion) => motion.contacts.length > 0);
  playback.setTime(share ? Number(share[1]) * data.duration
                   : met >= 0 ? data.timeOf(met, data.motions[met].contacts[0].t) : 0);
  window.requestAnimationFrame(loop);
  swept.ready = true;
})();
