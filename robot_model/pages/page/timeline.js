// SPDX-License-Identifier: BSD-3-Clause
// Below the picture: controls, and the path's parts with what proved each of them.
'use strict';

swept.timeline = (function () {
  const data = swept.data, playback = swept.playback;
  const byId = (id) => document.getElementById(id);
  const box = byId('timeline'), hover = byId('hover');
  let cursor = null;
  const kMostChips = 16;
  const kBoundTop = 0.1; // m, the highest bar of the chart

  function make(tag, className, parent) {
    const element = document.createElement(tag);
    element.className = className;
    parent.append(element);
    return element;
  }

  function pieceText(motion, i) {
    const pieces = motion.pieces, tier = pieces.tiers[i];
    const count = pieces.tiers.length;
    const [begin, end] = [i, i + 1].map((k) => data.momentOf(motion, k / count).toFixed(3));
    const range = motion.curve ? begin + ' s to ' + end + ' s' : 't ' + begin + ' to ' + end;
    let text = motion.label + ', ' + range + ': ' + data.tierNames[tier];
    if (tier !== 'collision')
      text += pieces.lower[i] === null ? ', no pair to check'
                                       : ', keeps ' + data.millimetres(pieces.lower[i]) +
                                             ' or more (world ' + keptText(pieces.lower_world[i]) +
                                             ', itself ' + keptText(pieces.lower_self[i]) + ')';
    return text;
  }

  const keptText = (lower) => lower === null ? 'no pair' : data.millimetres(lower);

  function addPiece(motion, i, row) {
    const piece = make('span', 'piece ' + motion.pieces.tiers[i], row);
    piece.dataset.text = pieceText(motion, i);
  }

  function addBound(motion, i, lower, chart) {
    const bar = make('span', 'bound', chart);
    bar.dataset.text = pieceText(motion, i);
    const share = lower === null ? 1 : Math.sqrt(Math.min(1, lower / kBoundTop));
    bar.style.height = Math.max(4, 100 * share) + '%';
    bar.style.background = data.css(data.clearanceColour(lower));
  }

  function addMotion(motion, index) {
    const segment = make('div', 'segment', box);
    segment.style.flex = 1000 * motion.duration + ' 1 0'; // below 1 in all, they would not fill it
    segment.dataset.index = index;
    make('div', 'segment-name', segment).textContent = motion.label;
    // Lines between parts where these are wider than the lines.
    const count = motion.pieces.tiers.length;
    const wide = motion.duration / count > 0.007 * data.duration;
    const row = make('div', wide ? 'pieces apart' : 'pieces', segment);
    for (let i = 0; i < count; ++i) addPiece(motion, i, row);
    // Links that are always near each other would hide the world: a chart for each.
    for (const [kind, lower] of [['world', motion.pieces.lower_world],
                                 ['self', motion.pieces.lower_self]]) {
      const chart = make('div', 'bounds ' + kind, segment);
      for (let i = 0; i < count; ++i) addBound(motion, i, lower[i], chart);
    }
    if (motion.curve) addTimes(motion, segment);
  }

  // Seconds below the charts.
  function addTimes(motion, segment) {
    const row = make('div', 'times', segment), begin = motion.curve.knots[0];
    swept.axis.ticks(begin, begin + motion.duration, Math.min(8, box.clientWidth / 70)).forEach((time, i) => {
      const share = (time.value - begin) / motion.duration;
      const tick = make('span', share < 0.02 ? 'first' : share > 0.98 ? 'last' : '', row);
      tick.textContent = time.text + (i === 0 ? ' s' : '');
      tick.style.left = 100 * share + '%';
    });
  }

  function addState(state, index) {
    const chip = make('button', 'state-chip ' + (state.verdict || 'unjudged'), box);
    chip.textContent = state.label;
    chip.addEventListener('click', () => playback.setTime(index));
  }

  // The time below a pixel; segments share the width by their durations, but for the gaps.
  function timeAt(x) {
    for (const segment of box.querySelectorAll('.segment')) {
      const at = segment.getBoundingClientRect();
      if (x <= at.right || segment === box.lastElementChild.previousElementSibling)
        return data.timeOf(Number(segment.dataset.index),
                           Math.min(1, Math.max(0, (x - at.left) / at.width)));
    }
    return 0;
  }

  function listenToPointer() {
    let dragging = false;
    box.addEventListener('pointerdown', (event) => {
      dragging = true;
      playback.pause();
      playback.setTime(timeAt(event.clientX));
      box.setPointerCapture(event.pointerId);
    });
    box.addEventListener('pointermove', (event) => {
      const under = document.elementFromPoint(event.clientX, event.clientY);
      hover.textContent = under && under.dataset.text ? under.dataset.text : '';
      if (dragging) playback.setTime(timeAt(event.clientX));
    });
    for (const end of ['pointerup', 'pointercancel'])
      box.addEventListener(end, () => { dragging = false; });
    box.addEventListener('pointerleave', () => { hover.textContent = ''; });
  }

  function addTierLegend() {
    const present = new Set([].concat(...data.motions.map((motion) => motion.pieces.tiers)));
    for (const tier of ['lanes', 'exact', 'undecided', 'violation', 'collision']) {
      if (!present.has(tier)) continue;
      const entry = make('span', '', byId('tiers'));
      make('i', tier, entry);
      entry.append(data.tierNames[tier]);
    }
  }

  function addClearanceLegend() {
    const stops = data.clearanceStops, last = stops.length - 1;
    byId('legend-bar').style.background = 'linear-gradient(to right, ' +
        stops.map((stop, i) => data.css(stop[1]) + ' ' + 100 * i / last + '%').join(', ') + ')';
    stops.forEach((stop, i) => {
      const tick = make('span', '', byId('legend-ticks'));
      tick.style.left = 100 * i / last + '%';
      tick.textContent = stop[0] + (i === last ? '+' : '');
    });
    byId('legend').hidden = false;
  }

  function listenToControls() {
    byId('play').addEventListener('click', playback.toggle);
    byId('scrub').addEventListener('input', (event) => {
      playback.pause();
      playback.setTime(event.target.value / 1000 * data.duration);
    });
    byId('speed').addEventListener('change',
                                   (event) => playback.setSpeed(Number(event.target.value)));
  }

  function clockText(at) {
    const motion = data.motions[at.index];
    if (motion.curve) return data.momentOf(motion, at.t).toFixed(3) + ' / ' + data.momentText(motion, 1);
    const moment = (at.index + 1) + ' / ' + data.motions.length + ', t ' + at.t.toFixed(3);
    return motion.clock ? moment + ', at ' + data.clockAt(data.timeOf(at.index, at.t)).toFixed(3) + ' s' : moment;
  }

  function showPath(state) {
    const at = data.locate(state.time);
    const segment = box.querySelectorAll('.segment')[at.index];
    if (!segment) return;
    cursor.style.left = segment.offsetLeft + at.t * segment.offsetWidth + 'px';
    byId('scrub').value = Math.round(1000 * state.time / data.duration);
    byId('clock').textContent = clockText(at);
    if (data.isTimed) byId('scrub').setAttribute('aria-valuetext', data.momentText(data.motions[at.index], at.t));
    byId('play').textContent = state.playing ? '\u275a\u275a' : '\u25b6';
  }

  function showState(state) {
    byId('scrub').value = Math.round(1000 * state.time / Math.max(1, data.duration));
    byId('clock').textContent = (state.time + 1) + ' / ' + data.states.length;
    box.querySelectorAll('.state-chip').forEach(
        (chip, i) => chip.setAttribute('aria-current', i === state.time));
  }

  // The motions of the path that is shown.
  function rebuild() {
    box.textContent = '';
    byId('tiers').textContent = '';
    data.motions.forEach(addMotion);
    cursor = make('div', '', box);
    cursor.id = 'cursor';
    addTierLegend();
  }

  function buildPath() {
    rebuild();
    listenToPointer();
    // Several paths have colours of their own.
    if (data.tipIndex >= 0 && data.paths.length < 2) addClearanceLegend();
  }

  // A button for each state, or where these would be too narrow a scrub bar for all.
  function buildStates() {
    const few = data.states.length <= kMostChips;
    byId('controls').hidden = few;
    byId('play').hidden = byId('speed').hidden = true;
    byId('timeline-foot').hidden = true;
    if (few) data.states.forEach(addState);
  }

  function build() {
    listenToControls();
    if (data.isPath) buildPath();
    else buildStates();
    playback.onChange(data.isPath ? showPath : showState);
  }

  return {build, rebuild};
})();
