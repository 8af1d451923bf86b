// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <unistd.h>

#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>

#include "command_line/arguments.hpp"
#include "command_line/command.hpp"
#include "command_line/distinct_files.hpp"
#include "command_line/exit_code.hpp"
#include "command_line/last_resort.hpp"
#include "output/terminal_text.hpp"
#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/input.hpp"

namespace {

/// What is opened next gets the number of a standard stream that is closed, and what is meant for
/// the stream. So each of the three is open before anything else is. For reading only: what is
/// written to one that was closed is lost, and has to be an error.
void openStandardStreams() {
  int descriptor = STDIN_FILENO;
  while (descriptor >= 0 && descriptor <= STDERR_FILENO) descriptor = open("/dev/null", O_RDONLY);
  if (descriptor >= 0) close(descriptor);
}

int guardedMain(int argc, char** argv) {
  const swept::EscapedOutput escaped;
  const swept::ParsedArguments parsed = swept::parseArguments(argc, argv);
  if (parsed.run) swept::requireDistinctFiles(*parsed.run);
  const int code =
      parsed.run ? static_cast<int>(parsed.run->command->run(*parsed.run)) : parsed.exitCode;
  // A full disk must not look like a result.
  if (!std::cout.flush()) throw swept::UsageError("cannot write to standard output");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  openStandardStreams();
  swept::installLastResort();
  try {
    return guardedMain(argc, argv);
  } catch (const swept::InputError& error) {
    swept::printMessage(error.what());
  } catch (const swept::UsageError& error) {
    swept::printMessage(std::string("swept: error: ") + error.what());
  } catch (const std::bad_alloc&) {
    std::cerr << "swept: error: out of memory\n";
  } catch (const std::system_error& error) {
    // What a thread that cannot be started throws.
    const bool threads = error.code() == std::errc::resource_unavailable_try_again;
    swept::printMessage(std::string("swept: error: ") +
                        (threads ? "out of memory, or of threads" : error.what()));
  } catch (const std::exception& error) {
    swept::printMessage("swept: error: " + swept::foreignText(error.what()));
  } catch (...) {
    std::cerr << "swept: error: unknown exception\n";
  }
  return static_cast<int>(swept::ExitCode::BadInput);
}
