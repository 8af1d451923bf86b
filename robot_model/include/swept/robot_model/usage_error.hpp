// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace swept {

/// What a caller asks for and cannot be done, where no file that is read is to blame: an option, a
/// state, a file that cannot be written. what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace swept
