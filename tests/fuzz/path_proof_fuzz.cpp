// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "verify/check.hpp"

using namespace swept;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // A path file with its model in it: the checker of proofs trusts neither.
  const auto path = verify::Json::parse(fuzz::textOf(data, size), nullptr, false);
  if (!path.is_object() || !path.contains("proof") || !path.contains("model")) return 0;
  try {
    verify::checkProof(path, path["model"]);
  } catch (const verify::Refusal&) {
    return 0;
  } catch (const std::exception& error) {
    fuzz::fail(std::string("threw ") + error.what());
  }
  return 0;
}
