// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace swept::test {

/// The message of the std::invalid_argument that `action` throws; empty when it throws none.
template <typename Action>
std::string messageOf(const Action& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

}  // namespace swept::test
