// SPDX-License-Identifier: BSD-3-Clause
// pair_refute: tries to prove distances of random pairs of shapes wrong. Exit code 1 when it did.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <map>

#include "in_parts.hpp"
#include "pairs/campaign.hpp"

namespace {

void printPairs(const pairs::CampaignReport& report) {
  for (int i = 0; i < pairs::kKinds; ++i) {
    for (int j = 0; j < pairs::kKinds; ++j) {
      if (report.pairs[i][j] == 0) continue;
      std::cout << "  " << sweeps::kKindNames[i] << ", " << sweeps::kKindNames[j] << ": "
                << report.pairs[i][j] << ", " << report.apartOf[i][j] << " of them apart\n";
    }
  }
}

}  // namespace

// NOLINTNEXTLINE(bugprone-exception-escape): CLI throws where the options below are wrong.
int main(int argc, char** argv) {
  pairs::CampaignOptions options;
  std::uint64_t report = 100000;
  bool table = false;
  std::map<std::string, int> kinds;
  for (int i = 0; i < pairs::kKinds; ++i) kinds[std::string(sweeps::kKindNames[i])] = i;
  CLI::App app{"Tries to prove distances of random pairs of shapes wrong."};
  app.add_option("--count", options.count, "how many pairs");
  auto* first =
      app.add_option("--first", options.first, "index of the first; alone, only this one is made");
  app.add_option("--seed", options.seed);
  app.add_option("--placings", options.placings, "of each pair")->check(CLI::PositiveNumber);
  auto* kindA = app.add_option("--a", options.kindA, "kind of the first shape of all pairs")
                    ->transform(CLI::CheckedTransformer(kinds));
  auto* kindB = app.add_option("--b", options.kindB, "kind of the second")
                    ->transform(CLI::CheckedTransformer(kinds));
  kindA->needs(kindB);
  kindB->needs(kindA);
  app.add_option("--report", report, "a line after so many pairs")->check(CLI::PositiveNumber);
  app.add_flag("--table", table, "print at the end how many of each two kinds there were");
  CLI11_PARSE(app, argc, argv);
  if (first->count() > 0 && app.count("--count") == 0) options.count = 1;
  try {
    const pairs::CampaignReport total = runInParts(options, report, pairs::runCampaign);
    if (table) printPairs(total);
    return total.failures.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
