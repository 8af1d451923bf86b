// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <sstream>

#include "gantry.hpp"
#include "report_files.hpp"

/// The motions that `swept report` writes, judged by hand and by another subcommand.
namespace swept::test {
namespace {

std::vector<double> numbersIn(const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> values;
  for (double value; stream >> value;) values.push_back(value);
  return values;
}

std::vector<std::string> wordsIn(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

bool isIn(const std::string& list, const std::string& name) {
  const std::vector<std::string> words = wordsIn(list);
  return std::ranges::find(words, name) != words.end();
}

/// m. Motions that come so near collide: without, few random ones do.
constexpr double kMargin = 0.4;

/// A run over the gantry, whose distances are known by hand.
class GantryReport : public testing::Test {
 protected:
  static constexpr double kTolerances[] = {0.3, 0.05, 0.001};
  static constexpr double kResolutions[] = {0.3, 0.1, 0.02};

  GantryReport() {
    json_ = jsonOf(gantry_.run(
        "report",
        {"-o", gantry_.folder().path("motions.csv"), "--json", "--passes", "1", "--margin", "0.4",
         "--motions", "3000", "--tolerances", "0.3,0.05,0.001", "--resolutions", "0.3,0.1,0.02"}));
    rows_ = csvRows(gantry_.folder().read("motions.csv"));
  }

  nlohmann::json row(const std::string& method, double setting) const {
    for (const auto& row : json_["rows"])
      if (row["part"] == "motions" && row["method"] == method && row["setting"] == setting)
        return row;
    ADD_FAILURE() << "no row of " << method << " " << setting;
    return {};
  }

  Gantry gantry_;
  nlohmann::json json_;
  std::vector<CsvRow> rows_;
};

TEST_F(GantryReport, TruthIsThatByHand) {
  ASSERT_EQ(rows_.size(), 3000u);
  int free = 0, collision = 0, near = 0;
  for (const CsvRow& row : rows_) {
    const auto from = numbersIn(row.at("from")), to = numbersIn(row.at("to"));
    ASSERT_EQ(from.size(), 2u);
    const double least = Gantry::leastDistance(from, to) - kMargin;
    EXPECT_GT(Gantry::distance(from[0], from[1]), kMargin);
    EXPECT_GT(Gantry::distance(to[0], to[1]), kMargin);
    EXPECT_NEAR(std::stod(row.at("length")), std::hypot(to[0] - from[0], to[1] - from[1]), 1e-12);
    if (row.at("truth") == "free") {
      ++free;
      EXPECT_GT(least, 0.0) << row.at("from") << " to " << row.at("to");
      near += least < 0.05 ? 1 : 0;
    } else if (row.at("truth") == "collision") {
      ++collision;
      EXPECT_LT(least, 1e-4) << row.at("from") << " to " << row.at("to");
      const double t = std::stod(row.at("t"));
      EXPECT_LE(Gantry::distance(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])),
                kMargin + 1e-9);
      EXPECT_EQ(row.at("body_a") + " " + row.at("body_b"), "cube post");
    }
  }
  EXPECT_EQ(json_["motions"]["free"], free);
  EXPECT_EQ(json_["motions"]["collision"], collision);
  // Representative.
  EXPECT_GE(free, 100);
  EXPECT_GE(collision, 100);
  EXPECT_GE(near, 20);
}

/// OMPL's discrete validator, by its definition: equal steps, none longer than the share.
bool statesAreFree(const std::vector<double>& from, const std::vector<double>& to,
                   double resolution) {
  const double extent = std::hypot(3.0, 1.0);  // of the joints' limits
  const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
  const int steps = static_cast<int>(std::ceil(length / (resolution * extent)));
  for (int i = 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    if (Gantry::distance(from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])) <=
        kMargin)
      return false;
  }
  return true;
}

