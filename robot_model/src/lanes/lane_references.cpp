// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/lane_references.hpp"

#include <algorithm>

#include "certify/checker_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

class ReferenceCompiler {
 public:
  ReferenceCompiler(const CheckerModel& model, const LaneModel& lanes)
      : model_(model), lanes_(lanes), levers_(lanes.bodies.size()) {
    for (std::size_t body = 1; body < lanes_.bodies.size(); ++body) {
      Vector3d middle;
      double radius = 0.0;
      centersOf(body, middle, radius);
      levers_[body] = leverArms(model_.kinematics, static_cast<int>(body), middle, radius);
    }
  }

  LaneReference compile(int body) const {
    LaneReference reference;
    reference.body = body;
    reference.slot.assign(lanes_.bodies.size(), -1);
    std::vector<int> moved;
    for (std::size_t i = 1; i < lanes_.bodies.size(); ++i) {
      const auto& ancestors = lanes_.ancestors[i];
      const bool below = body == 0 || std::ranges::find(ancestors, body) != ancestors.end();
      if (!below || static_cast<int>(i) == body) continue;
      reference.slot[i] = static_cast<int>(moved.size());
      moved.push_back(static_cast<int>(i));
    }
    reference.rows = (static_cast<int>(moved.size()) + kLanes - 1) / kLanes;
    reference.arms.resize(moved.size() * reference.rows, Row{});
    reference.carried.resize(moved.size() * reference.rows, Row{});
    for (const int step : moved) reference.steps.push_back(stepOf(step, reference));
    for (const int carried : moved) fillArms(carried, reference);
    return reference;
  }

 private:
  /// All ball centres of a body as one ball, in the body's frame.
  void centersOf(std::size_t body, Vector3d& middle, double& radius) const {
    std::vector<Vector3d> centers;
    std::vector<std::int32_t> stack;
    if (lanes_.rootOfBody[body] >= 0) stack.push_back(lanes_.rootOfBody[body]);
    Eigen::AlignedBox3d box;
    while (!stack.empty()) {
      const LaneNode& node = lanes_.nodes[stack.back()];
      stack.pop_back();
      const float(&c)[3] = node.center;
      centers.emplace_back(lanes_.bodyFromLane[body] * Vector3d(c[0], c[1], c[2]));
      box.extend(centers.back());
      for (int i = 0; i < node.childCount; ++i) stack.push_back(node.firstChild + i);
    }
    middle = box.isEmpty() ? Vector3d(Vector3d::Zero()) : box.center();
    radius = 0.0;
    for (const Vector3d& center : centers) radius = std::max(radius, (center - middle).norm());
  }

  LaneReference::Step stepOf(int body, const LaneReference& reference) const {
    const MovingBody& moving = model_.kinematics.bodies[body];
    LaneReference::Step step;
    step.body = body;
    step.parent = reference.slot[moving.parent];
    if (step.parent < 0) return step;
    step.turnsAfter = lanes_.bodies[body].cosine >= 0.0F;
    step.grandparent = reference.slot[model_.kinematics.bodies[moving.parent].parent];
    return step;
  }

  void fillArms(int body, LaneReference& reference) const {
    const LeverArms& levers = levers_[body];
    const int slot = reference.slot[body];
    for (std::size_t i = 0; i < levers.path.size(); ++i) {
      const int step = reference.slot[levers.path[i]];
      if (step < 0) continue;
      const int at = step * reference.rows + slot / kLanes;
      reference.arms[at].lane[slot % kLanes] = static_cast<float>(levers.arms[i] * (1.0 + 1e-6));
      reference.carried[at].lane[slot % kLanes] = 1.0F;
    }
  }

  const CheckerModel& model_;
  const LaneModel& lanes_;
  std::vector<LeverArms> levers_;
};

}  // namespace

std::vector<LaneReference> compileReferences(const CheckerModel& model, const LaneModel& lanes,
                                             const std::vector<int>& bodies) {
  const ReferenceCompiler compiler(model, lanes);
  std::vector<LaneReference> references;
  for (const int body : bodies) references.push_back(compiler.compile(body));
  return references;
}

}  // namespace swept::detail
