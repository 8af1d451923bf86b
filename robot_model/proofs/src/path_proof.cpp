// SPDX-License-Identifier: BSD-3-Clause
#include "swept/proofs/path_proof.hpp"

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificate/certificate.hpp"
#include "certificate/constraints_json.hpp"
#include "certificate/model_json.hpp"
#include "certificate/path_json.hpp"
#include "certificate/verify_outcome.hpp"
#include "output/whole_file.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {

namespace {

void requireFree(const std::string& where, const PathCertificate& certificate) {
  for (std::size_t i = 0; i < certificate.segments.size(); ++i) {
    const Verdict verdict = certificate.segments[i].certificate.verdict;
    if (verdict != Verdict::Free)
      throw UsageError(where + ": there is no proof of a path that is not free: segment " +
                       std::to_string(i + 1) + " of " +
                       std::to_string(certificate.segments.size()) + " is " +
                       std::string(toString(verdict)));
  }
}

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

void requireProofFile(const std::filesystem::path& file, const std::string& where,
                      const Checker& checker) {
  requireWritable(file);
  requireModelNames(checker, where);
}

void requireJson(const std::filesystem::path& file, const std::string& where) {
  if (file.extension() != ".json") throw UsageError(where + ": a file with a proof ends in .json");
}

WrittenProof writtenProof(const std::filesystem::path& file, const Checker& checker,
                          const PathRecord& record, const Certificate& found,
                          const std::string& where) {
  if (!found.missing.empty()) return {.missing = found.missing};
  writeWholeFile(file, pathJsonText(checker, record, found, true, where));
  return {};
}

std::map<std::string, JointTolerance> tubeOf(const verify::Summary& summary) {
  std::map<std::string, JointTolerance> tube;
  for (const auto& [joint, tolerance] : summary.tube)
    tube[joint] = {.rotation = tolerance.rotation.value_or(0.0),
                   .translation = tolerance.translation.value_or(0.0)};
  return tube;
}

CheckedProof checkedProof(const VerifyOutcome& outcome) {
  if (!outcome.holds()) return {.refusal = outcome.refusal, .notChecked = {}};
  return {.refusal = {},
          .segments = outcome.summary.segments,
          .pairs = outcome.summary.pairs,
          .intervals = outcome.summary.intervals,
          .planes = outcome.summary.planes,
          .clearance = outcome.summary.clearance,
          .clearanceWorld = outcome.summary.clearanceWorld,
          .clearanceSelf = outcome.summary.clearanceSelf,
          .notChecked = outcome.summary.allowed,
          .duration = outcome.summary.duration,
          .tube = tubeOf(outcome.summary),
          .constraints = outcome.summary.constraints};
}

}  // namespace

WrittenProof writeProof(const std::filesystem::path& file, const Checker& checker,
                        const ConfigurationList& states, const PathCertificate& certificate,
                        const std::vector<std::string>& warnings) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return writeProof(file, checker, states, certificate, warnings); });
  }
  const std::string where = "'" + file.string() + "'";
  requireJson(file, where);
  const ProvenPath path = provenPath(states, certificate);
  requireFree(where, certificate);
  requireProofFile(file, where, checker);
  const PathRecord record{
      .states = path.states, .segments = path.segments, .inputs = nullptr, .warnings = warnings};
  return writtenProof(file, checker, record, certificateOf(checker, path.states, path.clearances()),
                      where);
}

WrittenProof writeTrajectoryProof(const std::filesystem::path& file, const Checker& checker,
                                  const JointTrajectory& trajectory,
                                  const TrajectoryCertificate& certificate,
                                  const std::vector<std::string>& warnings) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return writeTrajectoryProof(file, checker, trajectory, certificate, warnings); });
  }
  const std::string where = "'" + file.string() + "'";
  requireJson(file, where);
  requireVariables(trajectory, checker);
  controllerCurve(trajectory);  // sizes, times and values are what they have to be
  const ProvenPath path = provenPath(trajectory, certificate);
  requireFree(where, certificate);
  requireProofFile(file, where, checker);
  const PathRecord record{.states = path.states,
                          .segments = path.segments,
                          .inputs = nullptr,
                          .warnings = warnings,
                          .trajectory = &trajectory};
  return writtenProof(file, checker, record,
                      certificateOf(checker, trajectory, path.segments.front().clearance), where);
}

CheckedProof verifyProof(const std::filesystem::path& file) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return verifyProof(file); });
  }
  const Json path = pathWithProof(file.string());
  if (!path.contains("model"))
    throw InputError(file.string(), 0,
                     "the robot and the world are not in it; verifyProof() with a checker of them "
                     "takes it");
  return checkedProof(verified(path, nullptr));
}

CheckedProof verifyProof(const std::filesystem::path& file, const Checker& checker) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return verifyProof(file, checker); });
  }
  const Json path = pathWithProof(file.string());
  const VerifyOutcome outcome = verified(path, modelJson(checker));
  const Json own = constraintsJson(checker);
  if (outcome.holds() && !own.empty() && path.value("constraints", Json::array()) != own)
    return {.refusal = "constraints: they are not those of the checker", .notChecked = {}};
  return checkedProof(outcome);
}

}  // namespace swept
