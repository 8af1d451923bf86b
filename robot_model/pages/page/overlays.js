// SPDX-License-Identifier: BSD-3-Clause
// What is drawn over robot and world: the tip's trace, covers, the ends of the path, contacts.
'use strict';

swept.overlays = (function () {
  const data = swept.data, scene = swept.scene;
  let size = 1; // m, of what is shown
  const traces = []; // of each path, {mesh, radius}
  const covers = {meshes: [], material: null, balls: 0, finest: 0};
  const ends = {group: null, material: null};
  const beside = {group: null, motion: null}; // the robot where it is in contact off its curve
  const contacts = {group: new THREE.Group(), shown: []};

  const tipAt = (frame) => new THREE.Vector3().fromArray(
      data.poses, data.poseAt(frame, data.tipIndex));

  // The tip on a motion: at its frames, or on a curve as many times as often as it has pieces for.
  function wayOf(motion) {
    const often = motion.curve ? Math.min(8, Math.max(2, Math.ceil(2 * motion.curve.degrees.length / motion.steps))) : 1;
    const count = often * motion.steps, link = data.tree.links.indexOf(data.tip);
    const tipOn = (t) => new THREE.Vector3().setFromMatrixPosition(
        swept.kinematics.poses(swept.kinematics.whole(swept.kinematics.onMotion(motion, t)))[link]);
    return Array.from({length: count + 1}, (_, i) => (motion.curve ? tipOn(i / count) : tipAt(motion.first_frame + i)));
  }

  // A prism from a to b with its own colour.
  function addRod(positions, colours, a, b, radius, rgb) {
    const sides = 8;
    const along = b.clone().sub(a);
    if (along.length() < 1e-9) return;
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1),
                                                           along.normalize());
    const rim = [];
    for (let i = 0; i <= sides; ++i) {
      const angle = 2 * Math.PI * i / sides;
      rim.push(new THREE.Vector3(radius * Math.cos(angle), radius * Math.sin(angle), 0)
                   .applyQuaternion(turn));
    }
    for (let i = 0; i < sides; ++i)
      for (const [end, k] of [[a, i], [b, i], [b, i + 1], [a, i], [b, i + 1], [a, i + 1]]) {
        positions.push(end.x + rim[k].x, end.y + rim[k].y, end.z + rim[k].z);
        colours.push(rgb[0] / 255, rgb[1] / 255, rgb[2] / 255);
      }
  }

  // One path is coloured by its clearance; several have a colour each.
  function colourAt(motion, share) {
    const lower = motion.pieces.lower;
    if (data.paths.length < 2) return data.clearanceColour(lower[Math.floor(share * lower.length + 1e-9)]);
    return new THREE.Color(data.pathColour(motion.path)).toArray().map((c) => 255 * c);
  }

  function addTrace(path) {
    const positions = [], colours = [];
    for (const motion of data.allMotions.filter((m) => m.path === path)) {
      const way = wayOf(motion), count = way.length - 1;
      for (let i = 0; i < count; ++i)
        addRod(positions, colours, way[i], way[i + 1], 0.0028 * size, colourAt(motion, i / count));
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(positions, 3));
    geometry.setAttribute('color', new THREE.Float32BufferAttribute(colours, 3));
    const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial(
        {vertexColors: THREE.VertexColors, side: THREE.DoubleSide}));
    mesh.raycast = () => {};
    scene.scene.add(mesh);
    traces.push(mesh);
  }

  // The path that is shown stands out; the ends are its own.
  function usePath() {
    traces.forEach((mesh, path) => {
      const own = path === data.path;
      Object.assign(mesh.material, {transparent: !own, opacity: own ? 1 : 0.35, depthWrite: own});
    });
    swept.wayPoints.usePath();
    if (ends.group !== null) {
      const on = ends.group.visible;
      scene.scene.remove(ends.group);
      ends.group = null;
      if (on) showEnds(true);
    }
    scene.changed();
  }

  function addCovers() {
    covers.material = new THREE.MeshStandardMaterial(
        {transparent: true, opacity: 0.22, depthWrite: false, roughness: 0.5});
    data.bodies.forEach((body, b) => body.parts.forEach((part) => {
      if (part.cover === null) return;
      const cover = data.covers[part.cover], numbers = data.floats(cover.balls);
      const mesh = swept.geometry.balls(numbers, covers.material);
      scene.place(mesh, data.floats(part.pose), 0);
      mesh.visible = false;
      mesh.renderOrder = 1;
      scene.bodies[b].group.add(mesh);
      covers.meshes.push(mesh);
      covers.balls += numbers.length / 4;
      covers.finest += cover.finest;
    }));
  }

  function showCovers(on) {
    covers.meshes.forEach((mesh) => { mesh.visible = on; });
    scene.changed();
  }

  // The robot once more, faint; `place` puts a body where it is.
  function addGhost(group, material, place) {
    data.bodies.forEach((body, b) => {
      if (body.frame === null) return;
      const ghost = new THREE.Group();
      ghost.userData.body = b;
      place(ghost, body);
      for (const mesh of scene.bodies[b].shown) {
        const copy = new THREE.Mesh(mesh.geometry, material);
        copy.position.copy(mesh.position);
        copy.quaternion.copy(mesh.quaternion);
        ghost.add(copy);
      }
      group.add(ghost);
    });
  }
  const atFrame = (frame) => (ghost, body) => scene.place(ghost, data.poses, data.poseAt(frame, body.frame));
  function atValues(groupValues) {
    const poses = swept.kinematics.poses(swept.kinematics.whole(groupValues)), scale = new THREE.Vector3();
    return (ghost, body) => poses[data.tree.links.indexOf(data.frames.links[body.frame])]
        .decompose(ghost.position, ghost.quaternion, scale);
  }

  // The contact of a trajectory that is off its curve by what its tube allows; null: none.
  function showBeside(motion) {
    if (motion === beside.motion) return;
    if (beside.group !== null) scene.scene.remove(beside.group);
    Object.assign(beside, {group: null, motion: motion});
    scene.changed();
    if (motion === null) return;
    beside.group = new THREE.Group();
    const material = new THREE.MeshStandardMaterial(
        {transparent: true, opacity: 0.35, depthWrite: false, roughness: 0.8, color: scene.colour('bad')});
    addGhost(beside.group, material, atValues(motion.curve.contact.values));
    scene.scene.add(beside.group);
  }

  function showEnds(on) {
    if (!data.isPath) return;
    if (ends.group === null) {
      ends.group = new THREE.Group();
      ends.material = new THREE.MeshStandardMaterial(
          {transparent: true, opacity: 0.2, depthWrite: false, roughness: 0.8});
      addGhost(ends.group, ends.material, atFrame(data.firstFrame()));
      addGhost(ends.group, ends.material, atFrame(data.lastFrame()));
      scene.scene.add(ends.group);
      hideGhosts(scene.bodies.map((body) => body.group.visible));
      paint();
    }
    ends.group.visible = on;
    scene.changed();
  }

  function hideGhosts(shown) {
    if (ends.group === null) return;
    for (const ghost of ends.group.children) ghost.visible = shown[ghost.userData.body];
  }

  function addContact(contact) {
    const a = new THREE.Vector3().fromArray(contact.point_a);
    const b = new THREE.Vector3().fromArray(contact.point_b);
    const red = new THREE.MeshBasicMaterial({color: 0xe01b24, depthTest: false, transparent: true});
    for (const point of [a, b]) {
      const ball = new THREE.Mesh(new THREE.SphereBufferGeometry(0.006 * size, 20, 14), red);
      ball.position.copy(point);
      ball.renderOrder = 3;
      contacts.group.add(ball);
    }
    const line = new THREE.Line(
        new THREE.BufferGeometry().setFromPoints([a, b]),
        new THREE.LineBasicMaterial({color: 0xe01b24, depthTest: false, transparent: true}));
    line.renderOrder = 3;
    contacts.group.add(line);
    const label = document.createElement('span');
    label.className = 'contact-label';
    label.textContent = contact.body_a + ' – ' + contact.body_b;
    document.getElementById('contact-labels').append(label);
    contacts.shown.push({label: label, width: label.offsetWidth, middle: a.clone().add(b).multiplyScalar(0.5)});
  }

  // Those of one state, or of one motion.
  function showContacts(list) {
    contacts.shown.forEach((shown) => shown.label.remove());
    contacts.shown = [];
    while (contacts.group.children.length > 0) contacts.group.remove(contacts.group.children[0]);
    list.forEach(addContact);
    scene.changed();
  }

  function placeLabels() {
    for (const shown of contacts.shown) {
      const at = scene.project(shown.middle);
      // Not out of the picture: the label is 12 pixels to the right of its place.
      const most = scene.canvas.clientWidth - shown.width - 12;
      shown.label.style.left = (at.x < scene.canvas.clientWidth ? Math.min(at.x, most) : at.x) + 'px';
      shown.label.style.top = at.y + 'px';
    }
  }

  function paint() {
    covers.material.color.copy(scene.colour('cover'));
    if (ends.material) ends.material.color.copy(scene.colour('accent'));
    swept.wayPoints.paint();
    scene.changed();
  }

  function build(sceneSize) {
    size = Math.min(sceneSize, 4);
    if (data.isPath && data.tipIndex >= 0)
      for (let path = 0; path < Math.max(1, data.paths.length); ++path) addTrace(path);
    swept.wayPoints.build(size);
    usePath();
    addCovers();
    scene.scene.add(contacts.group);
    paint();
  }

  return {build, showCovers, showEnds, showContacts, showBeside, placeLabels, paint, usePath, addRod,
          hideGhosts, covers, traces, contacts};
})();
