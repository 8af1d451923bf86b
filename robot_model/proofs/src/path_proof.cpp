// SPDX-License-Identifier: BSD-3-Clause
#include "swept/proofs/path_proof.hpp"

#include <string>
#include <vector>

#include "certificate/certificate.hpp"
#include "certificate/checked_proof.hpp"
#include "certificate/constraints_json.hpp"
#include "certificate/lines_json.hpp"
#include "certificate/model_json.hpp"
#include "certificate/path_json.hpp"
#include "certificate/trajectory_proof.hpp"
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
  writeWholeFile(file, pathText(pathJson(checker, record, found, true, where), where));
  return {};
}

}  // namespace

WrittenProof writeProof(const std::filesystem::path& file, const Checker& checker,
                        const ConfigurationList& states, const PathCertificate& certificate,
                        const std::vector<std::string>& warnings, const std::stop_token& stop) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return writeProof(file, checker, states, certificate, warnings, stop); });
  }
  const std::string where = "'" + file.string() + "'";
  requireJson(file, where);
  const ProvenPath path = provenPath(states, certificate);
  requireFree(where, certificate);
  requireProofFile(file, where, checker);
  const PathRecord record{
      .states = path.states, .segments = path.segments, .inputs = nullptr, .warnings = warnings};
  return writtenProof(file, checker, record,
                      certificateOf(checker, path.states, path.clearances(), Json::array(), stop),
                      where);
}

WrittenProof writeLineProof(const std::filesystem::path& file, const Checker& checker,
                            const ConstraintFrame& tool, std::span<const ToolLine> lines,
                            const ToolLineOptions& options,
                            const std::vector<std::string>& warnings, const std::stop_token& stop) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, lines] { return writeLineProof(file, checker, tool, lines, options, warnings, stop); });
  }
  const std::string where = "'" + file.string() + "'";
  requireJson(file, where);
  const std::vector<std::vector<double>> states = statesOf(lines);
  const PathCertificate certificate = certifyPath(checker, states);
  const ProvenPath path = provenPath(states, certificate);
  requireFree(where, certificate);
  requireProofFile(file, where, checker);
  const PathRecord record{.states = path.states,
                          .segments = path.segments,
                          .inputs = nullptr,
                          .warnings = warnings,
                          .lines = linesJson(checker, tool, lines, options)};
  return writtenProof(file, checker, record,
                      certificateOf(checker, path.states, path.clearances(), record.lines, stop),
                      where);
}

WrittenProof writeTrajectoryProof(const std::filesystem::path& file, const Checker& checker,
                                  const JointTrajectory& trajectory,
                                  const TrajectoryCertificate& certificate,
                                  const std::vector<std::string>& warnings, double clock,
                                  const std::stop_token& stop) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, clock] {
      return writeTrajectoryProof(file, checker, trajectory, certificate, warnings, clock, stop);
    });
  }
  const std::string where = "'" + file.string() + "'";
  requireJson(file, where);
  requireWritable(file);
  WrittenProof written;
  const Json path = trajectoryProof(checker, trajectory, certificate, warnings, clock, where,
                                    written.missing, stop);
  if (!written.missing.empty()) return written;
  writeWholeFile(file, pathText(path, where));
  return {};
}

CheckedProof verifyProof(const std::filesystem::path& file, const std::stop_token& stop) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return verifyProof(file, stop); });
  }
  const Json path = pathWithProof(file.string());
  if (!path.contains("model"))
    throw InputError(file.string(), 0,
                     "the robot and the world are not in it; verifyProof() with a checker of them "
                     "takes it");
  return checkedProof(verified(path, nullptr, stop));
}

CheckedProof verifyProof(const std::filesystem::path& file, const Checker& checker,
                         const std::stop_token& stop) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return verifyProof(file, checker, stop); });
  }
  const Json path = pathWithProof(file.string());
  const VerifyOutcome outcome = verified(path, modelJson(checker), stop);
  const Json own = constraintsJson(checker);
  if (outcome.holds() && !own.empty() && path.value("constraints", Json::array()) != own)
    return {.refusal = "constraints: they are not those of the checker", .notChecked = {}};
  return checkedProof(outcome);
}

}  // namespace swept
