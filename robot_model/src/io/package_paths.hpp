// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "swept/robot_model/input.hpp"

namespace swept::detail {

/// The places where a mesh reference may be, in the order of the search. Empty for a scheme other
/// than `package://`, `model://` and `file://`.
///
/// `folder` is the absolute folder of the file that holds the reference. `package://NAME/rest` (and
/// `model://`, the same in simulators; slashes before NAME are passed over) means
/// LoadOptions::packages, longest name first; then rest in the folder whose package.xml says NAME,
/// of `folder` and its parents; then folder/NAME/rest for `folder` and each of its parents; then
/// ROS_PACKAGE_PATH, whose entries may be the package itself or a folder of packages; then
/// share/NAME/rest below AMENT_PREFIX_PATH. Each place is there once.
std::vector<std::filesystem::path> candidatePaths(const std::string& reference,
                                                  const std::filesystem::path& folder,
                                                  const LoadOptions& options);

/// NAME of `package://NAME/rest` and `model://NAME/rest`; empty for others.
std::string packageOf(const std::string& reference);

}  // namespace swept::detail
