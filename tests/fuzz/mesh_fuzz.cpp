// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "fuzz_input.hpp"
#include "swept/robot_model/world.hpp"

using namespace swept;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  // The first byte says which format.
  static constexpr std::array kNames{"m.stl", "m.obj",  "m.ply", "m.dae",
                                     "m.off", "m.gltf", "m.glb"};
  if (size == 0) return 0;
  const std::string name = kNames[data[0] % kNames.size()];
  fuzz::files().write(name, fuzz::textOf(data + 1, size - 1));
  const auto urdf = fuzz::files().write(
      "mesh.urdf", "<robot name=\"r\"><link name=\"l\"><collision><geometry><mesh filename=\"" +
                       name + "\"/></geometry></collision></link></robot>");
  // As a world: a robot's links get covers, which take up to a minute with sanitizers.
  fuzz::mayRefuse([&] { World::load(urdf); });
  return 0;
}
