// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>

namespace swept {

/// `; did you mean 'elbow'?`, of the known name that takes the fewest letters to be put in, left
/// out, changed, or exchanged with the next one. Empty when none is near.
std::string didYouMean(const std::string& name, std::span<const std::string> known);

}  // namespace swept
