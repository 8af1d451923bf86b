// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

namespace swept {

/// Returns `; did you mean 'elbow'?` for the known name at the least edit distance (insert, delete
/// or change a letter, or exchange two neighbours). Empty if no name is near.
std::string didYouMean(const std::string& name, std::span<const std::string> known);

}  // namespace swept
