// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/cover_compile.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "model/pair_model.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/meeting_rows.hpp"
#include "simd/compile/simd_model.hpp"
#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

class CoverCompiler {
 public:
  CoverCompiler(const PairModel& model, SimdModel& simd) : model_(model), simd_(simd) {}

  void compile() {
    const std::size_t bodies = model_.kinematics.bodies.size();
    std::vector<std::vector<int>> geometriesOf(bodies);
    for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
      const RobotGeometry& geometry = model_.robotGeometry[i];
      geometriesOf[geometry.body].push_back(static_cast<int>(i));
      geometryBody_.push_back(geometry.body);
      // The placement of a shape in its body rounds only in double.
      const LeverArms& levers = geometry.levers;
      const double span = std::max(levers.spanAtRest, kSingle * geometry.magnitude);
      simd_.reach = std::max(simd_.reach, static_cast<float>(span) * kReachOutward);
      simd_.farther = std::max(simd_.farther, levers.span - levers.spanAtRest);
    }
    rootOfGeometry_.assign(model_.robotGeometry.size(), -1);
    rootOfBody_.assign(bodies, -1);
    for (std::size_t body = 0; body < bodies; ++body) addBodyCover(body, geometriesOf[body]);
    addChildren();
    for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
      addInnerBalls(static_cast<int>(i));
      addProbes(static_cast<int>(i));
      meetingRowsOf_.push_back(addMeetingRows(meetingBalls(static_cast<int>(i)), meetingRows_));
    }
    addHulls();
    simd_.geometryBody = SharedArray(std::move(geometryBody_));
    simd_.rootOfGeometry = SharedArray(std::move(rootOfGeometry_));
    simd_.rootOfBody = SharedArray(std::move(rootOfBody_));
    simd_.nodes = SharedArray(std::move(nodes_));
    simd_.children = SharedArray(std::move(children_));
    simd_.innerBalls = SharedArray(std::move(innerBalls_));
    simd_.probes = SharedArray(std::move(probes_));
    simd_.probesOf = SharedArray(std::move(probesOf_));
    simd_.meetingRows = SharedArray(std::move(meetingRows_));
    simd_.meetingRowsOf = SharedArray(std::move(meetingRowsOf_));
  }

 private:
  void addBodyCover(std::size_t body, const std::vector<int>& geometries) {
    if (geometries.empty()) return;
    const auto first = static_cast<std::int32_t>(nodes_.size());
    rootOfBody_[body] = first;
    if (geometries.size() == 1) {
      nodes_.emplace_back();
      addTree(geometries.front(), first);
      return;
    }
    nodes_.resize(nodes_.size() + 1 + geometries.size());
    for (std::size_t i = 0; i < geometries.size(); ++i)
      addTree(geometries[i], first + 1 + static_cast<std::int32_t>(i));
    SimdNode& root = nodes_[first];
    root = ballAround(first + 1, static_cast<int>(geometries.size()));
    root.firstChild = first + 1;
    root.childCount = static_cast<std::int32_t>(geometries.size());
  }

  /// A ball that contains the balls of consecutive nodes.
  SimdNode ballAround(std::int32_t first, int count) const {
    const auto centerOf = [&](int i) {
      const float(&c)[3] = nodes_[first + i].center;
      return Vector3d(c[0], c[1], c[2]);
    };
    // Steps towards the farthest ball, each shorter than the one before (Badoiu, Clarkson 2003).
    Vector3d center = centerOf(0);
    const auto farthest = [&](const Vector3d& from, int& which) {
      double most = -1.0;
      for (int i = 0; i < count; ++i) {
        const double reach = (centerOf(i) - from).norm() + nodes_[first + i].radius;
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
    SimdNode node;
    for (int i = 0; i < 3; ++i) node.center[i] = static_cast<float>(center[i]);
    int which = 0;
    const Vector3d single(node.center[0], node.center[1], node.center[2]);
    node.radius = static_cast<float>(farthest(single, which)) * kRootOutward;
    node.beyond = node.radius;
    return node;
  }

  void addTree(int index, std::int32_t at) {
    const RobotGeometry& geometry = model_.robotGeometry[index];
    rootOfGeometry_[index] = at;
    if (geometry.cover == nullptr) {
      // Unbounded: nothing is proven for it here.
      nodes_[at].geometry = index;
      nodes_[at].radius = nodes_[at].beyond = std::numeric_limits<float>::infinity();
      return;
    }
    const std::vector<SphereCover::Node>& cover = geometry.cover->nodes;
    const auto rest = static_cast<std::int32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + cover.size() - 1);
    for (std::size_t i = 0; i < cover.size(); ++i) {
      const SphereCover::Node& node = cover[i];
      SimdNode& lane = nodes_[i == 0 ? at : rest + static_cast<std::int32_t>(i) - 1];
      setCenter(lane, geometry, node.ball.center.cast<double>());
      lane.radius = node.ball.radius;
      lane.inside = node.inside;
      lane.beyond = node.beyond;
      lane.firstChild = rest + node.firstChild - 1;
      lane.childCount = node.childCount;
      lane.geometry = index;
    }
  }

  void addChildren() {
    for (SimdNode& node : nodes_) {
      node.childRow = static_cast<std::int32_t>(children_.size());
      for (std::int32_t i = 0; i < node.childCount; i += kLanes) {
        SimdModel::Children& eight = children_.emplace_back();
        for (std::int32_t lane = 0; lane < kLanes; ++lane) {
          const SimdNode& child = nodes_[node.firstChild + std::min(i + lane, node.childCount - 1)];
          eight.x.lane[lane] = child.center[0];
          eight.y.lane[lane] = child.center[1];
          eight.z.lane[lane] = child.center[2];
          eight.radius.lane[lane] = child.radius;
        }
      }
    }
  }

  void addInnerBalls(int index) {
    const RobotGeometry& geometry = model_.robotGeometry[index];
    innerBalls_.push_back({static_cast<std::int32_t>(nodes_.size()), 0});
    if (geometry.cover == nullptr) return;
    for (const CoverBall& ball : geometry.cover->inner) {
      SimdNode node;
      setCenter(node, geometry, ball.center.cast<double>());
      node.radius = node.inside = ball.radius;
      node.geometry = index;
      nodes_.push_back(node);
      ++innerBalls_.back().count;
    }
  }

  void addProbes(int index) {
    const SimdModel::InnerBalls& balls = innerBalls_[index];
    probesOf_.push_back({static_cast<std::int32_t>(probes_.size()), 0});
    for (std::int32_t i = 0; i < balls.count; i += kLanes) {
      SimdModel::Probes& eight = probes_.emplace_back();
      for (std::int32_t lane = 0; lane < kLanes; ++lane) {
        const SimdNode& node = nodes_[balls.first + std::min(i + lane, balls.count - 1)];
        eight.x.lane[lane] = node.center[0];
        eight.y.lane[lane] = node.center[1];
        eight.z.lane[lane] = node.center[2];
        eight.inside.lane[lane] = node.inside;
      }
      ++probesOf_.back().count;
    }
  }

  /// In the frame of SimdNode::center.
  std::vector<MeetingBall> meetingBalls(int index) const {
    const RobotGeometry& geometry = model_.robotGeometry[index];
    std::vector<MeetingBall> balls;
    const SimdModel::InnerBalls& inner = innerBalls_[index];
    for (std::int32_t i = inner.first; i < inner.first + inner.count; ++i) {
      const float(&c)[3] = nodes_[i].center;
      balls.push_back({{c[0], c[1], c[2]}, nodes_[i].inside});
    }
    const auto* mesh = std::get_if<TriangleMesh>(&geometry.shape);
    if (!balls.empty() || mesh == nullptr) return balls;
    for (const Vector3d& point : spreadPoints(mesh->vertices(), kMostMeetingBalls)) {
      SimdNode node;
      setCenter(node, geometry, point);
      balls.push_back({Eigen::Vector3f(node.center), 0.0F});
    }
    return balls;
  }

  void addHulls() {
    auto hulls = std::make_shared<SimdHulls>();
    for (const RobotGeometry& geometry : model_.robotGeometry)
      hulls->add(geometry.shape, geometry.body_from_shape, simd_.bodyFromLane[geometry.body],
                 hullArms(geometry), isLong(geometry));
    simd_.hulls = std::move(hulls);
  }

  /// The number of growths is that of pairs of a turning joint and a sliding joint beyond it: too
  /// many for long paths (SimdHull::growsByAll).
  RestArms hullArms(const RobotGeometry& geometry) const {
    if (!isLong(geometry))
      return restArms(model_.kinematics, geometry.body, geometry.center, geometry.radius);
    return {armsAtRest(model_.kinematics, geometry.body, geometry.center, geometry.radius), {}};
  }
  static bool isLong(const RobotGeometry& geometry) {
    return geometry.levers.path.size() > kLongPath;
  }

  void setCenter(SimdNode& node, const RobotGeometry& geometry, const Vector3d& center) const {
    const Vector3d moved =
        simd_.bodyFromLane[geometry.body].transpose() * (geometry.body_from_shape * center);
    for (int k = 0; k < 3; ++k) node.center[k] = static_cast<float>(moved[k]);
  }

  const PairModel& model_;
  SimdModel& simd_;
  std::vector<int> geometryBody_;
  std::vector<std::int32_t> rootOfGeometry_, rootOfBody_;
  std::vector<SimdNode> nodes_;
  std::vector<SimdModel::Children> children_;
  std::vector<SimdModel::InnerBalls> innerBalls_, probesOf_, meetingRowsOf_;
  std::vector<SimdModel::Probes> probes_, meetingRows_;
};

}  // namespace

void compileCovers(const PairModel& model, SimdModel& simd) {
  CoverCompiler(model, simd).compile();
}

}  // namespace swept::detail
