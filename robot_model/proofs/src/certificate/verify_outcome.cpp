// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/verify_outcome.hpp"

#include "certificate/stopping.hpp"
#include "io/json_value.hpp"
#include "swept/robot_model/input.hpp"
#include "verify/check.hpp"

namespace swept {

void requireProof(const Json& path, const std::string& file) {
  if (!path.is_object() || !path.contains("proof") || path["proof"].is_null())
    throw InputError(file, 0, "there is no proof in it");
}

Json pathWithProof(const std::string& file) {
  Json path = parseOrderedJson(file);
  requireProof(path, file);
  return path;
}

VerifyOutcome verified(const Json& path, const Json& other, const std::stop_token& stop) {
  VerifyOutcome outcome;
  const bool embedded = path.contains("model");
  try {
    outcome.summary = verify::checkProof(path, embedded ? path["model"] : other, pauseOf(stop));
    if (embedded && !other.is_null()) verify::requireSameModel(path["proof"], other);
  } catch (const verify::Refusal& refusal) {
    outcome.refusal = refusal.what();
  }
  return outcome;
}

}  // namespace swept
