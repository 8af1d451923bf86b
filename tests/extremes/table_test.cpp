// SPDX-License-Identifier: BSD-3-Clause
// The table in tests/extremes/README.md, measured again. `extremes` prints a new one.
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>
#include <string>

#include "models_dir.hpp"
#include "table.hpp"

namespace {

using extremes::Cells;
using extremes::Row;

const std::string kReadme = modelsDir() + "/../tests/extremes/README.md";

const std::vector<Row>& rows() {
  static const std::vector<Row> all = extremes::measured();
  return all;
}

std::string nameOf(const Row& row) {
  return row.query + ", " + row.name;
}

TEST(Extremes, NoAnswerIsWrong) {
  for (const Row& row : rows()) {
    EXPECT_EQ(row.wrong, 0) << nameOf(row) << "\n" << row.failure;
    EXPECT_TRUE(row.honest) << nameOf(row) << "\n" << row.failure;
    EXPECT_EQ(row.right + row.undecided + row.wrong + row.far, row.n) << nameOf(row);
  }
}

TEST(Extremes, OnlyWhatIsWithinTheToleranceIsUndecided) {
  for (const Row& row : rows()) EXPECT_EQ(row.far, 0) << nameOf(row) << "\n" << row.failure;
}

TEST(Extremes, WorkIsLimited) {
  for (const Row& row : rows()) {
    if (!row.countsWork) continue;
    EXPECT_LE(row.workRatio, row.workLimit) << nameOf(row);
  }
}

/// Multiples say nothing where all the work grows: each query has a case that counts.
TEST(Extremes, OrdinaryWorkIsCounted) {
  std::set<std::string> counted, queries;
  for (const Row& row : rows()) {
    if (!row.countsWork) continue;
    queries.insert(row.query);
    if (!row.isOrdinary()) continue;
    EXPECT_GT(row.work, 0) << nameOf(row);
    counted.insert(row.query);
  }
  EXPECT_EQ(counted, queries);
}

TEST(Extremes, SamplesAreOfBothKinds) {
  for (const Row& row : rows()) {
    EXPECT_GE(row.n, 20) << nameOf(row);
    if (!row.bothSides) continue;
    EXPECT_GE(4 * row.apart, row.n) << nameOf(row);
    EXPECT_LE(4 * row.apart, 3 * row.n) << nameOf(row);
  }
}

/// Counts may change a little where truths are about as large as roundings.
void compare(const Row& row, const Cells& now, const Cells& stated) {
  for (const char* column : {"n", "apart", "wrong", "honest", "work at most"}) {
    EXPECT_EQ(now.at(column), stated.at(column)) << nameOf(row) << ", " << column;
  }
  const int slack = 2 + row.n / 20;
  EXPECT_NEAR(row.undecided, std::atoi(stated.at("undecided").c_str()), slack) << nameOf(row);
  if (row.countsWork && row.isOrdinary()) {
    EXPECT_LE(static_cast<double>(row.work), 0.5 + 1.5 * std::atof(stated.at("counted").c_str()))
        << nameOf(row);
  }
  if (row.countsWork) {
    EXPECT_LE(row.workRatio, 0.5 + 1.5 * std::atof(stated.at("work").c_str())) << nameOf(row);
  }
  if (row.hasBound) {
    EXPECT_LE(row.error, std::atof(stated.at("largest error").c_str())) << nameOf(row);
    EXPECT_LE(row.bound, std::atof(stated.at("bound").c_str())) << nameOf(row);
  }
}

TEST(Extremes, TableIsThatOfTheReadme) {
  const auto stated = extremes::readTable(kReadme);
  const auto now = extremes::cellsByName(rows());
  EXPECT_EQ(stated.size(), now.size());
  for (const Row& row : rows()) {
    const auto found = stated.find({row.query, row.name});
    ASSERT_NE(found, stated.end()) << "no row " << nameOf(row) << " in " << kReadme;
    compare(row, now.at({row.query, row.name}), found->second);
  }
}

}  // namespace
