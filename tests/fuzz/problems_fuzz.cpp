// SPDX-License-Identifier: BSD-3-Clause
#include "fuzz_input.hpp"
#include "swept/robot_model/problems.hpp"

using namespace swept;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::files().write("problems.json", fuzz::textOf(data, size));
  fuzz::mayRefuse([&] {
    const ProblemFile problems = ProblemFile::load(file);
    for (const std::string& set : problems.sets())
      for (const int index : problems.indices(set)) problems.problem(set, index);
  });
  return 0;
}
