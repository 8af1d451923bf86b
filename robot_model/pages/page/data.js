// SPDX-License-Identifier: BSD-3-Clause
// What the program computed, unpacked; and where on the page's clock each motion is.
'use strict';
const swept = window.swept = {}; // the page of a task reaches it, too

swept.data = (function () {
  const data = JSON.parse(document.getElementById('data').textContent);
  const kPose = 7; // position, then quaternion x, y, z, w

  function bytesOf(text) {
    const raw = atob(text);
    const bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; ++i) bytes[i] = raw.charCodeAt(i);
    return bytes.buffer;
  }
  // Every browser's machine is little-endian, as the numbers are.
  data.floats = (text) => new Float32Array(bytesOf(text));
  data.uint16s = (text) => new Uint16Array(bytesOf(text));
  data.uint32s = (text) => new Uint32Array(bytesOf(text));
  data.doubles = (text) => new Float64Array(bytesOf(text));

  data.poses = data.floats(data.frames.poses);
  data.linkCount = data.frames.links.length;
  data.poseAt = (frame, link) => (frame * data.linkCount + link) * kPose;
  data.tipIndex = data.tip === null ? -1 : data.frames.links.indexOf(data.tip);
  data.isPath = data.motions.length > 0;
  // Each motion is a curve in time: the page's clock shows its seconds.
  data.isTimed = data.isPath && data.motions.every((motion) => motion.curve);

  // Coefficients are piece by piece, and of each variable one after the other.
  function unpackCurve(motion) {
    const curve = motion.curve;
    for (const name of ['knots', 'coefficients', 'polyline']) curve[name] = data.doubles(curve[name]);
    let first = 0;
    curve.firsts = curve.degrees.map((degree) => {
      const own = first;
      first += data.variables.length * (degree + 1);
      return own;
    });
    motion.duration = curve.knots[curve.knots.length - 1] - curve.knots[0];
  }
  for (const motion of data.motions) if (motion.curve) unpackCurve(motion);

  for (const body of data.bodies)
    if (body.motion)
      for (const name of ['times', 'poses']) body.motion[name] = data.doubles(body.motion[name]);
  data.moving = data.bodies.filter((body) => body.motion);

  if (data.clearances) {
    for (const table of [data.clearances, data.clearances.world, data.clearances.self]) {
      table.distance = data.floats(table.distance);
      table.partner = new Int32Array(bytesOf(table.partner));
    }
  }

  // How far the robot gets from one frame to the next: m, and 0.3 m for a radian.
  function travel(frame) {
    let most = 0;
    const p = data.poses;
    for (let link = 0; link < data.linkCount; ++link) {
      const a = data.poseAt(frame, link), b = data.poseAt(frame + 1, link);
      const way = Math.hypot(p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]);
      let dot = 0;
      for (let i = 3; i < kPose; ++i) dot += p[a + i] * p[b + i];
      most = Math.max(most, way + 0.3 * 2 * Math.acos(Math.min(1, Math.abs(dot))));
    }
    return most;
  }

  // Seconds: each motion gets time in proportion to its travel; all of them 4 s to 30 s.
  function layOutClock() {
    let total = 0;
    for (const motion of data.motions) {
      motion.duration = 1e-3;
      for (let i = 0; i < motion.steps; ++i) motion.duration += travel(motion.first_frame + i);
      total += motion.duration;
    }
    const scale = Math.min(30, Math.max(4, total / 0.45)) / total;
    for (const motion of data.motions) motion.duration *= scale;
  }
  // Those of curves have their own time. Beside bodies that move, straight motions take the time that
  // their clock takes.
  function layOutMotions() {
    if (data.motions.every((motion) => motion.clock))
      for (const motion of data.motions)
        motion.duration = Math.max(1e-3, Math.abs(motion.clock[1] - motion.clock[0]));
    else if (!data.isTimed) layOutClock();
    let start = 0;
    for (const motion of data.motions) {
      motion.start = start;
      start += motion.duration;
    }
    data.duration = start;
  }
  // Of several paths one is shown: `motions` are its own.
  data.allMotions = data.motions;
  data.usePath = function (path) {
    data.path = path;
    data.motions = data.allMotions.filter((motion) => motion.path === path);
    if (data.isPath) layOutMotions();
    else data.duration = Math.max(0, data.states.length - 1);
  };
  data.usePath(0);
  // Those of what is shown, both included.
  data.firstFrame = () => (data.isPath ? data.motions[0].first_frame : 0);
  data.lastFrame = function () {
    if (!data.isPath) return data.frames.count - 1;
    const last = data.motions[data.motions.length - 1];
    return last.first_frame + last.steps;
  };
  const pathColours = ['#2f6fbf', '#d9822b', '#2f9e6e', '#a04fb0', '#c2435b', '#7a6a3a'];
  data.pathColour = (path) => pathColours[path % pathColours.length];

  // Which motion or state is at a time, the t in it, and the frame (with a fraction).
  data.locate = function (time) {
    if (!data.isPath) {
      const index = Math.round(Math.min(data.duration, Math.max(0, time)));
      return {index: index, t: 0, frame: index};
    }
    let index = 0;
    while (index + 1 < data.motions.length && time >= data.motions[index + 1].start) ++index;
    const motion = data.motions[index];
    const t = Math.min(1, Math.max(0, (time - motion.start) / motion.duration));
    return {index: index, t: t, frame: motion.first_frame + t * motion.steps};
  };
  data.timeOf = function (index, t) {
    return data.isPath ? data.motions[index].start + t * data.motions[index].duration : index;
  };

  // A moment of a motion: t, or the time of its curve.
  data.momentOf = (motion, t) => (motion.curve ? motion.curve.knots[0] + t * motion.duration : t);
  // What the clock of bodies that move shows at a time of the page's.
  data.clockAt = function (time) {
    const at = data.locate(time);
    if (!data.isPath) return data.states[at.index].clock;
    const motion = data.motions[at.index];
    return motion.curve ? motion.curve.clock + data.momentOf(motion, at.t)
                        : motion.clock[0] + at.t * (motion.clock[1] - motion.clock[0]);
  };
  data.momentText = (motion, t) => (motion.curve ? data.momentOf(motion, t).toFixed(3) + ' s'
                                                 : 't ' + t.toFixed(3));

  // Frames of a path are near their neighbours; states are not.
  data.hasRow = (frame) => data.isPath || frame % data.clearances.stride === 0;
  // What a body is nearest to at the frame of the table that is next to this one: {distance,
  // partner}; null: nothing is checked against it, or the table has no row for the state. `kind`:
  // of the pairs with the world, or of those of the robot itself alone.
  data.nearest = function (body, frame, kind) {
    const all = data.clearances;
    if (!all || !data.hasRow(frame)) return null;
    const table = kind ? all[kind] : all;
    const rows = table.distance.length / all.bodies;
    const row = Math.min(rows - 1, Math.round(frame / all.stride));
    const at = row * all.bodies + body;
    return table.partner[at] < 0
        ? null : {distance: table.distance[at], partner: table.partner[at], row: row};
  };

  // The body that is nearest to one it is checked against, at a row of the table.
  data.leastAt = function (frame) {
    let least = {body: -1, distance: Infinity};
    for (let body = 0; body < data.clearances.bodies; ++body) {
      const near = data.nearest(body, frame);
      if (near !== null && near.distance < least.distance) least = {body: body, distance: near.distance};
    }
    return least;
  };

  // Rounded down: what is proven stays true.
  data.millimetres = function (metres) {
    if (metres === null || metres === undefined) return 'no pair to check';
    if (metres >= 1) return (Math.floor(metres * 1e3) / 1e3).toFixed(3) + ' m';
    const digits = metres < 0.1 ? 2 : 1;
    const unit = Math.pow(10, digits);
    return (Math.floor(metres * 1e3 * unit) / unit).toFixed(digits) + ' mm';
  };

  // Colour of a clearance in m: red where nothing is left, blue from 100 mm on.
  const stops = [[0, [193, 18, 31]], [5, [240, 138, 36]], [20, [226, 190, 92]],
                 [50, [76, 170, 160]], [100, [58, 110, 165]]];
  data.clearanceStops = stops;
  data.clearanceColour = function (metres) {
    const value = metres === null ? Infinity : metres * 1e3;
    for (let i = 1; i < stops.length; ++i) {
      if (value > stops[i][0]) continue;
      const share = (value - stops[i - 1][0]) / (stops[i][0] - stops[i - 1][0]);
      return stops[i][1].map((c, k) => stops[i - 1][1][k] * (1 - share) + c * share);
    }
    return stops[stops.length - 1][1];
  };
  data.css = (rgb) => 'rgb(' + rgb.map(Math.round).join(',') + ')';
  data.tierNames = {
    lanes: 'free, proven in single precision', exact: 'free, proven on exact geometry',
    undecided: 'undecided', collision: 'collision', violation: 'off a constraint'
  };
  return data;
})();
