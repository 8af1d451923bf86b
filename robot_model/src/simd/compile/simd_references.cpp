// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/simd_references.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "model/pair_model.hpp"
#include "robot/joint_types.hpp"
#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

class ReferenceCompiler {
 public:
  ReferenceCompiler(const PairModel& model, const SimdModel& simd) : model_(model), simd_(simd) {}

  /// A reference before any steps are added.
  void findArms() {
    levers_.resize(simd_.bodies.size());
    for (std::size_t body = 1; body < simd_.bodies.size(); ++body) {
      Vector3d middle;
      double radius = 0.0;
      centersOf(body, middle, radius);
      levers_[body] = restArms(model_.kinematics, static_cast<int>(body), middle, radius);
    }
  }

  /// The place of each body in the rows.
  SimdReference places(int body) const {
    SimdReference reference;
    reference.body = body;
    reference.slot.assign(simd_.bodies.size(), -1);
    int moved = 0;
    // Parents come first: a body that hangs on a moved body is moved.
    for (std::size_t i = 1; i < simd_.bodies.size(); ++i) {
      const int parent = simd_.bodies[i].parent;
      if (parent == body || reference.slot[parent] >= 0) reference.slot[i] = moved++;
    }
    reference.rows = (moved + kLanes - 1) / kLanes;
    return reference;
  }

  void addSteps(SimdReference& reference) const {
    std::vector<int> moved;
    for (std::size_t i = 1; i < simd_.bodies.size(); ++i)
      if (reference.slot[i] >= 0) moved.push_back(static_cast<int>(i));
    reference.arms.resize(moved.size() * reference.rows, Row{});
    reference.carried.resize(moved.size() * reference.rows, Row{});
    for (const int step : moved) reference.steps.push_back(stepOf(step, reference));
    for (const int carried : moved) fillArms(carried, reference);
  }

  std::vector<SimdCarried> carried(const std::vector<int>& references) const {
    std::vector<SimdCarried> joints(simd_.bodies.size());
    for (std::size_t body = 1; body < simd_.bodies.size(); ++body) {
      Vector3d middle;
      double radius = 0.0;
      centersOf(body, middle, radius);
      const std::vector<double> arms =
          armsAtRest(model_.kinematics, static_cast<int>(body), middle, radius);
      for (std::size_t i = 0; i < arms.size(); ++i) {
        SimdCarried& joint = joints[simd_.ancestors[body][i]];
        joint.bodies.push_back(static_cast<int>(body));
        joint.arms.push_back(static_cast<float>(arms[i] * kArmOutward));
      }
    }
    std::vector<std::int32_t> indexOf(simd_.bodies.size(), -1);
    for (std::size_t k = 0; k < references.size(); ++k)
      indexOf[references[k]] = static_cast<std::int32_t>(k);
    for (std::size_t body = 1; body < simd_.bodies.size(); ++body)
      joints[body].around = indexOf[simd_.bodies[body].parent];
    return joints;
  }

 private:
  /// A ball around all ball centres of a body, in the body's frame.
  void centersOf(std::size_t body, Vector3d& middle, double& radius) const {
    std::vector<Vector3d> centers;
    std::vector<std::int32_t> stack;
    if (simd_.rootOfBody[body] >= 0) stack.push_back(simd_.rootOfBody[body]);
    Eigen::AlignedBox3d box;
    while (!stack.empty()) {
      const SimdNode& node = simd_.nodes[stack.back()];
      stack.pop_back();
      const float(&c)[3] = node.center;
      centers.emplace_back(simd_.bodyFromLane[body] * Vector3d(c[0], c[1], c[2]));
      box.extend(centers.back());
      for (int i = 0; i < node.childCount; ++i) stack.push_back(node.firstChild + i);
    }
    middle = box.isEmpty() ? Vector3d(Vector3d::Zero()) : box.center();
    radius = 0.0;
    for (const Vector3d& center : centers) radius = std::max(radius, (center - middle).norm());
  }

  SimdReference::Step stepOf(int body, const SimdReference& reference) const {
    const MovingBody& moving = model_.kinematics.bodies[body];
    SimdReference::Step step;
    step.body = body;
    step.parent = reference.slot[moving.parent];
    if (step.parent < 0) return step;
    step.turnsAfter = simd_.bodies[body].cosine >= 0.0F;
    step.grandparent = reference.slot[model_.kinematics.bodies[moving.parent].parent];
    return step;
  }

  void fillArms(int body, SimdReference& reference) const {
    const RestArms& levers = levers_[body];
    const std::vector<int>& path = simd_.ancestors[body];
    const int slot = reference.slot[body];
    const auto setIn = [&](std::vector<Row>& rows, int step, double value) {
      rows[step * reference.rows + slot / kLanes].lane[slot % kLanes] = static_cast<float>(value);
    };
    for (std::size_t i = 0; i < path.size(); ++i) {
      const int step = reference.slot[path[i]];
      if (step < 0) continue;
      setIn(reference.arms, step, levers.arms[i] * kArmOutward);
      setIn(reference.carried, step, 1.0);
    }
    for (const RestArms::Growth& growth : levers.growths) {
      const int step = reference.slot[path[growth.joint]];
      if (step >= 0) setIn(sharesOf(growth.slide, reference), step, growth.share * kArmOutward);
    }
  }

  /// The growths of a prismatic joint.
  static std::vector<Row>& sharesOf(int slide, SimdReference& reference) {
    const auto known = std::ranges::find(reference.growths, slide, &SimdReference::Growth::slide);
    if (known != reference.growths.end()) return known->shares;
    reference.growths.push_back({slide, std::vector<Row>(reference.arms.size(), Row{})});
    return reference.growths.back().shares;
  }

  const PairModel& model_;
  const SimdModel& simd_;
  std::vector<RestArms> levers_;
};

}  // namespace

void compileReferences(const PairModel& model, const std::vector<int>& bodies, SimdModel& simd,
                       std::size_t mostArms) {
  ReferenceCompiler compiler(model, simd);
  std::vector<SimdReference> references;
  std::size_t arms = 0;
  for (const int body : bodies) {
    const SimdReference& reference = references.emplace_back(compiler.places(body));
    std::size_t moved = 0;
    std::size_t slides = 0;
    for (std::size_t i = 1; i < simd.bodies.size(); ++i) {
      if (reference.slot[i] < 0) continue;
      ++moved;
      if (slidesWithinLimits(model.kinematics.bodies[i].type)) ++slides;
    }
    arms += moved * reference.rows * kLanes * (1 + slides);  // each slide has shares of them
  }
  if (arms > mostArms) {
    simd.carried = SharedArray(compiler.carried(bodies));
  } else {
    compiler.findArms();
    for (SimdReference& reference : references) compiler.addSteps(reference);
  }
  simd.references = SharedArray(std::move(references));
}

}  // namespace swept::detail
