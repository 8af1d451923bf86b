// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// A proof that robot_model/verify can check.
// NOLINTNEXTLINE(bugprone-exception-escape): Json's move is noexcept, which is not believed of it.
struct Certificate {
  Json model;           ///< what it is about; see modelJson()
  Json proof;           ///< null: there is none
  std::string missing;  ///< why; empty: there is one
};

/// Looks for planes that prove every segment of a path, of which each is proven free by the
/// checker already. They show that what has to keep apart keeps more than half of what
/// `clearances` (m, one per segment, proven) has above the margin; bodies that are out of a link's
/// reach, which these are not about, more than the margin. Throws UsageError for moving obstacles.
Certificate certificateOf(const Checker& checker, std::span<const std::vector<double>> states,
                          std::span<const double> clearances);

}  // namespace swept
