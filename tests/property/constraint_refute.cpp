// SPDX-License-Identifier: BSD-3-Clause
// constraint_refute: tries to prove wrong what Checker, and the checker of proofs, say of motions
// and curves under constraints. Exit code 1 when it did.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "constraints/campaign.hpp"
#include "constraints/shown.hpp"
#include "in_parts.hpp"

int main(int argc, char** argv) try {
  constraints::CampaignOptions options;
  options.shows = constraints::isShown;
  std::uint64_t report = 1000;
  CLI::App app{"Tries to prove wrong what Checker says of motions under constraints."};
  app.add_option("--count", options.count, "how many motions");
  app.add_option("--first", options.first, "index of the first; alone, only this one is run");
  app.add_option("--seed", options.seed);
  app.add_option("--samples", options.samples,
                 "most of one motion; 0: every milliradian and millimetre");
  app.add_option("--report", report, "a line after so many motions")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  if (app.count("--first") > 0 && app.count("--count") == 0) options.count = 1;
  return runInParts(options, report, constraints::runCampaign).failures.empty() ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
