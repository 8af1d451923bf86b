// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef SWEPT_HAS_FCL

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "bench/fcl_shapes.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept::benchmark {

/// The checked pairs of links of a robot in FCL, meshes as BVHModel<OBBRSS>. Kinematics are those
/// of our exact tier, which place moving bodies alone. For one thread.
class FclSelf {
 public:
  explicit FclSelf(const Checker& checker)
      : checker_(checker),
        model_(detail::compileKinematics(checker.robot(), checker.group(), referenceOf(checker))),
        motion_(model_.bodies.size()),
        states_(model_.bodies.size()) {
    addObjects();
    const std::size_t count = objects_.size();
    wanted_.assign(count * count, 0);
    for (const auto& [a, b] : pairs_) wanted_[a * count + b] = wanted_[b * count + a] = 1;
    place(std::vector<double>(static_cast<std::size_t>(checker.dimension()), 0.0));
    std::vector<fcl::CollisionObjectd*> all;
    for (const Object& object : objects_) all.push_back(object.object.get());
    manager_.registerObjects(all);
    manager_.setup();
  }
  FclSelf(const FclSelf&) = delete;
  FclSelf& operator=(const FclSelf&) = delete;

  /// Poses and boxes of all objects. False for a state outside the limits of a sliding joint.
  bool place(std::span<const double> q) {
    for (std::size_t i = 1; i < model_.bodies.size(); ++i) {
      if (!detail::compileJoint(model_, model_.bodies[i], q, q, motion_[i])) return false;
      detail::evaluateBody(model_, motion_, 0.0, static_cast<int>(i), states_);
    }
    for (Object& object : objects_) {
      object.object->setTransform(states_[object.body].world_from_body * object.body_from_shape);
      object.object->computeAABB();
    }
    return true;
  }

  /// Placed before: each pair in turn, boxes first, up to the first contact.
  bool collidesInTurn() {
    fcl::CollisionResultd result;
    for (const auto& [a, b] : pairs_) {
      fcl::CollisionObjectd& first = *objects_[a].object;
      fcl::CollisionObjectd& second = *objects_[b].object;
      if (!first.getAABB().overlap(second.getAABB())) continue;
      if (fcl::collide(&first, &second, request_, result) > 0) return true;
    }
    return false;
  }

  /// Placed before: pairs as the tree finds them, up to the first contact.
  bool collidesByTree() {
    manager_.update();
    Query query{.robot = this, .result = {}};
    manager_.collide(&query, callback);
    return query.hit;
  }

  /// Placed before: two links.
  bool collides(int linkA, int linkB) const {
    return anyOf(linkA, linkB, [&](auto& a, auto& b) {
      fcl::CollisionResultd result;
      return fcl::collide(&a, &b, request_, result) > 0;
    });
  }
  /// m; of surfaces, where they are meshes. At most 0 in contact.
  double distance(int linkA, int linkB) const {
    double least = std::numeric_limits<double>::infinity();
    anyOf(linkA, linkB, [&](auto& a, auto& b) {
      fcl::DistanceResultd result;
      fcl::distance(&a, &b, fcl::DistanceRequestd(), result);
      least = std::min(least, result.min_distance);
      return false;
    });
    return least;
  }
  /// As placed.
  Eigen::Isometry3d poseOfLink(int link) const {
    return states_[model_.bodyOfLink[link]].world_from_body * model_.body_from_link[link];
  }

 private:
  struct Object {
    int link;
    int body;
    Eigen::Isometry3d body_from_shape;
    std::unique_ptr<fcl::CollisionObjectd> object;
  };
  struct Query {
    const FclSelf* robot;
    fcl::CollisionResultd result;
    bool hit = false;
  };

  static Eigen::VectorXd referenceOf(const Checker& checker) {
    return checker.options().reference.value_or(checker.robot().defaultState());
  }

  /// Of the links that are in a checked pair.
  void addObjects() {
    const Robot& robot = checker_.robot();
    std::vector<std::pair<int, int>> links;
    for (const Checker::Pair& pair : checker_.checkedPairs())
      links.emplace_back(*robot.findLink(pair.bodyA), *robot.findLink(pair.bodyB));
    for (int i = 0; i < static_cast<int>(robot.links().size()); ++i) {
      if (std::ranges::none_of(links, [&](const auto& p) { return p.first == i || p.second == i; }))
        continue;
      for (const CollisionGeometry& part : robot.links()[i].collision) {
        auto object =
            std::make_unique<fcl::CollisionObjectd>(fclGeometry(part.shape, robot.links()[i].name));
        // NOLINTNEXTLINE(performance-no-int-to-ptr): FCL keeps it, and does not look there.
        object->setUserData(reinterpret_cast<void*>(objects_.size()));
        objects_.push_back({i, model_.bodyOfLink[i],
                            model_.body_from_link[i] * part.link_from_shape, std::move(object)});
      }
    }
    for (const auto& [linkA, linkB] : links)
      for (std::size_t a = 0; a < objects_.size(); ++a)
        for (std::size_t b = 0; b < objects_.size(); ++b)
          if (objects_[a].link == linkA && objects_[b].link == linkB) pairs_.emplace_back(a, b);
  }

  static std::uintptr_t indexOf(const fcl::CollisionObjectd* object) {
    return reinterpret_cast<std::uintptr_t>(object->getUserData());
  }
  static bool callback(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
    auto& query = *static_cast<Query*>(data);
    const FclSelf& robot = *query.robot;
    if (!robot.wanted_[indexOf(a) * robot.objects_.size() + indexOf(b)]) return false;
    query.hit = fcl::collide(a, b, robot.request_, query.result) > 0;
    return query.hit;
  }

  template <typename Test>
  bool anyOf(int linkA, int linkB, const Test& test) const {
    for (const auto& [a, b] : pairs_)
      if (objects_[a].link == linkA && objects_[b].link == linkB &&
          test(*objects_[a].object, *objects_[b].object))
        return true;
    return false;
  }

  const Checker& checker_;
  detail::KinematicModel model_;
  std::vector<detail::JointMotion> motion_;
  std::vector<detail::BodyState> states_;
  std::vector<Object> objects_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;  ///< into objects_
  std::vector<char> wanted_;                                ///< by two indices into objects_
  fcl::DynamicAABBTreeCollisionManagerd manager_;
  fcl::CollisionRequestd request_{1, false};
};

}  // namespace swept::benchmark
#endif
