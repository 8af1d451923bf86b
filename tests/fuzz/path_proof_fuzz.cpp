// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "verify/check.hpp"

using namespace swept;
using verify::Json;

namespace {

void check(const Json& path) {
  try {
    verify::checkProof(path, path["model"]);
  } catch (const verify::Refusal&) {
    return;
  } catch (const std::exception& error) {
    fuzz::fail(std::string("threw ") + error.what());
  }
}

/// Makes the digests fit, as far as there is what they are of: a change would be refused by them,
/// and nothing behind them be reached.
void sign(Json& path) {
  Json& proof = path["proof"];
  proof["digests"] = verify::digestsOf(path["model"]);
  proof["digests"]["claims"] = verify::claimDigests(path);
  const Json& states = path.at("states");
  Json& segments = proof.at("segments");
  for (std::size_t i = 0; i < segments.size() && i + 1 < states.size(); ++i) {
    segments[i]["states_digest"] = verify::stateDigest(states[i], states[i + 1]);
    for (Json& pair : segments[i].at("pairs")) pair["digest"] = verify::pairDigest(pair);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A path file with its model in it: the checker of proofs trusts neither.
  Json path = Json::parse(fuzz::textOf(data, size), nullptr, false);
  if (!path.is_object() || !path.contains("proof") || !path.contains("model")) return 0;
  check(path);
  try {
    sign(path);
  } catch (const std::exception&) {
    return 0;  // not laid out as a path file
  }
  check(path);
  return 0;
}