TEST_F(GantryReport, MissedAreThoseWhoseStatesAreFree) {
  int before = 3000;
  for (const double resolution : kResolutions) {
    std::ostringstream name;
    name << "discrete:" << resolution;
    int missed = 0;
    for (const CsvRow& motion : rows_) {
      if (motion.at("truth") != "collision") continue;
      const bool miss =
          statesAreFree(numbersIn(motion.at("from")), numbersIn(motion.at("to")), resolution);
      EXPECT_EQ(isIn(motion.at("missed_by"), name.str()), miss) << motion.at("from");
      missed += miss ? 1 : 0;
    }
    EXPECT_EQ(row("discrete", resolution)["missed"], missed);
    EXPECT_LT(missed, before);
    before = missed;
  }
  EXPECT_GE(row("discrete", 0.3)["missed"], 20);
}

TEST_F(GantryReport, CertifiedRefusesOnlyWhatIsNearerThanItsTolerance) {
  int refused = 0;
  for (const double tolerance : kTolerances) {
    std::ostringstream name;
    name << "certified:" << tolerance;
    int count = 0;
    for (const CsvRow& motion : rows_) {
      EXPECT_FALSE(isIn(motion.at("missed_by"), name.str()));
      if (!isIn(motion.at("refused_by"), name.str())) continue;
      ++count;
      EXPECT_EQ(motion.at("truth"), "free");
      EXPECT_LE(Gantry::leastDistance(numbersIn(motion.at("from")), numbersIn(motion.at("to"))),
                kMargin + tolerance + 1e-4);
    }
    EXPECT_EQ(row("certified", tolerance)["false_alarms"], count);
    refused += count;
  }
  EXPECT_GE(refused, 3);
}

TEST(ReportTruth, DepthIsThatByHand) {
  const Gantry gantry;
  const auto json = jsonOf(
      gantry.run("report", {"-o", gantry.folder().path("m.csv"), "--json", "--passes", "1",
                            "--motions", "2000", "--tolerances", "0.1", "--resolutions", "0.3"}));
  const auto& coarse = json["rows"].at(1);
  ASSERT_EQ(coarse["method"], "discrete");
  double deepest = 0.0;
  for (const CsvRow& motion : csvRows(gantry.folder().read("m.csv"))) {
    if (!isIn(motion.at("missed_by"), "discrete:0.3")) continue;
    const auto from = numbersIn(motion.at("from")), to = numbersIn(motion.at("to"));
    for (int i = 0; i <= 2000; ++i) {
      const double t = i / 2000.0;
      const double x = 0.2 - std::abs(from[0] + t * (to[0] - from[0]) - 1.0);
      const double z = 0.2 - std::abs(from[1] + t * (to[1] - from[1]));
      // Sideways, two cubes side by side are 0.2 m deep in each other.
      deepest = std::max(deepest, std::min({x, z, 0.2}));
    }
  }
  ASSERT_GT(deepest, 0.05);
  EXPECT_LE(coarse["deepest_missed"].get<double>(), deepest + 1e-3);
  // Of a hundred states one is near the deepest.
  EXPECT_GE(coarse["deepest_missed"].get<double>(), 0.7 * deepest);
}

std::string commaSeparated(std::string values) {
  std::ranges::replace(values, ' ', ',');
  return values;
}

TEST(ReportTruth, SweptMotionSaysTheSame) {
  const TemporaryFolder folder;
  ASSERT_EQ(runSwept(rook7Report(400, {"-o", folder.path("m.csv")})).exitCode, 0);
  int missed = 0, free = 0;
  for (const CsvRow& row : csvRows(folder.read("m.csv"))) {
    const bool miss = isIn(row.at("missed_by"), "discrete:0.01");
    const bool isFree = row.at("truth") == "free";
    if (!(miss && missed < 4) && !(isFree && free < 4)) continue;
    ++(isFree ? free : missed);
    const Outcome run = runSwept({"motion", "models/robots/rook7/rook7.urdf", "--group", "arm",
                                  "--scene", "models/scenes/tunnel_trap.yaml",
                                  commaSeparated(row.at("from")), commaSeparated(row.at("to"))});
    EXPECT_EQ(run.exitCode, isFree ? 0 : 1) << run.out << run.err;
  }
  EXPECT_GE(missed, 1);
  EXPECT_EQ(free, 4);
}

}  // namespace
}  // namespace swept::test
