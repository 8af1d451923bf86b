// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace swept::test {

/// Cubes of 0.2 m, `NAME_cube`, that slide by joints NAME along an axis from -3 m to 3 m, all
/// through the origin. `slides`: names and axes (such as `1 0 0`).
inline std::string crossingUrdf(
    const std::vector<std::pair<std::string_view, std::string_view>>& slides) {
  std::string text = "<robot name='crossing'><link name='base'/>";
  for (const auto& [name, axis] : slides) {
    const std::string cube = std::string(name) + "_cube";
    text += "<link name='" + cube +
            "'><collision><geometry><box size='0.2 0.2 0.2'/></geometry></collision></link>"
            "<joint name='" +
            std::string(name) + "' type='prismatic'><parent link='base'/><child link='" + cube +
            "'/><axis xyz='" + std::string(axis) +
            "'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>";
  }
  return text + "</robot>";
}

}  // namespace swept::test
