// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

namespace swept::detail {

/// Where something is in a document that is not the first, counted from 1. Empty ones do not count:
/// messages that ROS prints end with the line that begins another. Throws YAML::Exception.
std::optional<int> lineOfSecondDocument(const std::string& text);

/// yaml-cpp 0.7 finds empty documents without end where it cannot read on. Throws YAML::Exception
/// for such text, and for all that is no YAML.
void requireDocumentsEnd(const std::string& text);

}  // namespace swept::detail
