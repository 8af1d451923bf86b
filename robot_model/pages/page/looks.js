// SPDX-License-Identifier: BSD-3-Clause
// What the robot looks like, in place of the shapes that are proven. Nothing is known about it: a
// page opens with what is proven.
'use strict';

swept.looks = (function () {
  const data = swept.data, scene = swept.scene;
  const byId = (id) => document.getElementById(id);
  let on = false, built = false;

  // Index of the body of a link; without one, of the link that it hangs on, and so on. -1: none.
  function bodyOf(link) {
    const body = data.bodies.findIndex((b) => b.kind === 'link' && b.name === link);
    if (body >= 0) return body;
    const joint = data.tree.joints.find((j) => data.tree.links[j.child] === link);
    return joint === undefined || joint.parent === null ? -1 : bodyOf(data.tree.links[joint.parent]);
  }

  function addVisual(visual) {
    const link = data.frames.links[visual.frame], body = bodyOf(link);
    const material = new THREE.MeshStandardMaterial(
        {roughness: 0.55, metalness: 0.05, side: THREE.DoubleSide});
    if (visual.opacity < 1) Object.assign(material, {transparent: true, opacity: visual.opacity});
    const mesh = swept.geometry.part(visual.geometry, material);
    scene.place(mesh, data.floats(visual.pose), 0);
    mesh.castShadow = visual.opacity === 1;
    mesh.receiveShadow = true;
    mesh.visible = false;
    const checked = body >= 0 && data.bodies[body].name === link;
    mesh.userData = {body: checked ? body : -1, link: link};
    scene.addVisual(mesh, {colour: visual.colour, opacity: visual.opacity, frame: visual.frame,
                           body: body, checked: checked});
  }

  function note() {
    const missing = data.bodies.filter((body, b) => body.kind === 'link' && scene.bodies[b].visuals.length === 0);
    const as = missing.length === 0 ? '' : missing.length === 1 ? '; ' + missing[0].name + ' has no visual: it is shown as proven'
        : '; ' + missing.length + ' links have no visual: they are shown as proven';
    byId('look-note').hidden = !on;
    byId('look-note').textContent = 'this is what the robot looks like; what is proven is about its collision geometry' + as;
  }

  function choose(wanted) {
    if (data.visuals.length === 0) return;
    if (wanted && !built) { // a page that nobody asks for it does not take the time
      data.visuals.forEach(addVisual);
      built = true;
    }
    on = wanted;
    byId('tool-looks').setAttribute('aria-pressed', on);
    scene.showVisuals(on);
    swept.overlays.usePath(); // the ghosts of the ends
    swept.panel.pick(swept.panel.picked());
    note();
  }

  return {choose, toggle: () => choose(!on), on: () => on};
})();
