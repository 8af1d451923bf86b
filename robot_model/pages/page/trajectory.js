// SPDX-License-Identifier: BSD-3-Clause
// Beside the picture: what is known about a trajectory, and where it leaves its limits.
'use strict';

swept.trajectory = (function () {
  const data = swept.data, playback = swept.playback;
  const byId = (id) => document.getElementById(id);
  const suffixes = {position: '', velocity: '/s', acceleration: '/s\u00b2', jerk: '/s\u00b3'};

  function make(tag, className, parent, text) {
    const element = document.createElement(tag);
    element.className = className;
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }
  function addFact(name, value) {
    make('dt', '', byId('curve-facts'), name);
    make('dd', '', byId('curve-facts'), value);
  }

  const unitOf = (violation) =>
      data.variables.find((variable) => variable.name === violation.variable).unit + suffixes[violation.kind];

  function addViolation(curve, violation) {
    const button = make('button', '', make('li', '', byId('violations'))), unit = unitOf(violation);
    make('span', 'dot collision', button);
    make('span', 'name', button, violation.variable + ', ' + violation.kind);
    make('span', 'amount', button, violation.value.toPrecision(5) + ' ' + unit + ', limit ' +
        violation.limit.toPrecision(5) + ' ' + unit + ', ' + violation.time.toFixed(3) + ' s');
    button.addEventListener('click', () => {
      playback.pause();
      playback.setTime(violation.time - curve.knots[0]);
    });
  }

  function clearanceText(clearance) {
    if (clearance.lower === null) return 'no pair to check';
    const pair = clearance.body_a === '' ? '' : ', ' + clearance.body_a + ' – ' + clearance.body_b + ' at ' +
        clearance.time.toFixed(3) + ' s';
    return (clearance.upper === 0 ? 'in contact' : '\u2265 ' + data.millimetres(clearance.lower)) + pair;
  }

  // `0.01 rad`, or by variable where they differ.
  function tubeText(curve) {
    const entries = data.variables.map((variable, i) => ({name: variable.name, unit: variable.unit, size: curve.tube[i]}))
        .filter((entry) => entry.size !== null);
    const sizes = new Set(entries.map((entry) => entry.size + ' ' + entry.unit));
    if (sizes.size === 1) return '\u00b1' + sizes.values().next().value + ' each';
    return entries.map((entry) => entry.name + ' \u00b1' + entry.size + ' ' + entry.unit).join(', ');
  }

  function limitsText(curve) {
    const kinds = ['velocity', 'acceleration', 'jerk'].filter(
        (kind) => curve.limits[kind] !== null && curve.limits[kind].some((limit) => limit !== null));
    const left = curve.violations.length;
    return ['position'].concat(kinds).join(', ') + (left === 0 ? ': kept' : ': ' + left + ' not kept');
  }

  function addFacts(curve) {
    const knots = curve.knots, begin = knots[0], end = knots[knots.length - 1];
    const degrees = Array.from(new Set(curve.degrees)).sort((a, b) => a - b);
    addFact('duration', (end - begin).toFixed(3) + ' s' + (begin === 0 ? '' : ', from ' + begin.toFixed(3) + ' s'));
    if (data.moving.length > 0)
      addFact('moving', data.moving.map((body) => body.name).join(', ') + '; the clock shows ' +
          (curve.clock + begin).toFixed(3) + ' s at the begin');
    addFact('pieces', curve.degrees.length + ', degree ' + degrees.join(', '));
    if (curve.tube !== null) addFact('tube', tubeText(curve));
    addFact('world', clearanceText(curve.clearance.world));
    addFact('itself', clearanceText(curve.clearance.self));
    if (curve.tube !== null) addFact('distances', 'of the curve itself, without its tube');
    addFact('limits', limitsText(curve));
    const states = curve.polyline.length / data.variables.length;
    if (states > 0) addFact('dashed', 'the straight motions between ' + states + ' way points');
  }

  // What differs from trajectory to trajectory.
  function rebuild() {
    if (!data.isTimed) return;
    const curve = data.motions[0].curve;
    byId('curve-facts').textContent = byId('violations').textContent = '';
    addFacts(curve);
    byId('violations-title').hidden = curve.violations.length === 0;
    curve.violations.forEach((violation) => addViolation(curve, violation));
    swept.plots.rebuild();
  }

  function build() {
    if (data.isTimed) byId('speed').prepend(new Option('0.1 \u00d7', '0.1'));
    swept.plots.build();
    rebuild();
  }

  return {build, rebuild};
})();
