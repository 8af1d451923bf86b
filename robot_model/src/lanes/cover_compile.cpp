// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/cover_compile.hpp"

#include <algorithm>
#include <limits>

#include "certify/checker_model.hpp"
#include "lanes/lane_model.hpp"
#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

class CoverCompiler {
 public:
  CoverCompiler(const CheckerModel& model, const LaneModel* like, LaneModel& lanes)
      : model_(model), like_(like), lanes_(lanes) {}

  void compile() {
    const std::size_t bodies = model_.kinematics.bodies.size();
    std::vector<std::vector<int>> geometriesOf(bodies);
    for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
      const RobotGeometry& geometry = model_.robotGeometry[i];
      geometriesOf[geometry.body].push_back(static_cast<int>(i));
      lanes_.geometryBody.push_back(geometry.body);
      lanes_.reach = std::max(lanes_.reach, static_cast<float>(geometry.levers.reach) * 1.00001F);
    }
    lanes_.rootOfGeometry.assign(model_.robotGeometry.size(), -1);
    lanes_.rootOfBody.assign(bodies, -1);
    for (std::size_t body = 0; body < bodies; ++body) addBodyCover(body, geometriesOf[body]);
    for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
      addInnerBalls(static_cast<int>(i));
      addProbes(static_cast<int>(i));
    }
    addHulls();
  }

 private:
  void addBodyCover(std::size_t body, const std::vector<int>& geometries) {
    if (geometries.empty()) return;
    const auto first = static_cast<std::int32_t>(lanes_.nodes.size());
    lanes_.rootOfBody[body] = first;
    if (geometries.size() == 1) {
      lanes_.nodes.emplace_back();
      addTree(geometries.front(), first);
      return;
    }
    lanes_.nodes.resize(lanes_.nodes.size() + 1 + geometries.size());
    for (std::size_t i = 0; i < geometries.size(); ++i)
      addTree(geometries[i], first + 1 + static_cast<std::int32_t>(i));
    LaneNode& root = lanes_.nodes[first];
    root = ballAround(first + 1, static_cast<int>(geometries.size()));
    root.firstChild = first + 1;
    root.childCount = static_cast<std::int32_t>(geometries.size());
  }

  /// Contains the balls of consecutive nodes.
  LaneNode ballAround(std::int32_t first, int count) const {
    const auto centerOf = [&](int i) {
      const float(&c)[3] = lanes_.nodes[first + i].center;
      return Vector3d(c[0], c[1], c[2]);
    };
    // Steps towards the farthest ball, each shorter than the one before (Badoiu, Clarkson 2003).
    Vector3d center = centerOf(0);
    const auto farthest = [&](const Vector3d& from, int& which) {
      double most = -1.0;
      for (int i = 0; i < count; ++i) {
        const double reach = (centerOf(i) - from).norm() + lanes_.nodes[first + i].radius;
        if (!(reach > most)) continue;
        most = reach;
        which = i;
      }
      return most;
    };
    for (int step = 1; step <= 200; ++step) {
      int which = 0;
      farthest(center, which);
      center += (centerOf(which) - center) / (step + 1);
    }
    LaneNode node;
    for (int i = 0; i < 3; ++i) node.center[i] = static_cast<float>(center[i]);
    int which = 0;
    const Vector3d single(node.center[0], node.center[1], node.center[2]);
    node.radius = static_cast<float>(farthest(single, which)) * 1.000001F;
    node.beyond = node.radius;
    return node;
  }

  void addTree(int index, std::int32_t at) {
    const RobotGeometry& geometry = model_.robotGeometry[index];
    lanes_.rootOfGeometry[index] = at;
    if (geometry.cover == nullptr) {
      // Unbounded: never proven here.
      lanes_.nodes[at].geometry = index;
      lanes_.nodes[at].radius = lanes_.nodes[at].beyond = std::numeric_limits<float>::infinity();
      return;
    }
    const std::vector<SphereCover::Node>& cover = geometry.cover->nodes;
    const auto rest = static_cast<std::int32_t>(lanes_.nodes.size());
    lanes_.nodes.resize(lanes_.nodes.size() + cover.size() - 1);
    for (std::size_t i = 0; i < cover.size(); ++i) {
      const SphereCover::Node& node = cover[i];
      LaneNode& lane = lanes_.nodes[i == 0 ? at : rest + static_cast<std::int32_t>(i) - 1];
      setCenter(lane, geometry, node.ball.center);
      lane.radius = node.ball.radius;
      lane.inside = node.inside;
      lane.beyond = node.beyond;
      lane.firstChild = rest + node.firstChild - 1;
      lane.childCount = node.childCount;
      lane.geometry = index;
    }
  }

  void addInnerBalls(int index) {
    const RobotGeometry& geometry = model_.robotGeometry[index];
    lanes_.innerBalls.push_back({static_cast<std::int32_t>(lanes_.nodes.size()), 0});
    if (geometry.cover == nullptr) return;
    for (const CoverBall& ball : geometry.cover->inner) {
      LaneNode node;
      setCenter(node, geometry, ball.center);
      node.radius = node.inside = ball.radius;
      node.geometry = index;
      lanes_.nodes.push_back(node);
      ++lanes_.innerBalls.back().count;
    }
  }

  void addProbes(int index) {
    const LaneModel::InnerBalls& balls = lanes_.innerBalls[index];
    lanes_.probesOf.push_back({static_cast<std::int32_t>(lanes_.probes.size()), 0});
    for (std::int32_t i = 0; i < balls.count; i += kLanes) {
      LaneModel::Probes& eight = lanes_.probes.emplace_back();
      for (std::int32_t lane = 0; lane < kLanes; ++lane) {
        const LaneNode& node = lanes_.nodes[balls.first + std::min(i + lane, balls.count - 1)];
        eight.x.lane[lane] = node.center[0];
        eight.y.lane[lane] = node.center[1];
        eight.z.lane[lane] = node.center[2];
        eight.inside.lane[lane] = node.inside;
      }
      ++lanes_.probesOf.back().count;
    }
  }

  void addHulls() {
    if (like_ != nullptr) {
      lanes_.hulls = like_->hulls;
      return;
    }
    auto hulls = std::make_shared<LaneHulls>();
    for (const RobotGeometry& geometry : model_.robotGeometry)
      hulls->add(geometry.shape, geometry.body_from_shape, lanes_.bodyFromLane[geometry.body],
                 geometry.levers.arms);
    lanes_.hulls = std::move(hulls);
  }

  void setCenter(LaneNode& node, const RobotGeometry& geometry,
                 const Eigen::Vector3f& center) const {
    const Vector3d moved = lanes_.bodyFromLane[geometry.body].transpose() *
                           (geometry.body_from_shape * center.cast<double>());
    for (int k = 0; k < 3; ++k) node.center[k] = static_cast<float>(moved[k]);
  }

  const CheckerModel& model_;
  const LaneModel* like_;
  LaneModel& lanes_;
};

}  // namespace

void compileCovers(const CheckerModel& model, const LaneModel* like, LaneModel& lanes) {
  CoverCompiler(model, like, lanes).compile();
}

}  // namespace swept::detail
