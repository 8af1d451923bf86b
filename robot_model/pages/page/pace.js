// SPDX-License-Identifier: BSD-3-Clause
// Shadows, and that a slow machine does without them.
'use strict';

swept.pace = (function () {
  const kSlow = 100; // ms
  const kInARow = 3; // one slow picture may be a pause of the machine
  const byId = (id) => document.getElementById(id);
  let chosen = null; // what the user wants: true, false; null: whatever the machine can do
  let last = null, slow = 0, shadows = true;

  function set(on) {
    shadows = on;
    swept.scene.setShadows(on);
    byId('tool-shadows').setAttribute('aria-pressed', on);
  }
  function choose(on) {
    chosen = on;
    byId('pace-note').hidden = true;
    set(on);
  }

  // At each picture of the browser; `now` in ms. Between two that were drawn is what one takes.
  function frame(now, drawn) {
    const taken = drawn && last !== null ? now - last : 0;
    last = drawn ? now : null;
    if (chosen !== null || !shadows || !drawn) return;
    slow = taken > kSlow ? slow + 1 : 0;
    if (slow < kInARow) return;
    set(false);
    byId('pace-note').hidden = false;
    byId('pace-note').textContent = 'no shadows: a picture takes ' + Math.round(taken) + ' ms';
  }

  return {frame, choose, chosen: () => chosen, toggle: () => choose(!shadows), shadows: () => shadows};
})();
