// SPDX-License-Identifier: BSD-3-Clause
// Several paths of one page: which is shown; and the worst moment of what is shown.
'use strict';

swept.paths = (function () {
  const data = swept.data, playback = swept.playback;
  const byId = (id) => document.getElementById(id);
  const several = data.paths.length > 1;
  const buttons = [];

  function show(path) {
    if (!several) return;
    playback.pause();
    data.usePath(path);
    swept.timeline.rebuild();
    swept.panel.rebuild();
    swept.trajectory.rebuild();
    swept.constraints.rebuild();
    if (swept.overlays.usePath) swept.overlays.usePath();
    buttons.forEach((button, i) => button.setAttribute('aria-current', i === path));
    playback.setTime(0);
  }

  const least = (motions) => motions.reduce((low, motion) => motion.pieces.lower.reduce(
      (a, b) => (b === null ? a : a === null ? b : Math.min(a, b)), low), null);

  function addPath(path, index) {
    const item = document.createElement('li'), button = document.createElement('button');
    const dot = document.createElement('span'), name = document.createElement('span');
    const amount = document.createElement('span');
    dot.className = 'dot';
    dot.style.background = data.pathColour(index);
    name.className = 'name';
    name.textContent = path.label;
    amount.className = 'amount';
    const own = data.allMotions.filter((motion) => motion.path === index);
    const touches = own.some((motion) => motion.verdict === 'collision');
    amount.textContent = path.tone === 'bad' ? (touches ? 'collision' : 'off a constraint') : path.tone === 'unsure' ? 'undecided'
        : '\u2265 ' + data.millimetres(least(own));
    if (own.some((motion) => motion.curve && motion.curve.violations.length > 0))
      amount.textContent += ', beyond limits';
    button.append(dot, name, amount);
    button.addEventListener('click', () => show(index));
    item.append(button);
    byId('paths').append(item);
    buttons.push(button);
  }

  // {time, text}: a contact, if there is one, else where the certified clearance is least.
  function worstOfPath() {
    for (let m = 0; m < data.motions.length; ++m) {
      const contact = data.motions[m].contacts[0];
      if (contact) return {time: data.timeOf(m, contact.t), text: contact.body_a + ' – ' + contact.body_b};
    }
    let worst = null;
    data.motions.forEach((motion, m) => motion.pieces.lower.forEach((lower, i) => {
      const count = motion.pieces.lower.length;
      if (motion.pieces.tiers[i] === 'collision') lower = 0;
      if (lower === null || (worst !== null && lower >= worst.lower)) return;
      worst = {lower: lower, time: data.timeOf(m, tightest(motion, i, count)),
               text: motion.label + ' keeps ' + data.millimetres(lower) + ' or more'};
    }));
    return worst;
  }
  // t of the frame of a part at which some pair is nearest; without a table of them, the middle.
  function tightest(motion, piece, count) {
    const per = motion.steps / count;
    let best = {t: (piece + 0.5) / count, distance: Infinity};
    if (!data.clearances || data.clearances.stride > 1) return best.t;
    for (let k = 0; k <= per; ++k) {
      const frame = motion.first_frame + piece * per + k;
      const near = data.leastAt(frame);
      if (near.distance < best.distance) best = {t: (piece * per + k) / motion.steps, distance: near.distance};
    }
    return best.t;
  }

  function worstState() {
    let worst = null;
    data.states.forEach((state, i) => {
      const value = state.verdict === 'collision' ? -1 : state.verdict === 'undecided' ? 0 : state.clearance;
      if (value === null || value === undefined || (worst !== null && value >= worst.value)) return;
      worst = {value: value, time: i, text: state.label};
    });
    return worst;
  }

  function showWorst() {
    const worst = data.isPath ? worstOfPath() : worstState();
    if (worst === null) return swept.notice('there is no pair to check');
    playback.pause();
    playback.setTime(worst.time);
    const near = data.clearances && data.leastAt(Math.round(data.locate(worst.time).frame));
    if (near && near.body >= 0) swept.panel.pick(near.body);
    return swept.notice('worst moment: ' + worst.text);
  }

  function build() {
    byId('paths-title').hidden = !several;
    if (data.isTimed) byId('paths-title').textContent = 'trajectories';
    if (!several) return;
    data.paths.forEach(addPath);
    buttons[0].setAttribute('aria-current', true);
  }

  return {build, show, showWorst, next: () => show((data.path + 1) % Math.max(1, data.paths.length))};
})();
