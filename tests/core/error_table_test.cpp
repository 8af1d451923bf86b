// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

#include "error_table_row.hpp"
#include "models_dir.hpp"
#include "rounded_up.hpp"

/// How far off distances, depths and witness points of each pair of shapes are, against truths in
/// 50 digits, and that no interval misses its truth. The table in core/README.md states the errors;
/// SWEPT_PRINT_TABLE=1 prints what it has to say.
namespace {

using namespace error_table;
using swept::test::roundedUp;

constexpr int kApart = 800;
constexpr int kOverlapping = 240;
const std::string kReadme = modelsDir() + "/../core/README.md";

double quantile(std::vector<double> errors, double share) {
  const auto index = static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1));
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(index),
                   errors.end());
  return errors[index];
}

constexpr std::size_t kNumbers = 5;
const std::array<const char*, kNumbers> kHeads = {"distance max", "99.9 %", "depth max", "99.9 %",
                                                  "witness max"};

/// NaN where there is nothing to measure.
std::array<double, kNumbers> numbersOf(const Row& row) {
  const auto number = [](const Column& column, double share) {
    return column.errors.empty() ? std::nan("") : quantile(column.errors, share);
  };
  return {number(row.distance, 1.0), number(row.distance, 0.999), number(row.depth, 1.0),
          number(row.depth, 0.999), number(row.witness, 1.0)};
}

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line.substr(line.find('|') + 1));
  for (std::string cell; std::getline(stream, cell, '|');) {
    const auto first = cell.find_first_not_of(' ');
    cells.push_back(first == std::string::npos
                        ? ""
                        : cell.substr(first, cell.find_last_not_of(' ') - first + 1));
  }
  return cells;
}

/// The rows of the table in the README, by the name of the pair.
std::map<std::string, std::vector<std::string>> readTable() {
  std::map<std::string, std::vector<std::string>> rows;
  std::ifstream file(kReadme);
  bool inside = false;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("<!-- /error-table")) break;
    if (inside && line.starts_with("|") && !line.starts_with("|--")) {
      std::vector<std::string> cells = cellsOf(line);
      const std::string name = cells.front();
      if (name == "pair") continue;
      cells.erase(cells.begin());
      rows[name] = cells;
    }
    inside |= line.starts_with("<!-- error-table");
  }
  return rows;
}

using PairOfKinds = std::pair<std::size_t, std::size_t>;

std::string nameOf(const PairOfKinds& pair) {
  return std::string(kinds()[pair.first].name) + ", " + kinds()[pair.second].name;
}

std::vector<PairOfKinds> allPairs() {
  std::vector<PairOfKinds> pairs;
  for (std::size_t i = 0; i < kinds().size(); ++i) {
    for (std::size_t j = i; j < kinds().size(); ++j) pairs.emplace_back(i, j);
  }
  return pairs;
}

bool wantsTable() {
  return std::getenv("SWEPT_PRINT_TABLE") != nullptr;
}

class ErrorTable : public testing::TestWithParam<PairOfKinds> {
 protected:
  static void TearDownTestSuite() {
    if (!wantsTable()) return;
    std::cout << "| pair";
    for (const char* head : kHeads) std::cout << " | " << head;
    std::cout << " |\n|---|---|---|---|---|---|\n";
    for (const std::string& line : printed()) std::cout << line;
  }
  static std::vector<std::string>& printed() {
    static std::vector<std::string> lines;
    return lines;
  }
};

/// Parallel planes do not overlap, and the depth of a cloud is not that of its hull.
bool hasDepth(const PairOfKinds& pair) {
  return nameOf(pair) != "plane, plane" && !nameOf(pair).ends_with("point cloud");
}

/// Every feature of a bounded shape touches a bounded one.
void expectFeatures(const Kind& kind, const std::array<int, kFeatures>& counts) {
  for (const Feature feature : kind.features) {
    EXPECT_GE(counts[static_cast<std::size_t>(feature)], kApart / 40)
        << kind.name << ", feature " << static_cast<int>(feature);
  }
}

