// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/last_resort.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>

#include "command_line/exit_code.hpp"
#include "output/terminal_text.hpp"
#include "swept/robot_model/foreign_text.hpp"

namespace swept {
namespace {

/// Runs in a signal handler: nothing but write and _exit is allowed. What failed is on stderr
/// already.
void onAbort(int) {
  constexpr std::string_view kMessage = "swept: error: stopped by a failed assertion\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
  _exit(static_cast<int>(ExitCode::BadInput));
}

/// Other threads go on running, so nothing is torn down.
[[noreturn]] void onTerminate() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
    std::fputs("swept: error: terminated\n", stderr);
  } catch (const std::exception& error) {
    printMessage("swept: error: " + foreignText(error.what()));
  } catch (...) {
    std::fputs("swept: error: unknown exception\n", stderr);
  }
  std::_Exit(static_cast<int>(ExitCode::BadInput));
}

}  // namespace

void installLastResort() {
  std::set_terminate(onTerminate);
  std::signal(SIGABRT, onAbort);
  // A file that may not grow is an error of its write, as a full disk is.
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace swept
