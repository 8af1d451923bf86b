// SPDX-License-Identifier: BSD-3-Clause
#include "model/compile.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "acm/never_pairs.hpp"
#include "model/pair_model.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept::detail {

namespace {

/// Effort of NeverProof per pair: a fraction of a millisecond. For a Panda without SRDF (42 pairs)
/// it proves 14, ten times as much 19, and 300 times as much 20; for a UR5 with a gripper (81
/// pairs) all of 23.
constexpr std::int64_t kBudget = 3'000;

/// Work for all pairs together, some ns each (see NeverProof::work()). A chain of 60 links, with
/// 1711 pairs, takes 0.8 of it. Robots with more pairs do without those that are far apart along
/// the chain.
constexpr std::int64_t kMostWork = 1'000'000'000;

/// Also for values of joints outside the group: proofs are about values within the limits, and as
/// far beyond as isWithin() allows (LinkChain::box).
bool referenceWithinLimits(const PairModel& model) {
  const std::vector<Variable>& variables = model.robot->variables();
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const double value = (*model.options.reference)[static_cast<Eigen::Index>(v)];
    if (!variables[v].cyclic && !isWithin(value, variables[v].lower, variables[v].upper))
      return false;
  }
  return true;
}

/// The pairs that can be proven: the checked ones of two links with unchanged geometry from the
/// URDF.
class Provable {
 public:
  explicit Provable(const PairModel& model) {
    for (const CollisionBody& collisionBody : model.collisionBodies)
      plain_.push_back(collisionBody.kind == CollisionBody::Kind::Link &&
                       model.options.rules.scale(collisionBody.name) == 1.0);
  }
  bool operator()(const BodyPair& pair) const {
    return pair.ofRobot && pair.reason == PairReason::Checked && plain_[pair.a] && plain_[pair.b];
  }

 private:
  std::vector<bool> plain_;  ///< per collision body
};

std::shared_ptr<const NeverMargins> prove(const PairModel& model, const Provable& isProvable) {
  std::vector<LinkQuestion> questions;
  double beyond = 0.0;
  for (const JointTolerance& joint : model.tube) beyond = std::max(beyond, joint.rotation);
  for (const BodyPair& pair : model.bodyPairs)
    if (isProvable(pair)) questions.push_back({pair.a, pair.b, pair.margin, beyond});
  if (referenceWithinLimits(model)) proveNever(*model.robot, questions, kBudget, kMostWork);
  auto margins = std::make_shared<NeverMargins>();
  for (const LinkQuestion& question : questions)
    if (question.never)
      margins->emplace(std::pair{question.linkA, question.linkB}, question.margin);
  return margins;
}

}  // namespace

void findNever(const PairModel* like, PairModel& model) {
  const Provable isProvable(model);
  model.neverMargins = like != nullptr ? like->neverMargins : prove(model, isProvable);
  for (BodyPair& pair : model.bodyPairs) {
    if (!isProvable(pair)) continue;
    const auto proven = model.neverMargins->find({pair.a, pair.b});
    pair.never = proven != model.neverMargins->end() && proven->second >= pair.margin;
  }
}

}  // namespace swept::detail
