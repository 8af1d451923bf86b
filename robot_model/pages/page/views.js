// SPDX-License-Identifier: BSD-3-Clause
// Where the camera is; pictures of what it sees; addresses that lead back to a view.
'use strict';

swept.views = (function () {
  const data = swept.data, scene = swept.scene, camera = scene.camera, playback = swept.playback;
  const byId = (id) => document.getElementById(id);
  // From where the camera looks; x is ahead of a robot, z up.
  const directions = {
    front: [1, 0, 0], side: [0, -1, 0], top: [0, -1e-4, 1], isometric: [-1, -1, 0.816],
    first: [-0.62, -1, 0.5]
  };

  // All of a box is within the picture, but for a rim.
  function sees(box) {
    camera.updateMatrixWorld(true);
    const corner = new THREE.Vector3();
    for (let i = 0; i < 8; ++i) {
      corner.set(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                 i & 4 ? box.max.z : box.min.z).project(camera);
      if (Math.max(Math.abs(corner.x), Math.abs(corner.y)) > 1) return false;
    }
    return true;
  }

  // As near as shows all of a box.
  function look(from, box) {
    const middle = box.getCenter(new THREE.Vector3());
    const radius = Math.max(1e-3, 0.5 * box.getSize(new THREE.Vector3()).length());
    const away = new THREE.Vector3().fromArray(from).normalize();
    for (let distance = 1.2 * radius; distance < 20 * radius; distance *= 1.03) {
      camera.position.copy(middle).addScaledVector(away, distance);
      aim(middle);
      if (sees(box)) break;
    }
  }

  function aim(target) {
    const distance = camera.position.distanceTo(target);
    camera.near = Math.max(0.005, distance / 200);
    camera.far = distance + 20 * scene.size();
    camera.updateProjectionMatrix();
    scene.controls().target.copy(target);
    scene.controls().update();
    scene.changed();
  }

  const reset = () => look(directions.first, scene.wholeBounds());
  const preset = (name) => look(directions[name], scene.shownBounds());
  const fit = () => look(
      camera.position.clone().sub(scene.controls().target).toArray(), scene.shownBounds());

  // Near to contacts, from a side on which nothing else hides them.
  function focus(contacts) {
    const points = [].concat(...contacts.map((c) => [c.point_a, c.point_b]));
    const box = new THREE.Box3();
    for (const point of points) box.expandByPoint(new THREE.Vector3().fromArray(point));
    box.expandByScalar(0.16 * Math.min(4, scene.size()));
    let best = null;
    for (let i = 0; i < 12; ++i) {
      const angle = Math.atan2(-1, -0.62) + (i % 2 ? 1 : -1) * Math.ceil(i / 2) * Math.PI / 6;
      const from = [Math.cos(angle), Math.sin(angle), 0.45];
      look(from, box);
      const clear = contacts.filter((contact) => scene.isSeen(contact)).length;
      if (best === null || clear > best.clear) best = {clear: clear, from: from};
    }
    look(best.from, box);
  }

  function saved() {
    const target = scene.controls().target;
    return camera.position.toArray().concat(target.toArray()).map((v) => Number(v.toFixed(4))).join(',');
  }

  function restore(text) {
    const numbers = text.split(',').map(Number);
    if (numbers.length !== 6 || !numbers.every(Number.isFinite)) return;
    const position = new THREE.Vector3().fromArray(numbers);
    const target = new THREE.Vector3().fromArray(numbers, 3);
    if (position.distanceTo(target) < 1e-6) return;
    camera.position.copy(position);
    aim(target);
  }

  // The picture without page around it; labels of contacts as they are on the page.
  function drawn() {
    scene.draw(true);
    swept.overlays.placeLabels();
    const sheet = document.createElement('canvas');
    sheet.width = scene.canvas.width;
    sheet.height = scene.canvas.height;
    const pen = sheet.getContext('2d');
    const scale = sheet.width / Math.max(1, scene.canvas.clientWidth);
    pen.drawImage(scene.canvas, 0, 0);
    pen.font = 12 * scale + 'px sans-serif';
    pen.textBaseline = 'middle';
    for (const label of document.querySelectorAll('.contact-label')) {
      const x = parseFloat(label.style.left) * scale + 12 * scale, y = parseFloat(label.style.top) * scale;
      pen.fillStyle = '#c1272d';
      pen.fillRect(x, y - 9 * scale, pen.measureText(label.textContent).width + 14 * scale, 18 * scale);
      pen.fillStyle = '#ffffff';
      pen.fillText(label.textContent, x + 7 * scale, y);
    }
    return sheet;
  }

  function savePicture() {
    drawn().toBlob((blob) => {
      const link = document.createElement('a');
      link.href = URL.createObjectURL(blob);
      link.download = document.title.replace(/[^\w.-]+/g, '-') + '.png';
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
      swept.notice('saved as ' + link.download);
    }, 'image/png');
  }

  // What follows # in an address: the moment, the camera, and what else is not as it is at first.
  function fragment() {
    const parts = ['t=' + Number((playback.state.time / Math.max(1e-9, data.duration)).toFixed(5))];
    if (playback.state.values) parts.push('q=' + playback.state.values.map((v) => Number(v.toFixed(6))).join(','));
    if (data.path > 0) parts.push('path=' + (data.path + 1));
    if (byId('view').hidden) return '#' + parts.join('&');
    parts.push('view=' + saved());
    const hidden = swept.bodies.hidden().join(',');
    if (hidden !== '') parts.push('hide=' + hidden);
    if (swept.looks.on()) parts.push('look=visual');
    if (swept.pace.chosen() !== null) parts.push('shadows=' + (swept.pace.chosen() ? 'on' : 'off'));
    return '#' + parts.join('&');
  }

  function link() {
    window.history.replaceState(null, '', fragment());
    const said = 'the address of this page now leads to this view';
    const copied = navigator.clipboard ? navigator.clipboard.writeText(window.location.href)
                                       : Promise.reject(new Error('no clipboard'));
    copied.then(() => swept.notice(said + '; it is in the clipboard'), () => swept.notice(said));
  }

  function restoreValues(text) {
    const values = text.split(',').map(Number);
    if (values.length === data.tree.variables.length && values.every(Number.isFinite))
      playback.setValues(values);
  }

  // Shows what an address asks for; true if that says where the camera is, or when.
  function open(hash, picture) {
    const asked = new URLSearchParams(hash.replace(/^#/, ''));
    const path = Number(asked.get('path'));
    if (path >= 1 && path <= data.paths.length) swept.paths.show(path - 1);
    const share = Number(asked.get('t'));
    if (asked.has('t') && Number.isFinite(share)) playback.setTime(share * data.duration);
    if (asked.has('q')) restoreValues(asked.get('q'));
    if (!picture) return asked.has('t');
    if (asked.has('shadows')) swept.pace.choose(asked.get('shadows') !== 'off');
    if (asked.has('look')) swept.looks.choose(asked.get('look') === 'visual');
    if (asked.has('hide')) swept.bodies.hide(asked.get('hide').split(',').filter((i) => i !== '').map(Number));
    if (asked.has('view')) restore(asked.get('view'));
    return asked.has('t') || asked.has('view');
  }

  return {reset, preset, fit, focus, link, open, savePicture, drawn, fragment, saved, restore};
})();