TEST_P(ErrorTable, IntervalsHoldTheTruthAndErrorsAreAsStated) {
  const auto [i, j] = GetParam();
  const Row row = RowSampler(kinds()[i], kinds()[j], 100 * i + j).run(kApart, kOverlapping);
  for (const auto& [what, wrong] : row.wrong) {
    ADD_FAILURE() << what << ", " << wrong.count << " times, by up to " << wrong.worst
                  << " of the size:\n"
                  << wrong.worstCase;
  }
  const bool flat = kinds()[i].isFlat || kinds()[j].isFlat;
  if (!flat) {
    expectFeatures(kinds()[i], row.featuresA);
    expectFeatures(kinds()[j], row.featuresB);
  }
  EXPECT_GE(row.depth.errors.size(), hasDepth(GetParam()) ? kOverlapping / 3 : 0);
  const std::array<double, kNumbers> measured = numbersOf(row);
  const std::string name = nameOf(GetParam());
  std::string line = "| " + name;
  for (const double x : measured) line += " | " + (std::isnan(x) ? "–" : roundedUp(x));
  printed().push_back(line + " |\n");
  if (wantsTable()) return;
  static const auto stated = readTable();
  ASSERT_TRUE(stated.contains(name)) << "no row " << name << " in " << kReadme;
  const std::vector<std::string>& cells = stated.at(name);
  ASSERT_EQ(cells.size(), kNumbers);
  const std::array<const Column*, kNumbers> columns = {&row.distance, &row.distance, &row.depth,
                                                       &row.depth, &row.witness};
  for (std::size_t k = 0; k < kNumbers; ++k) {
    if (std::isnan(measured[k])) {
      EXPECT_EQ(cells[k], "–") << kHeads[k];
    } else {
      EXPECT_LE(measured[k], std::strtod(cells[k].c_str(), nullptr))
          << kHeads[k] << " of " << name << "; the worst:\n"
          << columns[k]->worstCase;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, ErrorTable, testing::ValuesIn(allPairs()), [](const auto& drawn) {
  std::string name = nameOf(drawn.param);
  std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
  std::replace(name.begin(), name.end(), ',', '_');
  return name;
});

TEST(ErrorTableRows, CrossingPlanesTouchAndHaveNoWayApart) {
  Random random(7);
  for (int i = 0; i < 300; ++i) {
    const swept::HalfSpace halfSpace{random.direction(), random.uniform(-1.0, 1.0)};
    const swept::Plane plane{random.direction(), random.uniform(-1.0, 1.0)};
    Isometry3d pose = Isometry3d::Identity();
    const double angle = random.uniform(0.1, 3.0);
    pose.linear() = Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix();
    pose.translation() = random.inBall();
    const std::array<swept::Shape, 2> flats = {halfSpace, plane};
    for (const swept::Shape& a : flats) {
      for (const swept::Shape& b : flats) {
        const auto found = swept::signedDistance(a, b, pose);
        EXPECT_EQ(found.lower, -std::numeric_limits<double>::infinity());
        EXPECT_EQ(found.upper, -std::numeric_limits<double>::infinity());
        const auto apart = swept::distance(a, b, pose);
        EXPECT_EQ(apart.lower, 0.0);
        EXPECT_EQ(apart.upper, 0.0);
      }
    }
  }
}

/// Ellipsoids have both: depths known by construction, and depths found among all directions.
TEST(ErrorTableOracle, TheSearchFindsDepthsThatAreKnown) {
  Random random(8);
  for (const Kind& kind : kinds()) {
    for (int i = 0; i < 60; ++i) {
      const Solid a = drawEllipsoid(random, 1.0);
      const Solid b = kind.draw(random, random.decades(-2.0, 2.0));
      if (kind.isFlat || b.body.radius > 0.0 || !b.body.convex) continue;
      const Placement placement = placeShallow(a.body, b.body, random);
      const Truth found = DeepestOverlap(a.body, b.body, placement.a_from_b).run(Vector3d::Zero());
      const double off = Real(found.upper - placement.truth.upper).convert_to<double>();
      EXPECT_NEAR(off, 0.0, 3e-15 * (1.0 + b.body.extent)) << kind.name << " " << i;
    }
  }
}

TEST(ErrorTableRows, AreThoseOfTheReadme) {
  EXPECT_EQ(readTable().size(), allPairs().size());
}

}  // namespace
