// SPDX-License-Identifier: BSD-3-Clause
// Light, bodies and their poses, themes, and what is under a pixel.
'use strict';

swept.scene = (function () {
  const data = swept.data;
  const canvas = document.getElementById('view');
  const scene = new THREE.Scene();
  const camera = new THREE.PerspectiveCamera(38, 1, 0.01, 100);
  camera.up.set(0, 0, 1);
  let renderer = null, controls = null, needed = true;
  const links = data.frames.links.map(() => new THREE.Group());
  // Per body of the data: {group, meshes: of what is proven, visuals: of what it looks like, shown:
  // of these two, materials, own: its colour, name: of the theme's colour where it has none}.
  const bodies = [];
  const moved = new Set(); // indices of bodies of the world that are not where the data has them
  const loose = []; // {mesh, body}: visuals of links without a body, which follow this one
  let looks = false; // visuals are shown
  const bounds = new THREE.Box3();
  const ground = {}, light = {};
  const changed = () => { needed = true; };

  function colour(name) {
    return new THREE.Color(getComputedStyle(document.documentElement)
                               .getPropertyValue('--' + name).trim());
  }
  function colourOf(body, index) {
    if (body.kind === 'attached' || body.kind === 'drawing') return 'held';
    if (body.kind === 'link') return index % 2 === 0 ? 'link-a' : 'link-b';
    return body.parts.some((p) => data.geometries[p.geometry].kind === 'balls') ? 'balls' : 'world';
  }

  function place(object, numbers, at) {
    object.position.set(numbers[at], numbers[at + 1], numbers[at + 2]);
    object.quaternion.set(numbers[at + 3], numbers[at + 4], numbers[at + 5], numbers[at + 6]);
  }

  // Thin lines along the edges of boxes: near faces of one colour stay apart.
  function addEdges(mesh) {
    const lines = new THREE.LineSegments(
        new THREE.EdgesGeometry(mesh.geometry),
        new THREE.LineBasicMaterial({color: 0x1b2736, transparent: true, opacity: 0.28}));
    lines.raycast = () => {};
    mesh.add(lines);
  }

  function addBody(body, index) {
    const single = new THREE.MeshStandardMaterial(
        {roughness: 0.62, metalness: 0.08, side: THREE.DoubleSide});
    const many = single.clone(); // three.js r111 cannot share one between meshes and instances
    const thin = single.clone();
    Object.assign(thin, {transparent: true, opacity: 0.3, depthWrite: false});
    if (body.opacity !== undefined)
      for (const material of [single, many])
        Object.assign(material, {transparent: true, opacity: body.opacity, depthWrite: false});
    const group = new THREE.Group(), meshes = [];
    for (const part of body.parts) {
      const balls = data.geometries[part.geometry].kind === 'balls';
      const sheet = swept.geometry.isSheet(part.geometry);
      const mesh = swept.geometry.part(part.geometry, balls ? many : sheet ? thin : single);
      place(mesh, data.floats(part.pose), 0);
      mesh.userData.body = index;
      mesh.castShadow = !sheet && body.kind !== 'drawing';
      mesh.receiveShadow = true;
      if (body.kind === 'world' && data.geometries[part.geometry].kind === 'box') addEdges(mesh);
      group.add(mesh);
      meshes.push(mesh);
    }
    (body.frame === null ? scene : links[body.frame]).add(group);
    bodies.push({group, meshes, visuals: [], shown: meshes, materials: [single, many, thin],
                 own: body.colour, name: colourOf(body, index)});
  }

  // A mesh of what a body looks like, or a link that has none (`about.checked` false).
  function addVisual(mesh, about) {
    mesh.userData.about = about;
    if (about.checked) {
      bodies[about.body].group.add(mesh);
      bodies[about.body].visuals.push(mesh);
    } else {
      links[about.frame].add(mesh);
      loose.push(mesh);
    }
  }
  function showLoose() {
    for (const mesh of loose) {
      const about = mesh.userData.about;
      const follows = about.body < 0 || bodies[about.body].group.visible;
      mesh.visible = looks && follows && about.opacity > 0;
    }
  }
  // Links that look like nothing are shown as proven.
  function showVisuals(on) {
    looks = on;
    for (const body of bodies) {
      const visual = on && body.visuals.length > 0;
      body.shown = visual ? body.visuals.filter((mesh) => mesh.userData.about.opacity > 0) : body.meshes;
      body.meshes.forEach((mesh) => { mesh.visible = !visual; });
      body.visuals.forEach((mesh) => { mesh.visible = body.shown.includes(mesh); });
    }
    showLoose();
    renderer.shadowMap.needsUpdate = true;
    changed();
  }

  // What the camera should see, as it stands: all that is shown but planes and half-spaces.
  function measure() {
    const box = new THREE.Box3();
    scene.updateMatrixWorld(true);
    const visuals = loose.concat(...bodies.filter((b) => b.group.visible).map((b) => b.visuals));
    for (const mesh of visuals) if (mesh.visible) box.expandByObject(mesh);
    data.bodies.forEach((body, b) => body.parts.forEach((part, i) => {
      const shape = data.geometries[part.geometry];
      if (swept.geometry.isSheet(part.geometry) || !bodies[b].group.visible) return;
      const mesh = bodies[b].meshes[i];
      if (!mesh.visible) return;
      if (shape.kind !== 'balls') {
        box.expandByObject(mesh);
        return;
      }
      const numbers = data.floats(shape.balls), point = new THREE.Vector3();
      for (let k = 0; k < numbers.length; k += 4) {
        point.set(numbers[k], numbers[k + 1], numbers[k + 2]).applyMatrix4(mesh.matrixWorld);
        box.expandByPoint(point);
      }
    }));
    if (box.isEmpty()) box.set(new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1));
    return box;
  }

  function addLights(middle, size) {
    scene.add(new THREE.HemisphereLight(0xffffff, 0xb4bcc8, 0.66));
    const sun = new THREE.DirectionalLight(0xffffff, 0.42);
    sun.position.copy(middle).add(new THREE.Vector3(-0.55, -0.7, 1.6).multiplyScalar(size));
    sun.target.position.copy(middle);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.bias = -0.0006;
    sun.shadow.radius = 3;
    const reach = 0.9 * size;
    Object.assign(sun.shadow.camera,
                  {left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1, far: 5 * size});
    // What faces the viewer is never dark.
    const lamp = new THREE.DirectionalLight(0xffffff, 0.26);
    lamp.position.set(0.3, 0.2, 1);
    camera.add(lamp, lamp.target);
    light.sun = sun;
    scene.add(sun, sun.target, camera);
  }

  function addGround(middle, size) {
    ground.shadow = new THREE.Mesh(new THREE.PlaneBufferGeometry(8 * size, 8 * size),
                                   new THREE.ShadowMaterial({opacity: 0.16}));
    ground.shadow.position.set(middle.x, middle.y, bounds.min.z - 0.002);
    ground.shadow.receiveShadow = true;
    const cell = size > 6 ? 1 : 0.25;
    const count = 2 * Math.ceil(1.6 * size / cell);
    ground.grid = new THREE.GridHelper(count * cell, count);
    ground.grid.rotation.x = Math.PI / 2;
    ground.grid.position.set(Math.round(middle.x / cell) * cell, Math.round(middle.y / cell) * cell,
                             bounds.min.z - 0.003);
    ground.grid.material.vertexColors = THREE.NoColors;
    scene.add(ground.shadow, ground.grid);
  }

  function start() {
    renderer = new THREE.WebGLRenderer({canvas: canvas, antialias: true});
    renderer.setPixelRatio(Math.min(2, window.devicePixelRatio));
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    renderer.shadowMap.autoUpdate = false; // only when something moved, not for every view
    controls = new THREE.OrbitControls(camera, canvas);
    controls.enableKeys = false; // arrows move time
    controls.screenSpacePanning = true;
    controls.addEventListener('change', changed);
  }

  // At a frame, whose fraction is on the way to the next one.
  function pose(frame) {
    const first = Math.min(Math.floor(frame), data.frames.count - 1);
    const second = Math.min(first + 1, data.frames.count - 1);
    const share = frame - first;
    const other = {position: new THREE.Vector3(), quaternion: new THREE.Quaternion()};
    links.forEach((group, link) => {
      place(group, data.poses, data.poseAt(first, link));
      if (share === 0) return;
      place(other, data.poses, data.poseAt(second, link));
      group.position.lerp(other.position, share);
      group.quaternion.slerp(other.quaternion, share);
    });
    renderer.shadowMap.needsUpdate = true;
    changed();
  }

  // Bodies of the world that move, at a time of their clock: between two poses straight and by
  // slerp, before the first and after the last where that is.
  function poseMoving(clock) {
    const other = {position: new THREE.Vector3(), quaternion: new THREE.Quaternion()};
    data.bodies.forEach((body, b) => {
      if (!body.motion) return;
      const {times, poses} = body.motion, group = bodies[b].group;
      let next = 0;
      while (next < times.length && times[next] <= clock) ++next;
      place(group, poses, 7 * Math.max(0, next - 1));
      if (next === 0 || next === times.length) return;
      place(other, poses, 7 * next);
      const share = (clock - times[next - 1]) / (times[next] - times[next - 1]);
      group.position.lerp(other.position, share);
      group.quaternion.slerp(other.quaternion, share);
    });
    renderer.shadowMap.needsUpdate = true;
    changed();
  }

  // As poses of all links of the tree say.
  function poseLinks(poses) {
    const scale = new THREE.Vector3();
    data.frames.links.forEach((name, link) => {
      const group = links[link];
      poses[data.tree.links.indexOf(name)].decompose(group.position, group.quaternion, scale);
    });
    renderer.shadowMap.needsUpdate = true;
    changed();
  }

  function setVisible(body, on) {
    bodies[body].group.visible = on;
    showLoose();
    renderer.shadowMap.needsUpdate = true;
    changed();
  }

  // A body of the world by a motion of the model frame from where the data has it; null: back there.
  function moveBody(body, motion) {
    const group = bodies[body].group;
    group.position.copy(motion ? motion.position : new THREE.Vector3());
    group.quaternion.copy(motion ? motion.quaternion : new THREE.Quaternion());
    if (motion) moved.add(body);
    else moved.delete(body);
    renderer.shadowMap.needsUpdate = true;
    changed();
  }

  function setShadows(on) {
    light.sun.castShadow = on;
    renderer.shadowMap.needsUpdate = true;
    changed();
  }

  function paint() {
    scene.background = colour('stage');
    highlight(-1, -1);
    if (ground.grid) ground.grid.material.color.copy(colour('grid'));
    changed();
  }

  function highlight(picked, partner) {
    bodies.forEach((body, b) => {
      const share = b === picked ? 0.85 : b === partner ? 0.45 : 0;
      const tinted = (own) => (own ? new THREE.Color(own) : colour(body.name)).lerp(colour('pick'), share);
      const tint = tinted(body.own);
      body.materials.forEach((material) => material.color.copy(tint));
      body.visuals.forEach((mesh) => mesh.material.color.copy(tinted(mesh.userData.about.colour)));
    });
    for (const mesh of loose)
      mesh.material.color.copy(mesh.userData.about.colour ? new THREE.Color(mesh.userData.about.colour) : colour('link-b'));
    changed();
  }

  function seeThrough(on) {
    data.bodies.forEach((body, b) => {
      if (body.kind !== 'world') return;
      for (const material of bodies[b].materials.slice(0, 2)) // but for what is thin anyway
        Object.assign(material, {transparent: on, opacity: on ? 0.25 : 1, depthWrite: !on});
      bodies[b].meshes.forEach((mesh, i) => {
        mesh.castShadow = !on && !swept.geometry.isSheet(body.parts[i].geometry);
      });
    });
    renderer.shadowMap.needsUpdate = true;
    changed();
  }

  function firstHit(at) {
    const caster = new THREE.Raycaster();
    caster.setFromCamera(at, camera);
    const meshes = loose.filter((mesh) => mesh.visible)
        .concat(...bodies.filter((b) => b.group.visible).map((b) => b.shown));
    const hits = caster.intersectObjects(meshes).sort((a, b) => a.distance - b.distance);
    return hits.length > 0 ? {...hits[0].object.userData, point: hits[0].point} : {body: -1};
  }

  // What is at a pixel of the canvas: {body: its index; -1: none, or a link that is not checked,
  // whose name is `link`; point: where, in the model frame}.
  function hitAt(x, y) {
    return firstHit(
        new THREE.Vector2(2 * x / canvas.clientWidth - 1, 1 - 2 * y / canvas.clientHeight));
  }

  // Whether one of the bodies of a contact is what the camera sees at it.
  function isSeen(contact) {
    scene.updateMatrixWorld(true);
    const middle = new THREE.Vector3().fromArray(contact.point_a)
                       .add(new THREE.Vector3().fromArray(contact.point_b)).multiplyScalar(0.5);
    const at = middle.project(camera), hit = firstHit(new THREE.Vector2(at.x, at.y)).body;
    return hit >= 0 && [contact.body_a, contact.body_b].includes(data.bodies[hit].name);
  }

  // Where a point (m, model frame) is on the canvas, in pixels.
  function project(point) {
    const p = point.clone().project(camera);
    return {x: (p.x + 1) / 2 * canvas.clientWidth, y: (1 - p.y) / 2 * canvas.clientHeight};
  }

  function fit() {
    const width = canvas.parentElement.clientWidth, height = canvas.parentElement.clientHeight;
    camera.aspect = width / Math.max(1, height);
    camera.updateProjectionMatrix();
    renderer.setSize(width, height, false);
    canvas.dataset.fitted = 'yes';
    changed();
  }

  // Draws when something changed, or when it must; true if it did.
  function draw(must) {
    if (!needed && !must) return false;
    needed = false;
    renderer.render(scene, camera);
    return true;
  }

  function build() {
    start();
    links.forEach((group) => scene.add(group));
    data.bodies.forEach(addBody);
    pose(0);
    if (data.moving.length > 0) poseMoving(data.clockAt(0));
    bounds.copy(measure());
    const middle = bounds.getCenter(new THREE.Vector3());
    const size = bounds.getSize(new THREE.Vector3()).length();
    addLights(middle, size);
    if (!data.geometries.some((g, i) => swept.geometry.isSheet(i))) addGround(middle, size);
    paint();
    fit();
    return size;
  }

  return {build, draw, pose, poseLinks, poseMoving, paint, highlight, seeThrough, setVisible, setShadows, addVisual,
          showVisuals, moveBody, isMoved: () => moved.size > 0, hitAt, bodyAt: (x, y) => hitAt(x, y).body, isSeen, project, fit, place, colour, changed, scene, links, bodies, canvas, camera,
          controls: () => controls, wholeBounds: () => bounds, shownBounds: measure,
          size: () => bounds.getSize(new THREE.Vector3()).length()};
})();
