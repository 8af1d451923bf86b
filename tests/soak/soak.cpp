// SPDX-License-Identifier: BSD-3-Clause
// soak: the library under load for long, with worlds that change; see README.md.
#include <atomic>
#include <csignal>
#include <exception>
#include <iostream>

#include "run.hpp"

namespace {

constexpr int kBadInput = 3;

std::atomic<bool> gInterrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // a signal handler may touch it

void onInterrupt(int) {
  gInterrupted = true;
}

int runProgram(const soak::Options& options) {
  const auto stages = soak::makeStages(options);
  if (options.question) return soak::askAgain(*stages.front(), options, std::cout);
  std::cout << "soak: " << options.states << " states, " << options.motions << " motions, "
            << options.threads << " threads, " << options.updates << " updates of the worlds, seed "
            << options.seed << ", one answer in " << options.sampleOneIn << " judged" << std::endl;
  soak::Result result = soak::run(options, stages, std::cout, [] { return gInterrupted.load(); });
  soak::report(result, options, std::cout);
  return soak::exitCode(result);
}

}  // namespace

int main(int argc, char** argv) {
  const soak::ParsedOptions parsed = soak::parseOptions(argc, argv);
  if (parsed.exitCode) return *parsed.exitCode;
  std::signal(SIGINT, onInterrupt);
  try {
    return runProgram(parsed.options);
  } catch (const std::exception& error) {
    std::cerr << "soak: " << error.what() << '\n';
    return kBadInput;
  }
}
