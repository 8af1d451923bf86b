// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/checker.hpp"

/// Certificates of an arm's motions against its states, one at a time.
namespace swept::fuzz {
namespace {

constexpr int kMoments = 17;

std::shared_ptr<const Checker> makeChecker() {
  const std::string folder = modelsDir();
  const auto robot =
      Robot::load(folder + "/robots/rook6/rook6.urdf", folder + "/robots/rook6/rook6.srdf", {});
  const auto world =
      std::make_shared<const World>(World::load(folder + "/scenes/table_objects.yaml"));
  return std::make_shared<const Checker>(robot, robot->groups().front().name, world);
}

std::vector<double> state(Numbers& numbers, const Checker& checker) {
  std::vector<double> q;
  for (const int v : checker.group().variables) {
    const Variable& variable = checker.robot().variables()[v];
    // Continuous joints go the shorter way; within half a turn that is the straight one.
    const double low = std::max(variable.lower, -1.5), high = std::min(variable.upper, 1.5);
    q.push_back(std::clamp(0.5 * (low + high) + 0.5 * (high - low) * numbers.unit(), low, high));
  }
  return q;
}

void examine(const Checker& checker, const std::vector<double>& from,
             const std::vector<double>& to) {
  Workspace workspace(checker);
  const MotionCertificate found = checker.certifyMotion(from, to, workspace);
  const MotionCertificate quick =
      checker.certifyMotion(from, to, workspace, MotionQuery::VerdictOnly);
  const bool differ = found.verdict != quick.verdict && found.verdict != Verdict::Undecided &&
                      quick.verdict != Verdict::Undecided;
  if (differ) fail("the verdict depends on what else is asked");
  std::vector<double> q(from.size());
  const auto verdictAt = [&](double t) {
    for (std::size_t i = 0; i < q.size(); ++i) q[i] = from[i] + t * (to[i] - from[i]);
    return checker.checkState(q, workspace);
  };
  // Just before its end: there the contact may be.
  const double free = found.freeUntil * (1.0 - 1e-9);
  for (int i = 0; i < kMoments && free > 0.0; ++i)
    if (verdictAt(free * i / (kMoments - 1)) == Verdict::Collision)
      fail("in collision while proven free");
  if (found.witness && verdictAt(found.witness->t) == Verdict::Free) fail("a witness that is free");
}

}  // namespace
}  // namespace swept::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swept::fuzz;
  static const std::shared_ptr<const swept::Checker> kChecker = makeChecker();
  Numbers numbers(data, size);
  const std::vector<double> from = state(numbers, *kChecker);
  examine(*kChecker, from, state(numbers, *kChecker));
  return 0;
}
