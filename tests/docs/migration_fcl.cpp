// SPDX-License-Identifier: BSD-3-Clause
// What ompl_bridge/migration.md shows as FCL's way: it compiles, so that what it is compared with
// is real.
#include <fcl/fcl.h>

#include <memory>
#include <vector>

namespace swept::test {
namespace {

[[maybe_unused]] double twoShapes(const fcl::Transform3d& world_from_box,
                                  const fcl::Transform3d& world_from_ball) {
  const auto box = std::make_shared<fcl::Boxd>(0.2, 0.2, 0.4);
  const auto ball = std::make_shared<fcl::Sphered>(0.1);
  const fcl::CollisionObjectd a(box, world_from_box), b(ball, world_from_ball);

  fcl::CollisionResultd touching;
  fcl::collide(&a, &b, fcl::CollisionRequestd(), touching);
  const bool touch = touching.isCollision();
  fcl::DistanceRequestd signedDistance(false, true);
  fcl::DistanceResultd found;
  const double clearance = fcl::distance(&a, &b, signedDistance, found);

  return touch ? 0.0 : clearance;
}

[[maybe_unused]] void mesh(const std::vector<fcl::Vector3d>& vertices,
                           const std::vector<fcl::Triangle>& triangles) {
  fcl::BVHModel<fcl::OBBRSSd> model;
  model.beginModel();
  model.addSubModel(vertices, triangles);
  model.endModel();
}

[[maybe_unused]] bool firstContact(const fcl::CollisionObjectd& a, const fcl::CollisionObjectd& b,
                                   const fcl::Transform3d& goal) {
  fcl::ContinuousCollisionRequestd request;
  request.ccd_motion_type = fcl::CCDM_LINEAR;
  request.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;  // the default checks states
  fcl::ContinuousCollisionResultd result;
  fcl::continuousCollide(&a, goal, &b, b.getTransform(), request, result);
  const bool safe = !result.is_collide;

  return safe;
}

[[maybe_unused]] bool manyBodies(const std::vector<fcl::CollisionObjectd*>& objects,
                                 fcl::CollisionObjectd& moving) {
  fcl::DynamicAABBTreeCollisionManagerd manager;
  manager.registerObjects(objects);
  manager.setup();
  fcl::DefaultCollisionData<double> data;
  manager.collide(&moving, &data, fcl::DefaultCollisionFunction<double>);
  const bool hit = data.result.isCollision();

  return hit;
}

}  // namespace
}  // namespace swept::test
