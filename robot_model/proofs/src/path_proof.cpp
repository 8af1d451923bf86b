// SPDX-License-Identifier: BSD-3-Clause
#include "swept/proofs/path_proof.hpp"

#include <stdexcept>

#include "certificate/certificate.hpp"
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
          .notChecked = outcome.summary.allowed};
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
  if (file.extension() != ".json") throw UsageError(where + ": a file with a proof ends in .json");
  const ProvenPath path = provenPath(states, certificate);
  requireFree(where, certificate);
  requireWritable(file);
  requireModelNames(checker, where);
  const Certificate found = certificateOf(checker, path.states, path.clearances());
  if (!found.missing.empty()) return {.missing = found.missing};
  const PathRecord record{
      .states = path.states, .segments = path.segments, .inputs = nullptr, .warnings = warnings};
  writeWholeFile(file, pathJsonText(checker, record, found, true, where));
  return {};
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
  return checkedProof(verified(pathWithProof(file.string()), modelJson(checker)));
}

}  // namespace swept
