// SPDX-License-Identifier: BSD-3-Clause
// Curves in time: their values and rates at any time, from the coefficients that the checker has.
'use strict';

swept.curve = (function () {
  const count = swept.data.variables.length;
  const work = new Float64Array(8); // the coefficients of one value

  // The piece that a time is in: at a knot the later one.
  function pieceAt(curve, time) {
    let low = 0, high = curve.degrees.length - 1;
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (curve.knots[middle] <= time) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  // One value at a share u of a piece, by de Casteljau; `order` 1: its rate, 2: the rate of that.
  function valueIn(curve, piece, u, variable, order) {
    let left = curve.degrees[piece] + 1;
    const first = curve.firsts[piece] + variable * left;
    const length = curve.knots[piece + 1] - curve.knots[piece];
    for (let k = 0; k < left; ++k) work[k] = curve.coefficients[first + k];
    for (let i = 0; i < order; ++i) {
      if (--left === 0) return 0;
      for (let k = 0; k < left; ++k) work[k] = left / length * (work[k + 1] - work[k]);
    }
    while (--left > 0) for (let k = 0; k < left; ++k) work[k] += u * (work[k + 1] - work[k]);
    return work[0];
  }

  function place(curve, time) {
    const piece = pieceAt(curve, time), begin = curve.knots[piece];
    const u = (time - begin) / (curve.knots[piece + 1] - begin);
    return {piece: piece, u: Math.min(1, Math.max(0, u))};
  }

  // A value of each variable; before and after the curve that of its ends.
  function at(curve, time, order) {
    const {piece, u} = place(curve, time), values = [];
    for (let i = 0; i < count; ++i) values.push(valueIn(curve, piece, u, i, order));
    return values;
  }

  // The first or last coefficients of a piece.
  function end(curve, piece, last) {
    const terms = curve.degrees[piece] + 1, values = [];
    for (let i = 0; i < count; ++i)
      values.push(curve.coefficients[curve.firsts[piece] + i * terms + (last ? terms - 1 : 0)]);
    return values;
  }

  // Times from knot to knot, each knot as the end of one piece and the begin of the next one, where
  // rates may jump: {times, pieces, shares}.
  function samples(curve, wanted) {
    const times = [], pieces = [], shares = [];
    curve.degrees.forEach((degree, piece) => {
      const steps = degree === 1 ? 1 : Math.max(4, Math.ceil(wanted / curve.degrees.length));
      const begin = curve.knots[piece], length = curve.knots[piece + 1] - begin;
      for (let i = 0; i <= steps; ++i) {
        times.push(begin + i / steps * length);
        pieces.push(piece);
        shares.push(i / steps);
      }
    });
    return {times: times, pieces: pieces, shares: shares};
  }

  return {pieceAt, place, valueIn, at, end, samples};
})();
