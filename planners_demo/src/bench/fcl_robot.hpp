// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bench/fcl_shapes.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// A robot in a world, as FCL objects: one per shape. Boolean queries of the checker's pairs, first
/// the world and then the robot with itself, up to the first contact. For one thread.
class FclRobot {
 public:
  explicit FclRobot(const Checker& checker);
  FclRobot(const FclRobot&) = delete;
  FclRobot& operator=(const FclRobot&) = delete;

  bool collides(std::span<const double> q);

 private:
  struct LinkObject {
    int link;
    Eigen::Isometry3d link_from_shape;
    std::unique_ptr<fcl::CollisionObjectd> object;
    std::vector<bool> checkedBodies;  ///< by index in the world
  };

  void addLinkObjects();
  void addWorld();
  void addPairs();
  Eigen::Isometry3d jointMotion(const Joint& joint) const;
  void placeLink(std::size_t joint);
  void placeObjects(bool all);
  static bool worldCallback(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* query);

  const Checker& checker_;
  Eigen::VectorXd values_;                 ///< of all variables
  std::vector<std::size_t> movingJoints_;  ///< whose child links the group moves
  std::vector<bool> moving_;               ///< by link
  std::vector<Eigen::Isometry3d> model_from_link_;
  std::vector<LinkObject> objects_;
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> worldObjects_;
  fcl::DynamicAABBTreeCollisionManagerd world_;
  std::vector<std::pair<std::size_t, std::size_t>> selfPairs_;  ///< into objects_
  fcl::CollisionRequestd request_{1, false};
};

}  // namespace swept
