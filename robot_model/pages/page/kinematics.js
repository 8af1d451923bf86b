// SPDX-License-Identifier: BSD-3-Clause
// Configurations, and the poses of links in them. A configuration has a value for each variable of
// the robot, in m, rad, or the components of a quaternion.
'use strict';

swept.kinematics = (function () {
  const data = swept.data, tree = data.tree;
  const kTurn = 2 * Math.PI;

  // The shorter way from one angle to another; of a half turn, as the checker takes it.
  function cyclicDifference(from, to) {
    const turns = (to - from) / kTurn;
    let whole = Math.floor(turns + 0.5);
    if (turns + 0.5 === whole && whole % 2 !== 0) whole -= 1;
    return to - from - kTurn * whole;
  }

  // Index of the first component in the group's values -> that it begins a quaternion.
  const quaternions = tree.joints.filter((joint) => joint.type === 'floating' && joint.variable !== null)
      .map((joint) => tree.group.indexOf(joint.variable + 3)).filter((at) => at >= 0);

  // The group's values on the way from one configuration of it to another.
  function between(from, to, t) {
    const values = from.map((value, i) => value + t *
        (tree.variables[tree.group[i]].cyclic ? cyclicDifference(value, to[i]) : to[i] - value));
    turnBetween(from, to, t, values);
    return values;
  }
  function turnBetween(from, to, t, values) {
    for (const at of quaternions) {
      const turn = new THREE.Quaternion().fromArray(from, at).normalize();
      turn.slerp(new THREE.Quaternion().fromArray(to, at).normalize(), t).toArray(values, at);
    }
  }

  // The group's values at a time of a curve: orientations turn along pieces of degree 1 alone.
  function onCurve(curve, time) {
    const values = swept.curve.at(curve, time, 0), {piece, u} = swept.curve.place(curve, time);
    if (quaternions.length > 0 && curve.degrees[piece] === 1)
      turnBetween(swept.curve.end(curve, piece, false), swept.curve.end(curve, piece, true), u, values);
    return values;
  }
  const onMotion = (motion, t) => (motion.curve ? onCurve(motion.curve, data.momentOf(motion, t))
                                                : between(motion.from, motion.to, t));

  // The robot's values, of which the group has these.
  function whole(groupValues) {
    const values = tree.reference.slice();
    tree.group.forEach((variable, i) => { values[variable] = groupValues[i]; });
    return values;
  }

  // What the page shows at a time of its clock.
  function valuesAt(time) {
    const at = data.locate(time);
    if (!data.isPath) return data.states[at.index] ? whole(data.states[at.index].values) : tree.reference.slice();
    return whole(onMotion(data.motions[at.index], at.t));
  }

  function jointValue(joint, values) {
    const value = joint.variable === null ? 0 : values[joint.variable];
    return joint.mimic ? joint.mimic.multiplier * value + joint.mimic.offset : value;
  }

  // From the frame of a joint to that of the link it moves.
  function motionOf(joint, values) {
    const position = new THREE.Vector3(), turn = new THREE.Quaternion();
    const axis = new THREE.Vector3().fromArray(joint.axis), first = joint.variable;
    if (joint.type === 'revolute' || joint.type === 'continuous') {
      turn.setFromAxisAngle(axis, jointValue(joint, values));
    } else if (joint.type === 'prismatic') {
      position.copy(axis).multiplyScalar(jointValue(joint, values));
    } else if (joint.type === 'planar') {
      position.set(values[first], values[first + 1], 0)
          .applyQuaternion(new THREE.Quaternion().fromArray(joint.plane));
      turn.setFromAxisAngle(axis, values[first + 2]);
    } else if (joint.type === 'floating') {
      position.fromArray(values, first);
      turn.fromArray(values, first + 3).normalize();
    }
    return new THREE.Matrix4().compose(position, turn, new THREE.Vector3(1, 1, 1));
  }

  // Pose of each link in the model frame.
  function poses(values) {
    const placed = tree.links.map(() => new THREE.Matrix4());
    for (const joint of tree.joints) { // parents come first
      const pose = placed[joint.child];
      if (joint.parent !== null) pose.copy(placed[joint.parent]);
      pose.multiply(new THREE.Matrix4().compose(
          new THREE.Vector3().fromArray(joint.position), new THREE.Quaternion().fromArray(joint.turn),
          new THREE.Vector3(1, 1, 1)));
      pose.multiply(motionOf(joint, values));
    }
    return placed;
  }

  // The variable in which two configurations differ most, and by how much: {variable, amount}.
  function difference(a, b) {
    let most = {variable: -1, amount: 0};
    tree.variables.forEach((variable, i) => {
      const amount = Math.abs(variable.cyclic ? cyclicDifference(a[i], b[i]) : a[i] - b[i]);
      if (amount > most.amount) most = {variable: i, amount: amount};
    });
    return most;
  }

  // The moment of the path, or the state, whose configuration is nearest: {time, variable, amount}.
  function nearestKnown(values) {
    let best = null;
    const offer = (time, known) => {
      const found = difference(values, known);
      if (best === null || found.amount < best.amount) best = Object.assign({time: time}, found);
    };
    if (!data.isPath) data.states.forEach((state, i) => offer(i, whole(state.values)));
    else data.motions.forEach((motion, m) => {
      for (let i = 0; i <= motion.steps; ++i) {
        const t = i / motion.steps;
        // The end of a motion is not the start of the next one, which may begin elsewhere.
        offer(data.timeOf(m, Math.min(t, 1 - 1e-9)), whole(onMotion(motion, t)));
      }
    });
    return best;
  }

  // Ends of a slider; what has no limits gets some that can be seen.
  function range(variable) {
    if (variable.unit === '') return [-1, 1];
    const reach = variable.unit === 'rad' ? Math.PI : 3;
    return [variable.lower === null ? -reach : variable.lower,
            variable.upper === null ? reach : variable.upper];
  }

  return {valuesAt, onMotion, poses, whole, jointValue, cyclicDifference, nearestKnown, range, between};
})();
