// SPDX-License-Identifier: BSD-3-Clause
// Shapes as three.js draws them. Sizes in m, axes along z.
'use strict';

swept.geometry = (function () {
  const data = swept.data;
  const kCrease = Math.cos(35 * Math.PI / 180);
  const kSheet = 6; // m, edge of what stands for a plane
  const made = [];

  function cross(p, a, b, c, out) {
    const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
    const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
    out[0] = uy * vz - uz * vy;
    out[1] = uz * vx - ux * vz;
    out[2] = ux * vy - uy * vx;
  }

  // Unit normal of each triangle, and its length (twice the area) as weight.
  function faceNormals(positions, indices) {
    const count = indices.length / 3;
    const normals = new Float32Array(4 * count), n = [0, 0, 0];
    for (let f = 0; f < count; ++f) {
      cross(positions, 3 * indices[3 * f], 3 * indices[3 * f + 1], 3 * indices[3 * f + 2], n);
      const length = Math.hypot(n[0], n[1], n[2]);
      for (let k = 0; k < 3; ++k) normals[4 * f + k] = length > 0 ? n[k] / length : 0;
      normals[4 * f + 3] = length;
    }
    return normals;
  }

  function facesAround(vertexCount, indices) {
    const around = Array.from({length: vertexCount}, () => []);
    for (let i = 0; i < indices.length; ++i) around[indices[i]].push(Math.floor(i / 3));
    return around;
  }

  // Corners share their normal with the neighbours that lie almost in one plane: edges stay sharp
  // and what is round looks round.
  function creased(positions, indices) {
    const faces = faceNormals(positions, indices);
    const around = facesAround(positions.length / 3, indices);
    const corners = new Float32Array(3 * indices.length);
    const normals = new Float32Array(3 * indices.length);
    for (let i = 0; i < indices.length; ++i) {
      const own = 4 * Math.floor(i / 3), sum = [0, 0, 0];
      for (const f of around[indices[i]]) {
        const dot = faces[own] * faces[4 * f] + faces[own + 1] * faces[4 * f + 1] +
            faces[own + 2] * faces[4 * f + 2];
        if (dot < kCrease) continue;
        for (let k = 0; k < 3; ++k) sum[k] += faces[4 * f + k] * faces[4 * f + 3];
      }
      const length = Math.hypot(sum[0], sum[1], sum[2]) || 1;
      for (let k = 0; k < 3; ++k) {
        corners[3 * i + k] = positions[3 * indices[i] + k];
        normals[3 * i + k] = sum[k] / length;
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(corners, 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
    return geometry;
  }

  function triangles(shape) {
    const indices = shape.indices16 !== undefined ? data.uint16s(shape.indices16)
                                                  : data.uint32s(shape.indices32);
    return creased(data.floats(shape.positions), indices);
  }

  function capsule(radius, length) {
    const outline = [];
    for (let i = -12; i <= 12; ++i) {
      const angle = i / 12 * Math.PI / 2;
      const end = i < 0 ? -length / 2 : length / 2;
      if (i === 0) outline.push(new THREE.Vector2(radius, -length / 2));
      outline.push(new THREE.Vector2(Math.max(0, radius * Math.cos(angle)),
                                     end + radius * Math.sin(angle)));
    }
    return new THREE.LatheBufferGeometry(outline, 40).rotateX(Math.PI / 2);
  }

  function sheet(shape) {
    const normal = new THREE.Vector3().fromArray(shape.normal);
    const turn = new THREE.Quaternion().setFromUnitVectors(new THREE.Vector3(0, 0, 1), normal);
    const pose = new THREE.Matrix4().makeRotationFromQuaternion(turn);
    pose.setPosition(normal.multiplyScalar(shape.offset));
    return new THREE.PlaneBufferGeometry(kSheet, kSheet).applyMatrix(pose);
  }

  const makers = {
    'sphere': (s) => new THREE.SphereBufferGeometry(s.size[0], 40, 28),
    'box': (s) => new THREE.BoxBufferGeometry(s.size[0], s.size[1], s.size[2]),
    'cylinder': (s) => new THREE.CylinderBufferGeometry(s.size[0], s.size[0], s.size[1], 48)
                           .rotateX(Math.PI / 2),
    'capsule': (s) => capsule(s.size[0], s.size[1]),
    'cone': (s) => new THREE.ConeBufferGeometry(s.size[0], s.size[1], 48).rotateX(Math.PI / 2),
    'ellipsoid': (s) => new THREE.SphereBufferGeometry(1, 40, 28)
                            .scale(s.size[0], s.size[1], s.size[2]),
    'triangles': triangles,
    'plane': sheet,
    'half-space': sheet
  };

  // Balls are x, y, z, radius; one mesh for all of them.
  function balls(numbers, material) {
    const count = numbers.length / 4;
    const unit = new THREE.IcosahedronBufferGeometry(1, count > 40000 ? 0 : count > 1500 ? 1 : 2);
    const mesh = new THREE.InstancedMesh(unit, material, count);
    const pose = new THREE.Matrix4();
    for (let i = 0; i < count; ++i) {
      const r = numbers[4 * i + 3];
      pose.makeScale(r, r, r);
      pose.setPosition(numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2]);
      mesh.setMatrixAt(i, pose);
    }
    mesh.frustumCulled = false; // only one ball's bounds are known to three.js
    mesh.raycast = (caster, hits) => hitBalls(mesh, numbers, caster, hits);
    return mesh;
  }

  function hitBalls(mesh, numbers, caster, hits) {
    const toLocal = new THREE.Matrix4().getInverse(mesh.matrixWorld);
    const ray = caster.ray.clone().applyMatrix4(toLocal);
    const ball = new THREE.Sphere(), point = new THREE.Vector3();
    for (let i = 0; i < numbers.length; i += 4) {
      ball.center.set(numbers[i], numbers[i + 1], numbers[i + 2]);
      ball.radius = numbers[i + 3];
      if (!ray.intersectSphere(ball, point)) continue;
      const world = point.clone().applyMatrix4(mesh.matrixWorld);
      hits.push({distance: world.distanceTo(caster.ray.origin), point: world, object: mesh});
    }
  }

  // The mesh of one part of a body. Parts of the same geometry share it.
  function part(index, material) {
    const shape = data.geometries[index];
    if (shape.kind === 'balls') return balls(data.floats(shape.balls), material);
    if (made[index] === undefined) made[index] = makers[shape.kind](shape);
    return new THREE.Mesh(made[index], material);
  }

  return {part: part, balls: balls, isSheet: (i) => makers[data.geometries[i].kind] === sheet};
})();
