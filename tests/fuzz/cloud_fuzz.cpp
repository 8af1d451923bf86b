// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "fuzz_input.hpp"
#include "swept/core/point_cloud.hpp"
#include "swept/robot_model/cloud_file.hpp"

using namespace swept;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The first byte says which reader.
  static constexpr std::array kNames{"c.pcd", "c.ply", "c.xyz", "c.bt", "c.ot"};
  if (size == 0) return 0;
  const std::string name = kNames[data[0] % kNames.size()];
  const auto file = fuzz::files().write(name, fuzz::textOf(data + 1, size - 1));
  fuzz::mayRefuse([&] {
    if (name == "c.bt" || name == "c.ot")
      loadOctomap(file);
    else
      loadPoints(file);
  });
  return 0;
}
