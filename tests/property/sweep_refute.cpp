// SPDX-License-Identifier: BSD-3-Clause
// sweep_refute: tries to prove continuousCollide wrong on random sweeps. Exit code 1 when it did.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "in_parts.hpp"
#include "sweeps/campaign.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): CLI throws where the options below are wrong.
int main(int argc, char** argv) {
  sweeps::CampaignOptions options;
  std::uint64_t report = 100000;
  bool code = false;
  CLI::App app{"Tries to prove continuous collision wrong on random sweeps."};
  app.add_option("--count", options.count, "how many sweeps");
  app.add_option("--first", options.first, "index of the first; alone, only this one is run");
  app.add_option("--seed", options.seed);
  app.add_option("--symmetries", options.symmetries, "one in so many is asked in other ways too");
  app.add_option("--report", report, "a line after so many sweeps")->check(CLI::PositiveNumber);
  app.add_flag("--code", code, "print the first sweep as C++");
  CLI11_PARSE(app, argc, argv);
  if (app.count("--first") > 0 && app.count("--count") == 0) {
    options.count = 1;
    options.symmetries = 1;
  }
  try {
    if (code) std::cout << sweeps::makeSweep(options.seed, options.first).code();
    return runInParts(options, report, sweeps::runCampaign).failures.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
