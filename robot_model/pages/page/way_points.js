// SPDX-License-Identifier: BSD-3-Clause
// Beside the trace of a trajectory: the way of the tip along the polyline that it was made from,
// dashed, with its way points.
'use strict';

swept.wayPoints = (function () {
  const data = swept.data, scene = swept.scene, kinematics = swept.kinematics;
  const kSteps = 24; // of each straight motion
  const kDash = 0.016, kGap = 0.011; // of the size of what is shown
  const groups = []; // of each trajectory; null: it has no polyline
  let material = null;

  function statesOf(curve) {
    const count = data.variables.length, states = [];
    for (let i = 0; i < curve.polyline.length; i += count)
      states.push(Array.from(curve.polyline.slice(i, i + count)));
    return states;
  }

  function tipOf(values) {
    const pose = kinematics.poses(kinematics.whole(values))[data.tree.links.indexOf(data.tip)];
    return new THREE.Vector3().setFromMatrixPosition(pose);
  }

  function wayOf(states) {
    const points = [tipOf(states[0])];
    for (let i = 1; i < states.length; ++i)
      for (let k = 1; k <= kSteps; ++k) points.push(tipOf(kinematics.between(states[i - 1], states[i], k / kSteps)));
    return points;
  }

  // Pairs of points: the dashes of a line, by its length.
  function dashesOf(points, dash, gap) {
    const found = [];
    let along = 0; // m, since a dash began
    for (let i = 1; i < points.length; ++i) {
      const length = points[i].distanceTo(points[i - 1]);
      for (let at = 0; at < length;) {
        const inDash = along < dash, step = Math.min(length - at, (inDash ? dash : dash + gap) - along);
        const on = (way) => points[i - 1].clone().lerp(points[i], way / length);
        if (inDash) found.push([on(at), on(at + step)]);
        at += step;
        along = along + step < (dash + gap) * (1 - 1e-9) ? along + step : 0;
        if (step < 1e-12) break;
      }
    }
    return found;
  }

  function groupOf(curve, size) {
    const group = new THREE.Group(), states = statesOf(curve);
    const positions = [];
    for (const [a, b] of dashesOf(wayOf(states), kDash * size, kGap * size))
      swept.overlays.addRod(positions, [], a, b, 0.0017 * size, [0, 0, 0]);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    group.add(new THREE.Mesh(geometry, material));
    for (const state of states) {
      const dot = new THREE.Mesh(new THREE.SphereBufferGeometry(0.0055 * size, 16, 12), material);
      dot.position.copy(tipOf(state));
      group.add(dot);
    }
    group.traverse((object) => { object.raycast = () => {}; });
    return group;
  }

  // Those of the trajectory that is shown.
  function usePath() {
    groups.forEach((group, path) => { if (group !== null) group.visible = path === data.path; });
    scene.changed();
  }

  function paint() {
    if (material !== null) material.color.copy(scene.colour('way'));
  }

  function build(size) {
    if (!data.isTimed || data.tipIndex < 0) return;
    material = new THREE.MeshBasicMaterial({side: THREE.DoubleSide});
    for (const motion of data.allMotions) {
      const group = motion.curve.polyline.length === 0 ? null : groupOf(motion.curve, size);
      groups.push(group);
      if (group !== null) scene.scene.add(group);
    }
    paint();
    usePath();
  }

  return {build, usePath, paint, groups};
})();
