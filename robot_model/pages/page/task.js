// SPDX-License-Identifier: BSD-3-Clause
// The clock of a task. Each of its phases is a page of its own in a frame, which follows this clock: the one that is
// shown, and the next one, which is made ready behind it.
'use strict';

window.task = (function () {
  const data = JSON.parse(document.getElementById('data').textContent), phases = data.phases;
  const byId = (id) => document.getElementById(id);
  const begin = phases[0].begin, duration = phases[phases.length - 1].end - begin;
  const frames = new Map(); // by the index of the phase
  const state = {time: 0, playing: false, speed: 1, phase: 0};
  let last = null, telling = false;

  // What phases share is there once.
  function dataOf(phase) {
    const own = Object.assign({}, phase.data);
    for (const kind of ['geometries', 'covers']) own[kind] = own[kind].map((i) => data.shared[i]);
    return JSON.stringify(own).replace(/[<>&]/g, (c) => '\\u00' + c.charCodeAt(0).toString(16));
  }
  const pageOf = (index) => frames.has(index) ? frames.get(index).contentWindow.swept : undefined;
  const isReady = (index) => { const page = pageOf(index); return Boolean(page && page.ready && page.followed); };

  function prepare(index) {
    if (index >= phases.length || frames.has(index)) return;
    const frame = document.createElement('iframe');
    frame.title = phases[index].label;
    frame.srcdoc = data.page[0] + dataOf(phases[index]) + data.page[1];
    frame.addEventListener('load', () => follow(index));
    frames.set(index, frame);
    byId('phases-shown').append(frame);
  }

  // What is done to the time in a frame is done to this clock.
  function follow(index) {
    const page = pageOf(index);
    if (!page || !page.ready) return;
    page.playback.follow({toggle: toggle, pause: pause});
    page.playback.onChange((own) => {
      if (telling || state.phase !== index) return;
      state.time = phases[index].begin - begin + own.time;
      show();
    });
    page.followed = true;
    setTime(state.time);
  }

  // The same view of the next phase.
  function handOver(from, to) {
    if (!isReady(from) || !isReady(to)) return;
    const theme = frames.get(from).contentDocument.documentElement.dataset.theme;
    frames.get(to).contentDocument.documentElement.dataset.theme = theme;
    pageOf(to).views.restore(pageOf(from).views.saved());
  }

  // The last phase that has begun.
  function phaseAt(time) {
    let index = 0;
    while (index + 1 < phases.length && time >= phases[index + 1].begin - begin) ++index;
    return index;
  }

  function setTime(time) {
    state.time = Math.min(duration, Math.max(0, time));
    const index = phaseAt(state.time), before = state.phase;
    prepare(index);
    if (isReady(index)) {
      const shown = Array.from(frames.keys()).find((own) => frames.get(own).classList.contains('shown'));
      if (shown !== undefined && shown !== index) handOver(shown, index);
      for (const [own, frame] of frames) {
        frame.classList.toggle('shown', own === index);
        if (own !== index && own !== index + 1) {
          frame.remove();
          frames.delete(own);
        }
      }
      telling = true;
      pageOf(index).playback.setTime(state.time - (phases[index].begin - begin));
      telling = false;
      prepare(index + 1);
    }
    state.phase = index;
    if (index !== before) last = null;
    show();
  }

  function show() {
    const phase = phases[state.phase];
    byId('task-clock').textContent = (begin + state.time).toFixed(3) + ' / ' + (begin + duration).toFixed(3) + ' s';
    byId('task-phase').textContent = (state.phase + 1) + ' of ' + phases.length + ': ' + phase.label +
        (phase.changes.length > 0 ? ' (' + phase.changes.join(', ') + ')' : '');
    byId('task-play').textContent = state.playing ? '\u275a\u275a' : '\u25b6';
    const chip = chips[state.phase];
    chips.forEach((own, i) => own.setAttribute('aria-current', i === state.phase));
    const share = (begin + state.time - phase.begin) / (phase.end - phase.begin);
    cursor.style.left = chip.offsetLeft + share * chip.offsetWidth + 'px';
  }

  function pause() {
    state.playing = false;
    show();
  }
  function toggle() {
    state.playing = !state.playing;
    if (state.playing && state.time >= duration) setTime(0);
    last = null;
    show();
  }
  function goTo(index) {
    pause();
    setTime(phases[Math.min(phases.length - 1, Math.max(0, index))].begin - begin);
  }

  // The clock stands while a phase is made ready.
  function tick(now) {
    if (state.playing && isReady(state.phase)) {
      const passed = last === null ? 0 : Math.min(0.25, (now - last) / 1000);
      last = now;
      if (state.time + passed * state.speed >= duration) state.playing = false;
      setTime(state.time + passed * state.speed);
    }
    window.requestAnimationFrame(tick);
  }

  function timeAt(x) {
    const index = Math.max(0, chips.findIndex((chip) => x <= chip.getBoundingClientRect().right));
    const at = chips[index].getBoundingClientRect();
    const share = Math.min(1, Math.max(0, (x - at.left) / at.width));
    return phases[index].begin - begin + share * (phases[index].end - phases[index].begin);
  }

  const chips = phases.map((phase) => {
    const chip = document.createElement('button');
    chip.className = phase.tone;
    chip.style.flexGrow = 1000 * (phase.end - phase.begin);
    chip.title = chip.ariaLabel = phase.label;
    chip.tabIndex = -1;
    byId('task-bar').append(chip);
    return chip;
  });
  const cursor = document.createElement('div');
  cursor.id = 'task-cursor';
  byId('task-bar').append(cursor);
  document.title = data.title;
  byId('task-title').textContent = data.title;
  byId('task-verdict').textContent = data.headline;
  byId('task-verdict').className = data.tone;
  byId('task-play').addEventListener('click', toggle);
  byId('task-back').addEventListener('click', () => goTo(state.phase - 1));
  byId('task-on').addEventListener('click', () => goTo(state.phase + 1));
  byId('task-speed').addEventListener('change', (event) => { state.speed = Number(event.target.value); });
  let dragging = false;
  byId('task-bar').addEventListener('pointerdown', (event) => {
    dragging = true;
    pause();
    setTime(timeAt(event.clientX));
    byId('task-bar').setPointerCapture(event.pointerId);
  });
  byId('task-bar').addEventListener('pointermove', (event) => { if (dragging) setTime(timeAt(event.clientX)); });
  for (const end of ['pointerup', 'pointercancel'])
    byId('task-bar').addEventListener(end, () => { dragging = false; });
  document.addEventListener('keydown', (event) => {
    if (event.key !== ' ' || event.target.tagName === 'SELECT') return;
    event.preventDefault();
    toggle();
  });
  window.addEventListener('resize', show);
  setTime(0);
  window.requestAnimationFrame(tick);
  return {state, setTime, toggle, goTo, isReady: () => isReady(state.phase), page: () => pageOf(state.phase)};
})();
