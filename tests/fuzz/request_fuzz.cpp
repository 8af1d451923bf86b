// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "swept/robot_model/planning_request.hpp"

using namespace swept;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::files().write("request.yaml", fuzz::textOf(data, size));
  fuzz::mayRefuse([&] { PlanningRequest::load(file); });
  return 0;
}
