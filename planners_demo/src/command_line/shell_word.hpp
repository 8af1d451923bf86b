// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace swept {

/// A word of a command line that can be pasted: in quotes where a shell would not leave it alone.
std::string shellWord(const std::string& word);

}  // namespace swept
