// SPDX-License-Identifier: BSD-3-Clause
#include <exception>
#include <iostream>
#include <new>

#include "arguments.hpp"
#include "commands.hpp"
#include "exit_code.hpp"
#include "last_resort.hpp"
#include "swept/robot_model/input.hpp"

namespace {

swept::ExitCode run(const swept::Arguments& args) {
  if (args.command == "info") return swept::runInfo(args);
  if (args.command == "check") return swept::runCheck(args);
  if (args.command == "motion") return swept::runMotion(args);
  if (args.command == "acm") return swept::runAcm(args);
  if (args.command == "replay") return swept::runReplay(args);
  if (args.command == "bench edges") return swept::runBenchEdges(args);
  return swept::runPlan(args);
}

int guardedMain(int argc, char** argv) {
  const swept::ParsedArguments parsed = swept::parseArguments(argc, argv);
  const int code = parsed.run ? static_cast<int>(run(*parsed.run)) : parsed.exitCode;
  // A full disk must not look like a result.
  if (!std::cout.flush()) throw swept::UsageError("cannot write to standard output");
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  swept::installLastResort();
  try {
    return guardedMain(argc, argv);
  } catch (const swept::InputError& error) {
    std::cerr << error.what() << '\n';
  } catch (const std::bad_alloc&) {
    std::cerr << "swept: error: out of memory\n";
  } catch (const std::exception& error) {
    std::cerr << "swept: error: " << error.what() << '\n';
  } catch (...) {
    std::cerr << "swept: error: unknown exception\n";
  }
  return static_cast<int>(swept::ExitCode::BadInput);
}
