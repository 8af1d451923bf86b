// SPDX-License-Identifier: BSD-3-Clause
#include "certify/never_compile.hpp"

#include <algorithm>

#include "matrix/never_pairs.hpp"

namespace swept::detail {

namespace {

/// Of NeverProof, per pair: a fraction of a millisecond. Of a Panda without SRDF (42 pairs) it
/// proves 14, ten times as much 19, and 300 times as much 20; of a UR5 with a gripper (81) all
/// of 23.
constexpr std::int64_t kBudget = 3'000;

/// Values of joints outside the group, too: proofs are about values within the limits.
bool referenceWithinLimits(const CheckerModel& model) {
  const std::vector<Variable>& variables = model.robot->variables();
  for (std::size_t v = 0; v < variables.size(); ++v) {
    const double value = (*model.options.reference)[static_cast<Eigen::Index>(v)];
    if (!variables[v].cyclic && !(value >= variables[v].lower && value <= variables[v].upper))
      return false;
  }
  return true;
}

/// A checked pair of two links as they come from the URDF.
bool isProvable(const CheckerModel& model, const BodyPair& pair) {
  const auto plain = [&](int carrier) {
    return model.carriers[carrier].kind == Carrier::Kind::Link &&
           model.options.rules.scale(model.carriers[carrier].name) == 1.0;
  };
  return pair.carriers && pair.reason == PairReason::Checked && plain(pair.a) && plain(pair.b);
}

std::shared_ptr<const NeverMargins> prove(const CheckerModel& model) {
  std::vector<LinkQuestion> questions;
  for (const BodyPair& pair : model.bodyPairs)
    if (isProvable(model, pair)) questions.push_back({pair.a, pair.b, pair.margin});
  if (referenceWithinLimits(model)) proveNever(*model.robot, questions, kBudget);
  auto margins = std::make_shared<NeverMargins>();
  for (const LinkQuestion& question : questions)
    if (question.never)
      margins->emplace(std::pair{question.linkA, question.linkB}, question.margin);
  return margins;
}

}  // namespace

void findNever(const CheckerModel* like, CheckerModel& model) {
  model.neverMargins = like != nullptr ? like->neverMargins : prove(model);
  for (BodyPair& pair : model.bodyPairs) {
    if (!isProvable(model, pair)) continue;
    const auto proven = model.neverMargins->find({pair.a, pair.b});
    pair.never = proven != model.neverMargins->end() && proven->second >= pair.margin;
  }
}

}  // namespace swept::detail
