// SPDX-License-Identifier: BSD-3-Clause
// What is asked of a motion besides distances: each constraint in words, with its value now and, of a
// trajectory, over time. Lengths in m, angles in rad.
'use strict';

swept.constraints = (function () {
  const data = swept.data, playback = swept.playback, kinematics = swept.kinematics, curves = swept.curve;
  const byId = (id) => document.getElementById(id);
  const all = data.constraints;
  const kSamples = 320; // of a curve, at least
  const kLeast = 1e-9; // rad or m: a tolerance counts as no less, as shares of it are numbers
  const kBeside = 1e-5; // rad or m, by which a joint may be off what is asked of it
  const kColours = 8; // --joint-0, ... of the style
  const items = []; // {dot, amount} of each constraint
  let plot = null, pointed = null, hovered = -1;

  const one = new THREE.Vector3(1, 1, 1);
  const placeOf = (own) => new THREE.Matrix4().compose(
      new THREE.Vector3().fromArray(own.position), new THREE.Quaternion().fromArray(own.turn), one);
  const inverse = (pose) => new THREE.Matrix4().getInverse(pose);
  const frameAt = (frame, poses) => (frame.link === null ? placeOf(frame) : poses[frame.link].clone().multiply(placeOf(frame)));
  // Of the frame in the reference.
  const relative = (own, poses) => inverse(frameAt(own.reference, poses)).multiply(frameAt(own.frame, poses));
  const turnOf = (pose) => new THREE.Quaternion().setFromRotationMatrix(pose);

  const part = (value, most, unit) => ({value: Math.abs(value), most: most, unit: unit});
  const shareOf = (own) => own.value / Math.max(own.most, kLeast);
  // The one that is nearest to its limit, or farthest beyond it; those without limit are none.
  function worst(parts) {
    const limited = parts.filter((own) => own.most !== null);
    return limited.length === 0 ? part(0, Infinity, 'rad') : limited.reduce((a, b) => (shareOf(b) > shareOf(a) ? b : a));
  }

  function ofJoint(own, values) {
    const joint = data.tree.joints[own.joint];
    const value = joint.mimic || joint.variable === null || own.value === 0
        ? kinematics.jointValue(joint, values) : values[joint.variable + own.value];
    const off = own.cyclic ? kinematics.cyclicDifference(own.position, value) : value - own.position;
    const most = off < 0 ? own.below : own.above;
    return worst([part(off, most === null ? null : most + kBeside, own.unit)]);
  }
  function ofRegion(region, point) {
    const p = point.clone().applyMatrix4(inverse(placeOf(region))), size = region.size;
    const half = (value, full) => part(value, full === null ? null : 0.5 * full, 'm');
    if (region.type === 'sphere') return worst([part(p.length(), size[0], 'm')]);
    if (region.type === 'cylinder') return worst([part(Math.hypot(p.x, p.y), size[0], 'm'), half(p.z, size[1])]);
    return worst([half(p.x, size[0]), half(p.y, size[1]), half(p.z, size[2])]);
  }
  function ofPosition(own, poses) {
    const point = new THREE.Vector3().setFromMatrixPosition(relative(own, poses));
    return own.regions.map((region) => ofRegion(region, point)).reduce((a, b) => (shareOf(b) < shareOf(a) ? b : a));
  }
  function rotationVector(turn) {
    const sine = Math.hypot(turn.x, turn.y, turn.z), side = turn.w < 0 ? -1 : 1;
    const factor = sine === 0 ? 0 : side * 2 * Math.atan2(sine, Math.abs(turn.w)) / sine;
    return [factor * turn.x, factor * turn.y, factor * turn.z];
  }
  function ofOrientation(own, poses) {
    const turn = turnOf(relative(own, poses));
    const back = new THREE.Quaternion().fromArray(own.turn).conjugate(); // three.js r111: its inverse
    const angles = own.vector ? rotationVector(turn.multiply(back))
        : new THREE.Euler().setFromQuaternion(back.multiply(turn), 'XYZ').toArray().slice(0, 3);
    return worst(angles.map((angle, i) => part(angle, own.tolerance[i] >= Math.PI ? null : own.tolerance[i], 'rad')));
  }
  function ofAxis(own, poses) {
    const axis = new THREE.Vector3().fromArray(own.axis).applyQuaternion(turnOf(relative(own, poses)));
    const direction = new THREE.Vector3().fromArray(own.direction);
    const sine = axis.clone().cross(direction).length();
    return worst([part(Math.atan2(sine, axis.dot(direction)), own.angle, 'rad')]);
  }

  // Of each constraint {value, most, unit}: what of it is nearest to its limit. `values`: of the robot.
  function measure(values) {
    const poses = kinematics.poses(values);
    return all.map((own) => (own.kind === 'joint' ? ofJoint(own, values) : own.kind === 'position' ? ofPosition(own, poses)
        : own.kind === 'orientation' ? ofOrientation(own, poses) : ofAxis(own, poses)));
  }

  const numberText = (value) => String(Number(value.toPrecision(3)));
  const valueText = (own) => numberText(own.value) + (Number.isFinite(own.most) ? ' of ' + numberText(own.most) : '') + ' ' + own.unit;
  const strokeOf = (index) => 'var(--joint-' + index % kColours + ')';
  const motion = () => data.motions[0];
  const now = () => motion().curve.knots[0] + playback.state.time;
  const measureAt = (time) => measure(kinematics.whole(kinematics.onMotion(motion(), (time - motion().curve.knots[0]) / motion().duration)));

  function make(tag, className, parent, text) {
    const element = document.createElement(tag);
    element.className = className;
    if (text !== undefined) element.textContent = text;
    parent.append(element);
    return element;
  }

  function addConstraint(own, index) {
    const item = make('li', '', byId('constraints')), dot = make('span', 'dot', item);
    if (data.isTimed) dot.style.background = strokeOf(index); // of its line
    make('span', 'name', item, own.text);
    items.push({dot: dot, amount: make('span', 'amount', item)});
  }

  // Where one does not hold; `time`: on the page's clock.
  function addViolation(text, where, time) {
    const button = make('button', '', make('li', '', byId('broken')));
    make('span', 'dot violation', button);
    make('span', 'name', button, text);
    make('span', 'amount', button, where);
    button.addEventListener('click', () => {
      playback.pause();
      playback.setTime(time);
    });
  }
  function addViolations() {
    byId('broken').textContent = '';
    data.motions.forEach((own, i) => {
      if (own.violation === null) return;
      addViolation(own.violation.text, own.label + ', ' + data.momentText(own, own.violation.t), data.timeOf(i, own.violation.t));
    });
    if (!data.isPath) data.states.forEach((own, i) => own.violations.forEach((text) => addViolation(text, own.label, i)));
  }

  const kept = () => (data.isPath ? data.motions : data.states).every((own) => own.verdict === 'free');
  function titleText() {
    if (!data.isPath) return kept() ? 'proven of each state' : 'asked of each state';
    return kept() ? 'proven at every instant' : 'asked of every instant';
  }

  function makePlot() {
    const curve = motion().curve, samples = curves.samples(curve, kSamples);
    // At a knot a curve of degree 1 turns: each piece has its own values there.
    const found = samples.times.map((time) => measureAt(time));
    const series = all.map((own, i) => ({
      name: own.name, low: null, high: 1, violation: null, values: found.map((each) => shareOf(each[i])), tube: 0, clip: null,
      stroke: strokeOf(i), dashes: ''
    }));
    const marks = motion().violation === null ? []
        : [{name: 'contact', time: data.momentOf(motion(), motion().violation.t), text: motion().violation.text}];
    plot = swept.plot(byId('plot-constraint').querySelector('svg'),
                      {name: 'constraints', unit: '', times: samples.times, knots: Array.from(curve.knots), series: series, marks: marks});
    plot.svg.setAttribute('aria-label', 'constraints over time, as shares of what is allowed: ' + all.map((own, i) =>
        own.name + ' up to ' + Math.max(...series[i].values).toFixed(2)).join('; '));
  }

  function readOut() {
    const box = byId('plot-constraint').querySelector('.plot-value'), chosen = all.length === 1 ? 0 : hovered;
    plot.highlight(hovered);
    box.textContent = chosen < 0 ? '' : all[chosen].name + ' ' + valueText(measureAt(pointed === null ? now() : pointed)[chosen]);
  }

  function show(state) {
    const found = measure(state.values || kinematics.valuesAt(state.time));
    found.forEach((own, i) => {
      const beyond = own.value > own.most;
      items[i].amount.textContent = valueText(own);
      items[i].amount.dataset.tone = beyond ? 'bad' : '';
      if (!data.isTimed) items[i].dot.className = 'dot ' + (beyond ? 'violation' : 'free');
    });
    if (plot === null || byId('plots').hidden) return;
    plot.showTime(now(), measureAt(now()).map(shareOf));
    readOut();
  }

  function redraw() {
    if (plot === null || byId('plots').hidden) return;
    plot.draw(Math.max(120, byId('plot-constraint').clientWidth));
    show(playback.state);
  }

  // Of the path that is shown.
  function rebuild() {
    if (all.length === 0) return;
    byId('constraints-title').textContent = titleText();
    addViolations();
    if (data.isTimed) makePlot();
    redraw();
  }

  function point(at) {
    pointed = at === null ? null : at.time;
    hovered = at === null ? -1 : plot.nearest(at.y, measureAt(at.time).map(shareOf));
    readOut();
  }

  function build() {
    byId('constraints-title').hidden = all.length === 0;
    if (all.length === 0) return;
    all.forEach(addConstraint);
    byId('plot-constraint').hidden = !data.isTimed;
    rebuild();
    if (data.isTimed) {
      swept.plots.listen(plot.svg, () => plot, point);
      new ResizeObserver(redraw).observe(byId('plots'));
    }
    playback.onChange(show);
  }

  return {build, rebuild, measure, measureAt, plot: () => plot};
})();
