// SPDX-License-Identifier: BSD-3-Clause
// Continuous collision: the piano in the apartment, links past obstacles, and the error of the
// first contact against time. Exit code 1 if an answer of ours is wrong.
#include <cstdlib>
#include <cstring>
#include <exception>

#include "continuous_curves.hpp"
#include "continuous_link.hpp"
#include "continuous_piano.hpp"

namespace swept::benchmark {
namespace {

constexpr const char* kUsage =
    "usage: continuous_benchmark [piano] [link] [error] [--csv FILE] [--svg FILE]\n";

int run(int argc, char** argv) {
  bool piano = false, link = false, error = false;
  CurveFiles files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "piano") {
      piano = true;
    } else if (word == "link") {
      link = true;
    } else if (word == "error") {
      error = true;
    } else if ((word == "--csv" || word == "--svg") && i + 1 < argc) {
      (word == "--csv" ? files.csv : files.svg) = argv[++i];
    } else {
      std::fputs(kUsage, stderr);
      return EXIT_FAILURE;
    }
  }
  const bool all = !piano && !link && !error;
  int wrong = 0;
  if (all || piano) wrong += pianoPart();
  if (all || link) wrong += linkPart();
  if (all || error) wrong += errorPart(files);
  return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  try {
    return swept::benchmark::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "continuous_benchmark: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
