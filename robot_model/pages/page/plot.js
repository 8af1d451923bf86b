// SPDX-License-Identifier: BSD-3-Clause
// One plot over time: a line for each variable, with its limits, its tube and where it leaves a
// limit. Times in s.
'use strict';

swept.plot = (function () {
  const axis = swept.axis;
  const kHeight = 124, kLeft = 40, kRight = 8, kTop = 7, kBottom = 17; // pixels
  const kNear = 24; // pixels, from the pointer to the line that it means
  const kTickGap = 3; // pixels, between two knots that are both drawn
  const kReach = 0.35; // of the range of values: limits this far beyond it are in the picture

  // `about`: {name, unit, times (of the samples), knots, series, marks}. A series has `values`, of
  // the samples, `low` and `high` (its limits, null: none), `tube` (0: none), `clip` (null, or what
  // the tube ends at), `violation` (null: none), `stroke` and `name`; a mark has `time`, `name`.
  return function (svg, about) {
    const self = {about: about, svg: svg};
    let scale = null, lines = [], tubes = [], dots = [], cursor = null; // by series

    const bandOf = (series, value) => {
      const [low, high] = series.clip || [-Infinity, Infinity];
      return [Math.max(Math.min(low, value), value - series.tube), Math.min(Math.max(high, value), value + series.tube)];
    };

    function valueRange() {
      let low = Infinity, high = -Infinity;
      for (const series of about.series) {
        for (const value of series.values) {
          const [from, to] = bandOf(series, value);
          low = Math.min(low, from);
          high = Math.max(high, to);
        }
      }
      const room = high - low;
      for (const series of about.series) {
        if (series.low !== null && series.low > low - kReach * room) low = Math.min(low, series.low);
        if (series.high !== null && series.high < high + kReach * room) high = Math.max(high, series.high);
      }
      const rim = high - low > 1e-9 ? 0.06 * (high - low) : 0.5;
      return [low - rim, high + rim];
    }

    function makeScale(width) {
      const [low, high] = valueRange(), times = about.times;
      const begin = times[0], length = times[times.length - 1] - begin;
      const plotted = width - kLeft - kRight, tall = kHeight - kTop - kBottom;
      return {
        width: width, low: low, high: high, begin: begin, length: length,
        x: (time) => kLeft + plotted * (time - begin) / length,
        y: (value) => kTop + tall * (high - value) / (high - low),
        time: (x) => begin + length * Math.min(1, Math.max(0, (x - kLeft) / plotted))
      };
    }

    function drawAxes() {
      const {x, y} = scale, bottom = kHeight - kBottom, right = scale.width - kRight;
      for (const tick of axis.ticks(scale.low, scale.high, 5)) {
        axis.make('line', {class: 'grid', x1: kLeft, x2: right, y1: y(tick.value), y2: y(tick.value)}, svg);
        axis.make('text', {class: 'side', x: kLeft - 5, y: y(tick.value) + 3}, svg).textContent = tick.text;
      }
      axis.ticks(scale.begin, scale.begin + scale.length, Math.max(2, scale.width / 60)).forEach((tick, i) => {
        const text = axis.make('text', {class: 'below', x: x(tick.value), y: kHeight - 3}, svg);
        text.textContent = tick.text + (i === 0 ? ' s' : '');
      });
      let last = -Infinity;
      for (const knot of about.knots) {
        if (x(knot) - last < kTickGap) continue;
        last = x(knot);
        axis.make('line', {class: 'knot', x1: last, x2: last, y1: bottom - 4, y2: bottom}, svg);
      }
      axis.make('line', {class: 'foot', x1: kLeft, x2: right, y1: bottom, y2: bottom}, svg);
    }

    // Equal limits of several variables are one line.
    function drawLimits() {
      const bounds = new Map();
      about.series.forEach((series, i) => {
        for (const bound of [series.low, series.high]) {
          if (bound === null || bound < scale.low || bound > scale.high) continue;
          bounds.set(bound, (bounds.get(bound) || []).concat([i]));
        }
      });
      for (const [bound, of] of bounds) {
        const stroke = of.length === 1 ? about.series[of[0]].stroke : 'var(--soft)';
        const line = axis.make('line', {class: 'limit', x1: kLeft, x2: scale.width - kRight, y1: scale.y(bound),
                                        y2: scale.y(bound), 'data-of': of.join(' ')}, svg);
        line.style.stroke = stroke;
      }
    }

    function pointsOf(series) {
      const columns = about.times.map((time) => Math.floor(scale.x(time)));
      return axis.thinned(columns, series.values).map((i) => (
          {x: scale.x(about.times[i]), y: scale.y(series.values[i]), value: series.values[i]}));
    }

    function drawTube(series) {
      const points = series.tube > 0 ? pointsOf(series) : [];
      const edge = (side) => points.map((p) => ({x: p.x, y: scale.y(bandOf(series, p.value)[side])}));
      const band = axis.make('path', {class: 'tube', d: axis.pathOf(edge(1).concat(edge(0).reverse()))}, svg);
      band.style.fill = series.stroke;
      return band;
    }

    // A line, and red what of it is beyond a limit.
    function drawSeries(series) {
      const points = pointsOf(series);
      const line = axis.make('path', {class: 'line', d: axis.pathOf(points)}, svg);
      line.style.stroke = series.stroke;
      if (series.dashes) line.style.strokeDasharray = series.dashes;
      if (series.violation !== null) drawBeyond(series, points);
      return line;
    }

    function drawBeyond(series, points) {
      const isBeyond = (p) => (series.high !== null && p.value > series.high) || (series.low !== null && p.value < series.low);
      const parts = [];
      points.forEach((p, i) => {
        if (!isBeyond(p)) return;
        if (i === 0 || !isBeyond(points[i - 1])) parts.push([]);
        parts[parts.length - 1].push(p);
      });
      axis.make('path', {class: 'beyond', d: parts.map(axis.pathOf).join('')}, svg);
    }

    function drawViolations() {
      for (const {name, violation} of about.series) {
        if (violation === null) continue;
        const at = {cx: scale.x(violation.time), cy: scale.y(violation.value), r: 4.5};
        const ring = axis.make('circle', Object.assign({class: 'violation'}, at), svg);
        axis.make('title', {}, ring).textContent = name + ' ' + violation.value.toPrecision(5) + ' ' + about.unit +
            ' at ' + violation.time.toFixed(3) + ' s; limit ' + violation.limit.toPrecision(5);
      }
    }

    function drawMarks() {
      for (const mark of about.marks) {
        const x = scale.x(mark.time);
        const line = axis.make('line', {class: 'mark ' + mark.name, x1: x, x2: x, y1: kTop, y2: kHeight - kBottom}, svg);
        axis.make('title', {}, line).textContent = mark.text;
      }
    }

    self.draw = function (width) {
      svg.textContent = '';
      svg.setAttribute('width', width);
      svg.setAttribute('height', kHeight);
      scale = makeScale(width);
      drawAxes();
      drawLimits();
      drawMarks();
      tubes = about.series.map(drawTube);
      lines = about.series.map(drawSeries);
      drawViolations();
      cursor = axis.make('line', {class: 'now', y1: kTop, y2: kHeight - kBottom}, svg);
      dots = about.series.map((series) => {
        const dot = axis.make('circle', {class: 'dot', r: 2.5}, svg);
        dot.style.fill = series.stroke;
        return dot;
      });
    };

    // `values`: of the series, at the time.
    self.showTime = function (time, values) {
      if (scale === null) return;
      const x = scale.x(time);
      cursor.setAttribute('x1', x);
      cursor.setAttribute('x2', x);
      dots.forEach((dot, i) => {
        dot.setAttribute('cx', x);
        dot.setAttribute('cy', scale.y(values[i]));
      });
    };

    // Of one series; -1: none.
    self.highlight = function (index) {
      const other = (i) => index >= 0 && i !== index;
      for (const drawn of [lines, tubes, dots]) drawn.forEach((part, i) => part.classList.toggle('faint', other(i)));
      for (const limit of svg.querySelectorAll('.limit')) {
        const own = limit.dataset.of.split(' ').map(Number).includes(index);
        limit.classList.toggle('own', own);
        limit.classList.toggle('faint', index >= 0 && !own);
      }
    };

    self.timeAt = (x) => scale.time(x);
    // The series whose line is nearest to a height, by their values at a time; -1: none is near.
    self.nearest = function (y, values) {
      const distances = values.map((value) => Math.abs(scale.y(value) - y));
      const least = Math.min(...distances);
      return least < kNear ? distances.indexOf(least) : -1;
    };
    return self;
  };
})();
