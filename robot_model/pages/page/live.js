// SPDX-License-Identifier: BSD-3-Clause
// Proves where robot or bodies were moved to by hand: a WebAssembly module answers as `swept check` does,
// about the files that the page has inside. Only in pages that have the module.
'use strict';

swept.live = (function () {
  const data = swept.data, given = data.live, tree = data.tree, playback = swept.playback;
  const byId = (id) => document.getElementById(id);
  const state = {module: null, problem: '', answer: null, took: 0};

  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  async function unpacked(text) {
    const stream = new Blob([bytes(text)]).stream().pipeThrough(new DecompressionStream('gzip'));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  function writeFiles(fs) {
    for (const name of Object.keys(given.files)) {
      const path = '/given/' + name;
      fs.mkdirTree(path.slice(0, path.lastIndexOf('/')));
      fs.writeFile(path, bytes(given.files[name]));
    }
    fs.writeFile('/given/inputs.json', JSON.stringify(given.inputs));
  }

  async function open() {
    const script = document.createElement('script');
    script.textContent = new TextDecoder().decode(await unpacked(given.script));
    document.head.append(script);
    const module = await makeSweptLive({wasmBinary: await unpacked(given.code)});
    writeFiles(module.FS);
    const opened = JSON.parse(
        module.ccall('swept_live_open', 'string', ['string'], ['/given/inputs.json']));
    if (opened.error) throw new Error(opened.error);
    state.module = module;
    state.room = module._malloc(8 * Math.max(7, tree.group.length));
  }

  // What `swept check --json` says of a configuration of the group.
  function ask(values) {
    const module = state.module;
    module.HEAPF64.set(values, state.room / 8);
    return JSON.parse(module.ccall('swept_live_report', 'string', ['number', 'number'],
                                   [state.room, values.length]));
  }

  // Moves a body of the world by seven numbers from where its file has it; where its parts are then.
  function moveBody(name, numbers) {
    const module = state.module;
    module.HEAPF64.set(numbers, state.room / 8);
    const answer = JSON.parse(module.ccall('swept_live_move', 'string', ['string', 'number'], [name, state.room]));
    if (answer.error) throw new Error(answer.error);
    return answer.parts;
  }

  // A variable that the group does not have, and that is not where the checker has it.
  function elsewhere(values) {
    return tree.variables.find((variable, i) =>
        !tree.group.includes(i) && Math.abs(values[i] - tree.reference[i]) > 1e-12);
  }

  const pairText = (contact) => contact.body_a + ' \u2013 ' + contact.body_b;
  function verdictText(answer) {
    if (answer.error) return 'not checked: ' + answer.error;
    if (answer.verdict === 'free') {
      if (answer.clearance === null) return 'free, no pair to check';
      return 'free, \u2265 ' + data.millimetres(answer.clearance) + ', nearest ' +
          answer.nearest.join(' \u2013 ');
    }
    if (answer.verdict === 'violation') return 'off a constraint';
    if (answer.verdict !== 'collision') return answer.verdict;
    const others = answer.contacts.length - 1;
    return 'collision: ' + pairText(answer.contacts[0]) + (others > 0 ? ' and ' + others + ' more' : '');
  }
  const tones = {free: 'good', collision: 'bad', violation: 'bad', undecided: 'unsure'};

  function say(text, tone) {
    byId('now').textContent = 'moved by hand: ' + text;
    byId('now').dataset.tone = tone;
  }

  function mark(answer) {
    if (swept.scene.canvas.hidden) return;
    const contacts = answer.contacts || [];
    swept.overlays.showContacts(contacts);
    const body = (name) => data.bodies.findIndex((b) => b.name === name);
    if (contacts.length > 0) swept.scene.highlight(body(contacts[0].body_a), body(contacts[0].body_b));
    else swept.panel.pick(swept.panel.picked());
  }

  // After those of the page itself: what these say is that nothing is known.
  function show(now) {
    if (now.values === null && !swept.scene.isMoved()) {
      if (state.answer !== null) swept.panel.pick(swept.panel.picked());
      state.answer = null;
      return;
    }
    if (state.problem) return say('not checked: ' + state.problem, 'plain');
    if (state.module === null) return say('the checker is being loaded', 'plain');
    const values = now.values || swept.kinematics.valuesAt(now.time), other = elsewhere(values);
    if (other) return say('not checked: ' + other.name + ' is not of the group', 'plain');
    const begin = performance.now();
    state.answer = ask(tree.group.map((i) => values[i]));
    say(verdictText(state.answer), tones[state.answer.verdict] || 'plain');
    state.took = performance.now() - begin;
    return mark(state.answer);
  }

  playback.onChange(show);
  open().catch((error) => { state.problem = error.message; }).then(() => {
    byId('panel').dataset.live = state.problem ? 'failed' : 'ready';
    if (playback.state.values) playback.tell();
  });

  return {state, ask, moveBody};
})();
