// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace swept {

/// A request that cannot be fulfilled although no input file is at fault: an option, a state, a
/// file that cannot be written. what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace swept
