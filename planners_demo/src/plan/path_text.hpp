// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "output/terminal.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// A path for reading: a row per state, with six significant digits per variable of the group; the
/// first and the last ten of more than 20 states. Where the lines may not be as long as a table of
/// them is, names are in front and each state is a list.
std::string pathText(const Robot& robot, const Group& group,
                     const std::vector<std::vector<double>>& states,
                     std::optional<std::size_t> columns = columnsOf(Stream::Out));

}  // namespace swept
