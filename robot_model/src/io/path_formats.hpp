// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "io/input_source.hpp"
#include "io/path_rows.hpp"
#include "swept/robot_model/robot.hpp"

/// The formats of paths, which readPath() chooses from. They add a path's states to `rows`, and
/// throw InputError.
namespace swept::detail {

void readCsvPath(const std::string& text, const InputSource& source, PathRows& rows);
void readJsonPath(const std::string& text, const InputSource& source, PathRows& rows);
void readYamlPath(const std::string& text, const InputSource& source, const Robot& robot,
                  PathRows& rows);

}  // namespace swept::detail
