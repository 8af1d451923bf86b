// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <exception>
#include <iostream>
#include <optional>
#include <string_view>

#include "data_folder.hpp"

namespace swept::benchmark {

/// What main() returns: 2, after the usage, if the arguments were not understood; EXIT_FAILURE if
/// `run(options)` is false, or throws, after the exception's message; else EXIT_SUCCESS.
template <typename Options, typename Run>
int exitCodeOf(const std::optional<Options>& options, std::string_view usage, const Run& run) {
  if (!options) {
    std::cerr << "usage: " << usage << '\n';
    return 2;
  }
  try {
    return run(*options) ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
}

/// The same for `run(options, folder)`, which needs the data folder: without one it is skipped.
template <typename Options, typename Run>
int exitCodeWithData(const std::optional<Options>& options, std::string_view usage,
                     const Run& run) {
  return exitCodeOf(options, usage, [&run](const Options& understood) {
    const auto data = dataFolder();
    if (data) return run(understood, *data);
    std::cout << "skipped: SWEPT_DATA names no folder\n";
    return true;
  });
}

}  // namespace swept::benchmark
