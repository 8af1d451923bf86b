// SPDX-License-Identifier: BSD-3-Clause
// Plots of a trajectory below the picture: positions, velocities and accelerations over time.
'use strict';

swept.plots = (function () {
  const data = swept.data, playback = swept.playback, curves = swept.curve;
  const byId = (id) => document.getElementById(id);
  const kNames = ['position', 'velocity', 'acceleration'];
  const kSamples = 320; // of a curve, at least
  const kColours = 8; // --joint-0, ... of the style
  const kDashes = ['', '6 3', '2 2'];
  const kJump = 1e-6; // of the velocity: more than rounding makes
  const kRoom = 620; // pixels, of a window that is high enough for plots
  const variables = []; // indices of those that are plotted: no components of quaternions
  const plots = [];
  let pinned = -1, hovered = -1, pointed = null; // indices into `variables`; the pointer's time

  const motion = () => data.motions[0];
  const now = () => motion().curve.knots[0] + playback.state.time;
  const valuesAt = (time, order) => {
    const all = curves.at(motion().curve, time, order);
    return variables.map((variable) => all[variable]);
  };
  const suffixes = ['', '/s', '/s\u00b2'];
  const unitOf = (variable, order) => data.variables[variable].unit + suffixes[order];

  function limitsOf(curve, variable, order) {
    if (order === 0) return [curve.limits.lower[variable], curve.limits.upper[variable]];
    const rates = curve.limits[kNames[order]], most = rates === null ? null : rates[variable];
    return [most === null ? null : -most, most];
  }

  function seriesOf(curve, samples, variable, index, order) {
    const [low, high] = limitsOf(curve, variable, order), name = data.variables[variable].name;
    const found = curve.violations.find((v) => v.variable === name && v.kind === kNames[order]);
    const slides = data.tree.joints.some((joint) => joint.type === 'prismatic' && joint.name === name);
    return {
      name: name, low: low, high: high, violation: found === undefined ? null : found,
      values: samples.pieces.map((piece, k) => curves.valueIn(curve, piece, samples.shares[k], variable, order)),
      tube: order === 0 && curve.tube !== null ? curve.tube[variable] : 0,
      clip: slides ? [low, high] : null, // no sliding joint is beyond its limits
      stroke: 'var(--joint-' + index % kColours + ')',
      dashes: kDashes[Math.floor(index / kColours) % kDashes.length]
    };
  }

  // Knots at which velocities jump: no acceleration says how.
  function jumpsOf(curve) {
    const jumps = [];
    for (let piece = 1; piece < curve.degrees.length; ++piece) {
      const names = variables.filter((variable) => {
        const before = curves.valueIn(curve, piece - 1, 1, variable, 1), after = curves.valueIn(curve, piece, 0, variable, 1);
        return Math.abs(after - before) > kJump * Math.max(1, Math.abs(before), Math.abs(after));
      }).map((variable) => data.variables[variable].name);
      if (names.length > 0)
        jumps.push({name: 'jump', time: curve.knots[piece], text: 'velocity jumps: ' + names.join(', ')});
    }
    return jumps;
  }

  function marksOf(curve, order) {
    const marks = order === 2 ? jumpsOf(curve) : [];
    if (curve.contact !== null) marks.push({name: 'contact', time: curve.contact.time, text: 'contact'});
    if (curve.undecided !== null) marks.push({name: 'unsure', time: curve.undecided.time, text: 'undecided from here'});
    return marks;
  }

  function units(order) {
    return Array.from(new Set(variables.map((variable) => unitOf(variable, order)))).join(', ');
  }

  function makePlot(order) {
    const curve = motion().curve, samples = curves.samples(curve, kSamples), box = byId('plot-' + kNames[order]);
    const series = variables.map((variable, i) => seriesOf(curve, samples, variable, i, order));
    const plot = swept.plot(box.querySelector('svg'), {
      name: kNames[order], unit: units(order), times: samples.times, knots: Array.from(curve.knots), series: series, marks: marksOf(curve, order)
    });
    plot.order = order;
    plot.box = box;
    box.querySelector('.plot-name').textContent = kNames[order] + ', ' + units(order);
    plot.svg.setAttribute('aria-label', summary(plot));
    return plot;
  }

  // What a plot shows, for who does not see it.
  function summary(plot) {
    const parts = plot.about.series.map((series, i) => {
      const low = Math.min(...series.values), high = Math.max(...series.values);
      return series.name + ' ' + low.toFixed(2) + ' to ' + high.toFixed(2) + ' ' + unitOf(variables[i], plot.order) +
          (series.violation === null ? '' : ', beyond its limit');
    });
    return plot.about.name + ' over time: ' + parts.join('; ');
  }

  const draw = (plot) => plot.draw(Math.max(120, plot.box.clientWidth));

  const numberText = (value) => String(Number(value.toPrecision(6)));
  function limitText(series) {
    const {low, high} = series;
    if (low === null && high === null) return '';
    if (low === null || high === null) return low === null ? ' (\u2264 ' + numberText(high) + ')' : ' (\u2265 ' + numberText(low) + ')';
    return low === -high ? ' (\u00b1' + numberText(high) + ')' : ' (' + numberText(low) + ' to ' + numberText(high) + ')';
  }

  // What is said of the variable that is pointed at, or chosen.
  function readOut() {
    const chosen = hovered >= 0 ? hovered : pinned, time = pointed === null ? now() : pointed;
    for (const plot of plots) {
      const series = plot.about.series[chosen];
      plot.highlight(chosen);
      plot.box.querySelector('.plot-value').textContent = chosen < 0 ? ''
          : series.name + ' ' + valuesAt(time, plot.order)[chosen].toFixed(3) + ' ' +
              unitOf(variables[chosen], plot.order) + limitText(series);
    }
    byId('plot-time').textContent = pointed === null && chosen < 0 ? '' : 'at ' + time.toFixed(3) + ' s';
    byId('plot-legend').querySelectorAll('button').forEach((button, i) => {
      button.setAttribute('aria-pressed', i === pinned);
      button.classList.toggle('pointed', i === hovered);
    });
  }

  function show() {
    if (byId('plots').hidden) return;
    for (const plot of plots) plot.showTime(now(), valuesAt(now(), plot.order));
    readOut();
  }

  function pin(index) {
    pinned = index;
    readOut();
  }

  function addLegend() {
    variables.forEach((variable, i) => {
      const button = document.createElement('button'), swatch = document.createElement('span');
      swatch.className = 'swatch';
      swatch.style.borderTop = '3px ' + (i < kColours ? 'solid' : i < 2 * kColours ? 'dashed' : 'dotted') +
          ' var(--joint-' + i % kColours + ')';
      button.append(swatch, data.variables[variable].name);
      button.addEventListener('click', () => pin(pinned === i ? -1 : i));
      button.addEventListener('pointerenter', () => { hovered = i; readOut(); });
      button.addEventListener('pointerleave', () => { hovered = -1; readOut(); });
      byId('plot-legend').append(button);
    });
  }

  function markLegend() {
    byId('plot-legend').querySelectorAll('button').forEach((button, i) => {
      const left = motion().curve.violations.filter((v) => v.variable === data.variables[variables[i]].name);
      button.classList.toggle('beyond', left.length > 0);
      button.title = left.length === 0 ? 'only this one' : 'beyond its limit of ' + left.map((v) => v.kind).join(', ');
    });
  }

  // `point` is told what the pointer is at, {time, y}; null: it has left.
  function listen(svg, plotOf, point) {
    const place = (event) => {
      const at = svg.getBoundingClientRect();
      return {time: plotOf().timeAt(event.clientX - at.left), y: event.clientY - at.top};
    };
    const seek = (event) => playback.setTime(place(event).time - motion().curve.knots[0]);
    let dragging = false;
    svg.addEventListener('pointerdown', (event) => {
      dragging = true;
      playback.pause();
      seek(event);
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener('pointermove', (event) => {
      point(place(event));
      if (dragging) seek(event);
    });
    for (const end of ['pointerup', 'pointercancel'])
      svg.addEventListener(end, () => { dragging = false; });
    svg.addEventListener('pointerleave', () => point(null));
  }

  function point(order, at) {
    pointed = at === null ? null : at.time;
    hovered = at === null ? -1 : plots[order].nearest(at.y, valuesAt(at.time, order));
    readOut();
  }

  function redraw() {
    if (byId('plots').hidden) return;
    plots.forEach(draw);
    show();
  }

  // Those of the trajectory that is shown.
  function rebuild() {
    if (!data.isTimed) return;
    kNames.forEach((name, order) => {
      plots[order] = makePlot(order);
    });
    markLegend();
    redraw();
  }

  function toggle() {
    if (!data.isTimed) return;
    byId('plots').hidden = !byId('plots').hidden;
    byId('tool-plots').setAttribute('aria-pressed', !byId('plots').hidden);
    redraw();
  }

  function build() {
    byId('tool-plots').hidden = !data.isTimed;
    if (!data.isTimed) return;
    data.variables.forEach((variable, i) => { if (variable.unit !== '') variables.push(i); });
    addLegend();
    const high = window.innerHeight >= kRoom || window.matchMedia('(max-width: 760px)').matches;
    byId('plots').hidden = !high;
    byId('tool-plots').setAttribute('aria-pressed', high);
    kNames.forEach((name, order) =>
        listen(byId('plot-' + name).querySelector('svg'), () => plots[order], (at) => point(order, at)));
    playback.onChange(show);
    new ResizeObserver(redraw).observe(byId('plots'));
  }

  return {build, rebuild, toggle, pin, listen, plots, variables};
})();
