// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>

namespace swept::detail {

/// For messages. std::to_string would print 1e-9 as zero.
inline std::string numberText(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace swept::detail
