// SPDX-License-Identifier: BSD-3-Clause
// trajectory_refute: tries to prove certifyTrajectory wrong on random curves in random tubes. Exit
// code 1 when it did.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "in_parts.hpp"
#include "trajectories/campaign.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): CLI throws where the options below are wrong.
int main(int argc, char** argv) {
  trajectories::CampaignOptions options;
  std::uint64_t report = 1000;
  CLI::App app{"Tries to prove certifyTrajectory wrong on random curves in random tubes."};
  app.add_option("--count", options.count, "how many curves");
  app.add_option("--first", options.first, "index of the first; alone, only this one is run");
  app.add_option("--seed", options.seed);
  app.add_option("--samples", options.samples,
                 "most of one curve; 0: every millisecond and milliradian");
  app.add_option("--seconds", options.seconds, "that a curve takes at most")
      ->check(CLI::PositiveNumber);
  app.add_option("--stage", options.curvesOfStage, "curves of each robot, world and tube in turn")
      ->check(CLI::PositiveNumber);
  app.add_option("--report", report, "a line after so many curves")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  if (app.count("--first") > 0 && app.count("--count") == 0) options.count = 1;
  try {
    return runInParts(options, report, trajectories::runCampaign).failures.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
