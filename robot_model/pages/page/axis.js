// SPDX-License-Identifier: BSD-3-Clause
// What plots are made of: round numbers on an axis, lines of no more points than can be seen.
'use strict';

swept.axis = (function () {
  // Round values between two, no more than `most` and one: [{value, text}].
  function ticks(low, high, most) {
    const rough = (high - low) / most, unit = Math.pow(10, Math.floor(Math.log10(rough)));
    const step = unit * [1, 2, 5, 10].find((factor) => factor * unit >= rough * (1 - 1e-9));
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9)), list = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
      list.push({value: i * step, text: (i * step).toFixed(digits)});
    return list;
  }

  // Indices of points that draw the same line: of many in a column of pixels the first, the lowest,
  // the highest and the last. `columns`: the column of each point, ascending.
  function thinned(columns, values) {
    const kept = [];
    for (let first = 0; first < columns.length;) {
      let last = first, low = first, high = first;
      for (; last + 1 < columns.length && columns[last + 1] === columns[first]; ++last) {
        if (values[last + 1] < values[low]) low = last + 1;
        if (values[last + 1] > values[high]) high = last + 1;
      }
      kept.push(...Array.from(new Set([first, low, high, last])).sort((a, b) => a - b));
      first = last + 1;
    }
    return kept;
  }

  function make(tag, attributes, parent) {
    const element = document.createElementNS('http://www.w3.org/2000/svg', tag);
    for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
    parent.append(element);
    return element;
  }

  // Of points {x, y}, in pixels.
  const pathOf = (points) => points.map((p, i) => (i === 0 ? 'M' : 'L') + p.x.toFixed(1) + ' ' +
      p.y.toFixed(1)).join('');

  return {ticks, thinned, make, pathOf};
})();
