// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <regex>

#include "gantry.hpp"

/// Problems of which none is solved.
namespace swept::test {
namespace {

Outcome blocked(const Gantry& gantry, const std::vector<std::string>& more) {
  std::vector<std::string> words{"--problems", gantry.problems, "--set", "blocked",
                                 "--time",     "0.1",           "-q"};
  words.insert(words.end(), more.begin(), more.end());
  return gantry.run("plan", words);
}

/// A median of 0 s would be that of problems that were solved at once.
TEST(PlanSets, ThereAreNoTimesOfNothingSolved) {
  const Gantry gantry;
  const Outcome run = blocked(gantry, {});
  for (const std::string row : {"blocked", "total"})
    EXPECT_TRUE(std::regex_search(run.out, std::regex("\n" + row + " +0/3 +0/0 +- +- +-\n")))
        << run.out;
  const auto json = jsonOf(blocked(gantry, {"--json"}));
  ASSERT_EQ(json["sets"].size(), 2u);
  for (const auto& row : json["sets"])
    for (const std::string key : {"median", "mean", "p95"})
      EXPECT_TRUE(row[key].is_null()) << key << " is " << row[key];
}

/// Why the exit code is 3 is on stderr, whatever is on stdout, once for each problem.
TEST(PlanSets, BadInputIsToldOnStderrToo) {
  const Gantry gantry;
  const std::string message =
      "swept: error: problem blocked 9, start: slide is 3, allowed is -0.5 to 2.5 m\n";
  for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--json"}}) {
    const Outcome run = blocked(gantry, more);
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.err, message);
  }
}

}  // namespace
}  // namespace swept::test
