// SPDX-License-Identifier: BSD-3-Clause
// The page's clock: where it is, and that it runs; or the values that the robot was given by hand.
'use strict';

swept.playback = (function () {
  const data = swept.data;
  const listeners = [];
  const state = {time: 0, playing: false, speed: 1, values: null};
  let last = null;
  let host = null; // the clock of the task that this is a phase of

  const tell = () => listeners.forEach((listener) => listener(state));

  function setTime(time) {
    state.time = Math.min(data.duration, Math.max(0, time));
    if (!data.isPath) state.time = Math.round(state.time);
    state.values = null;
    tell();
  }

  // A value for each variable of the robot; the clock stands.
  function setValues(values) {
    state.playing = false;
    state.values = values;
    tell();
  }

  // From the start when it is at the end.
  function play() {
    if (!data.isPath) return;
    if (state.time >= data.duration) state.time = 0;
    state.playing = true;
    state.values = null;
    last = null;
    tell();
  }
  function pause() {
    state.playing = false;
    if (host) host.pause();
    tell();
  }
  function toggle() {
    if (host) host.toggle();
    else if (state.playing) pause();
    else play();
  }

  // Called for every picture of the browser; `now` in ms.
  function tick(now) {
    if (!state.playing) return;
    const passed = last === null ? 0 : Math.min(0.25, (now - last) / 1000);
    last = now;
    if (state.time + passed * state.speed >= data.duration) state.playing = false;
    setTime(state.time + passed * state.speed);
  }

  // A frame back or on: to the next place where a frame is.
  function step(way) {
    pause();
    if (!data.isPath) return setTime(state.time + way);
    const at = data.locate(state.time), motion = data.motions[at.index];
    const place = at.t * motion.steps;
    const next = way > 0 ? Math.floor(place + 1e-6) + 1 : Math.ceil(place - 1e-6) - 1;
    if (next >= 0) return setTime(data.timeOf(at.index, next / motion.steps));
    if (at.index === 0) return setTime(0);
    const before = data.motions[at.index - 1];
    return setTime(data.timeOf(at.index - 1, (before.steps - 1) / before.steps));
  }

  // Where motions begin, or the pieces of a curve.
  function startsOf(motion) {
    const knots = motion.curve ? Array.from(motion.curve.knots.slice(0, -1)) : [0];
    return knots.map((knot) => motion.start + knot - knots[0]);
  }
  // To the next start, or the last one.
  function skip(way) {
    pause();
    if (!data.isPath) return setTime(state.time + way);
    const starts = [].concat(...data.motions.map(startsOf), [data.duration]);
    const found = way > 0 ? starts.find((start) => start > state.time + 1e-6)
                          : starts.reverse().find((start) => start < state.time - 1e-6);
    return setTime(found === undefined ? state.time : found);
  }

  return {
    state, setTime, setValues, tell, play, pause, tick, step, skip, toggle,
    // Another clock says when it is, and has the buttons for it.
    follow: (clock) => {
      host = clock;
      document.documentElement.classList.add('phase');
    },
    setSpeed: (speed) => { state.speed = speed; },
    onChange: (listener) => listeners.push(listener)
  };
})();
