// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/trajectory_proof.hpp"

#include <stdexcept>

#include "certificate/certificate.hpp"
#include "certificate/model_json.hpp"
#include "certificate/path_json.hpp"
#include "certificate/stopping.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

void requireFree(const std::string& where, const TrajectoryCertificate& certificate) {
  if (certificate.verdict != Verdict::Free)
    throw UsageError(where + ": there is no proof of a trajectory that is not free: it is " +
                     std::string(toString(certificate.verdict)));
  for (const LimitViolation& violation : certificate.violations)
    if (violation.kind == LimitKind::Position)
      throw UsageError(where + ": there is no proof of a trajectory that leaves its limits: " +
                       violation.variable + " is at " + shortNumber(violation.value) + " at " +
                       shortNumber(violation.time) + " s, and its limit is " +
                       shortNumber(violation.limit));
}

void requireVariables(const JointTrajectory& trajectory, const Checker& checker) {
  std::vector<std::string> names;
  for (const int variable : checker.group().variables)
    names.push_back(checker.robot().variables()[static_cast<std::size_t>(variable)].name);
  if (trajectory.variables != names)
    throw std::invalid_argument("the variables of a trajectory are not " + joined(names) +
                                ", those of the group in its order, but " +
                                joined(trajectory.variables));
}

}  // namespace

Json trajectoryProof(const Checker& checker, const JointTrajectory& trajectory,
                     const TrajectoryCertificate& certificate,
                     const std::vector<std::string>& warnings, double clock,
                     const std::string& where, std::string& missing, const std::stop_token& stop) {
  requireVariables(trajectory, checker);
  controllerCurve(trajectory);  // sizes, times and values are what they have to be
  const ProvenPath path = provenPath(trajectory, certificate);
  requireFree(where, certificate);
  requireModelNames(checker, where);
  const PathRecord record{.states = path.states,
                          .segments = path.segments,
                          .inputs = nullptr,
                          .warnings = warnings,
                          .trajectory = &trajectory,
                          .clock = clock};
  const Certificate found =
      certificateOf(checker, trajectory, path.segments.front().clearance, clock, stop);
  throwIfStopped(stop);
  missing = found.missing;
  return missing.empty() ? pathJson(checker, record, found, true, where) : Json();
}

}  // namespace swept
