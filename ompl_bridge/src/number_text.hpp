// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sstream>
#include <string>

namespace swept::detail {

/// For messages. Not as std::to_string has it, in which 1e-9 is a zero.
inline std::string numberText(double value) {
  std::ostringstream out;
  out << value;
  return out.str();
}

}  // namespace swept::detail
