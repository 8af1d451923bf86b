// SPDX-License-Identifier: BSD-3-Clause
// Exceptions that nobody catches end the program with a message, and without a core dump.
#include "command_line/last_resort.hpp"

#include <gtest/gtest.h>

#include <exception>
#include <stdexcept>
#include <thread>

#include "command_line/exit_code.hpp"

namespace swept {
namespace {

/// As some of OMPL's planners do, which have threads of their own.
template <typename Thrown>
void throwInAThread(const Thrown& thrown) {
  installLastResort();
  std::thread([&] { throw thrown; }).join();
}

TEST(LastResort, NamesWhatAThreadThrows) {
  const auto badInput = testing::ExitedWithCode(static_cast<int>(ExitCode::BadInput));
  EXPECT_EXIT(throwInAThread(std::runtime_error("no samples")), badInput,
              "^swept: error: no samples\n$");
  EXPECT_EXIT(throwInAThread(7), badInput, "^swept: error: unknown exception\n$");
  EXPECT_EXIT(
      {
        installLastResort();
        std::terminate();
      },
      badInput, "^swept: error: terminated\n$");
}

}  // namespace
}  // namespace swept
