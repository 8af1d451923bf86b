// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swept/robot_model/input.hpp"

namespace swept::detail {

/// What a mesh reference may mean: the places to look, in order. Empty for a scheme other than
/// `package://`, `model://` and `file://`.
///
/// `folder` is the absolute folder of the file that holds the reference. `package://NAME/rest` (and
/// `model://`, the same in simulators) means LoadOptions::packages, longest name first; then
/// folder/NAME/rest for `folder` and each of its parents; then ROS_PACKAGE_PATH, whose entries may
/// be the package itself or a folder of packages.
std::vector<std::filesystem::path> candidatePaths(const std::string& reference,
                                                  const std::filesystem::path& folder,
                                                  const LoadOptions& options);

}  // namespace swept::detail
