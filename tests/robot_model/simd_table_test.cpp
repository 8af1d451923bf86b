// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <vector>

#include "simd/tables/table_motion.hpp"
#include "swept/core/distance.hpp"
#include "table_robots.hpp"

namespace swept::simd_test {
namespace {

using detail::SimdBodyPair;
using Values = std::array<float, PairSeparationTable::kMostJoints>;

/// Whether every checked pair of geometry of the two bodies is apart in exact geometry.
bool apart(const CheckerModel& model, const SimdBodyPair& bodies,
           const std::array<double, 2>& values) {
  const Eigen::Isometry3d a_from_b = Poses(model, bodies.table->axes, bodies.table->joints)
                                         .between(bodies.bodyA, bodies.bodyB, values);
  for (const detail::GeometryPair& pair : model.pairs) {
    if (!pair.self) continue;
    const detail::RobotGeometry& a = model.robotGeometry[pair.a];
    const detail::RobotGeometry& b = model.robotGeometry[pair.b];
    if (a.body != bodies.bodyA || b.body != bodies.bodyB) continue;
    const Eigen::Isometry3d between = a.body_from_shape.inverse() * a_from_b * b.body_from_shape;
    if (collide(a.shape, b.shape, between) != Contact::Separate) return false;
  }
  return true;
}

/// What chooseTables gives a changed model of the tables of another one, per pair of bodies.
template <typename Change>
std::vector<bool> tablesAfter(const CheckerModel& model, const Change& change) {
  CheckerModel changed = model;
  changeGeometry(changed, change);
  for (SimdBodyPair& bodies : changed.simd.bodyPairs) bodies.table = nullptr;
  detail::chooseTables(changed, *model.simd.tables, changed.simd);
  std::vector<bool> has;
  for (const SimdBodyPair& bodies : changed.simd.bodyPairs) has.push_back(bodies.table != nullptr);
  return has;
}

/// Pieces of equal shape share a cover, wherever they are.
TEST(SimdTable, HoldsForGeometryThatStandsWhereItDid) {
  using Geometry = detail::RobotGeometry;
  for (const Named& robot : robotsWithTables()) {
    SCOPED_TRACE(robot.name);
    const CheckerModel& model = *robot.model;
    const std::vector<bool> before = tablesAfter(model, [](std::vector<Geometry>&) {});
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_EQ(before[i], model.simd.bodyPairs[i].table != nullptr);
    const auto expectNone = [&](std::size_t piece, const auto& change) {
      const std::vector<bool> after =
          tablesAfter(model, [&](std::vector<Geometry>& all) { change(all[piece]); });
      std::vector<bool> expected = before;
      for (std::size_t i = 0; i < model.pairCount(); ++i) {
        const detail::GeometryPair pair = model.pair(i);
        const int own = static_cast<int>(piece);
        if (pair.self && (pair.a == own || pair.b == own))
          expected[static_cast<std::size_t>(model.simd.sources[i].bodyPair)] = false;
      }
      EXPECT_EQ(after, expected) << "piece " << piece;
    };
    std::set<int> bodies;
    for (std::size_t i = 0; i < model.robotGeometry.size(); ++i) {
      const Geometry& piece = model.robotGeometry[i];
      if (!bodies.insert(piece.body).second) continue;
      expectNone(i, [](Geometry& moved) { moved.body_from_shape.translation().x() += 1e-9; });
      expectNone(i, [](Geometry& moved) {
        moved.body_from_shape.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
      });
      expectNone(i, [](Geometry& grown) { grown.scale *= 1.1; });
      expectNone(i, [](Geometry& other) { other.shape = Sphere{0.4}; });
      expectNone(i, [](Geometry& other) { ++other.body; });
    }
  }
}

/// A box of joint values within the table's range, from a point to a fifth of it.
void randomBox(Random& random, const PairSeparationTable& table, Values& lower, Values& upper) {
  for (int k = 0; k < table.joints; ++k) {
    const PairSeparationTable::Axis& axis = table.axes[k];
    const auto range = static_cast<double>(axis.upper - axis.lower);
    const double width = random.chance(0.3) ? 0.0 : range * random.scale(1e-4, 0.2);
    const double begin = static_cast<double>(axis.lower) + random.uniform(0.0, range - width);
    lower[k] = std::max(axis.lower, static_cast<float>(begin));
    upper[k] = std::min(axis.upper, static_cast<float>(begin + width));
  }
}

/// Wider and wider about its middle for as long as the table says that it is free: what it ends
/// with borders on what is not.
void growWhileFree(const PairSeparationTable& table, Values& lower, Values& upper) {
  for (int step = 0; step < 400; ++step) {
    Values low = lower;
    Values high = upper;
    for (int k = 0; k < table.joints; ++k) {
      const PairSeparationTable::Axis& axis = table.axes[k];
      const float cell = 2.0F / axis.partsPerUnit;
      low[k] = std::max(axis.lower, low[k] - cell);
      high[k] = std::min(axis.upper, high[k] + cell);
    }
    if (!table.free(low, high)) return;
    lower = low;
    upper = high;
  }
}

struct Share {
  int asked = 0;
  int free = 0;
};

void tryToRefute(Random& random, const CheckerModel& model, const SimdBodyPair& bodies,
                 Share& share) {
  const PairSeparationTable& table = *bodies.table;
  for (int box = 0; box < 400; ++box) {
    Values lower{};
    Values upper{};
    randomBox(random, table, lower, upper);
    ++share.asked;
    if (!table.free(lower, upper)) continue;
    ++share.free;
    growWhileFree(table, lower, upper);
    for (int sample = 0; sample < 6; ++sample) {
      std::array<double, 2> values{};
      for (int k = 0; k < table.joints; ++k) {
        // Corners and edges too.
        const int where = random.below(4);
        const auto low = static_cast<double>(lower[k]);
        const auto high = static_cast<double>(upper[k]);
        values[k] = where == 0 ? low : where == 1 ? high : random.uniform(low, high);
      }
      ASSERT_TRUE(apart(model, bodies, values)) << "bodies " << bodies.bodyA << ", " << bodies.bodyB
                                                << " at " << values[0] << ", " << values[1];
    }
  }
}

TEST(SimdTable, NothingMeetsInCellsThatAreFree) {
  Random random(41);
  int single = 0;
  int twofold = 0;
  for (const Named& robot : robotsWithTables()) {
    SCOPED_TRACE(robot.name);
    Share share;
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      if (bodies.table == nullptr) continue;
      ++(bodies.table->joints == 1 ? single : twofold);
      tryToRefute(random, *robot.model, bodies, share);
      if (HasFatalFailure()) return;
    }
    const double free = static_cast<double>(share.free) / share.asked;
    RecordProperty("free_" + robot.name, std::to_string(free));
    EXPECT_GT(free, 0.2);
    EXPECT_GT(share.asked, 100);
  }
  EXPECT_GT(twofold, 4);
  // Neighbours along an arm are not checked, so few tables are of one joint.
  EXPECT_GE(single, 1);
}

/// A box within a single part of a cell, up to its borders.
bool randomFreePart(Random& random, const PairSeparationTable& table, Values& lower,
                    Values& upper) {
  for (int k = 0; k < table.joints; ++k) {
    const PairSeparationTable::Axis& axis = table.axes[k];
    const double part = 1.0 / static_cast<double>(axis.partsPerUnit);
    const int index = random.below(axis.cells * PairSeparationTable::kParts);
    const double low = static_cast<double>(axis.lower) + part * index;
    lower[k] = std::max(axis.lower, static_cast<float>(low + 1e-3 * part));
    upper[k] = std::min(axis.upper, static_cast<float>(low + (1.0 - 1e-3) * part));
    if (!(lower[k] < upper[k])) return false;
  }
  const PairSeparationTable::Cell* cell = table.cellAt(lower);
  return cell != nullptr && cell->openPairs != 0 && table.free(lower, upper);
}

/// In cells that are not proven as a whole.
TEST(SimdTable, NothingMeetsInPartsThatAreFree) {
  Random random(44);
  int tables = 0;
  int parts = 0;
  for (const Named& robot : robotsWithTables()) {
    SCOPED_TRACE(robot.name);
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      if (bodies.table == nullptr || bodies.table->openParts.empty()) continue;
      const PairSeparationTable& table = *bodies.table;
      const int before = parts;
      for (int i = 0; i < 100'000 && parts < before + 60; ++i) {
        Values lower{};
        Values upper{};
        if (!randomFreePart(random, table, lower, upper)) continue;
        ++parts;
        EXPECT_EQ(table.openPairs(lower, upper), 0);
        for (int sample = 0; sample < 5; ++sample) {
          std::array<double, 2> values{};
          for (int k = 0; k < table.joints; ++k)
            values[k] = static_cast<double>(random.chance(0.5) ? lower[k] : upper[k]);
          ASSERT_TRUE(apart(*robot.model, bodies, values))
              << "bodies " << bodies.bodyA << ", " << bodies.bodyB << " at " << values[0] << ", "
              << values[1];
        }
      }
      tables += parts > before ? 1 : 0;
    }
  }
  EXPECT_GT(tables, 6);
  EXPECT_GT(parts, 300);
}

/// What a box is said to be does not depend on whether cells are looked up as one or one by one.
TEST(SimdTable, ABoxIsFreeWhereNoPairIsOpen) {
  Random random(45);
  int free = 0;
  int open = 0;
  for (const Named& robot : robotsWithTables()) {
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      if (bodies.table == nullptr) continue;
      for (int i = 0; i < 2000; ++i) {
        Values lower{};
        Values upper{};
        randomBox(random, *bodies.table, lower, upper);
        for (int k = 0; k < bodies.table->joints; ++k)
          upper[k] = std::min(upper[k], lower[k] + 20.0F / bodies.table->axes[k].partsPerUnit);
        const bool isFree = bodies.table->free(lower, upper);
        ++(isFree ? free : open);
        EXPECT_EQ(isFree, bodies.table->openPairs(lower, upper) == 0);
      }
    }
  }
  EXPECT_GT(free, 1000);
  EXPECT_GT(open, 1000);
}

/// Of arms like this all such pairs have a table, and with it most motions are settled.
TEST(SimdTable, PairsThatAreCloseInMostOfTheirRangeHaveOne) {
  for (const Named& robot : robotsWithTables()) {
    if (robot.name != "universal") continue;
    int tables = 0;
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      const auto motion = detail::TableMotion::between(*robot.model, robot.model->simd, bodies);
      if (!motion) continue;
      SCOPED_TRACE(std::to_string(bodies.bodyA) + ", " + std::to_string(bodies.bodyB));
      ASSERT_NE(bodies.table, nullptr);
      ++tables;
      for (const PairSeparationTable::Cell& cell : bodies.table->cells) ASSERT_FALSE(cell.coarse);
    }
    EXPECT_EQ(tables, 5);
  }
}

/// Where bodies do meet, the table says so.
TEST(SimdTable, NoContactIsInAFreeCell) {
  Random random(42);
  int contacts = 0;
  for (const Named& robot : robotsWithTables()) {
    SCOPED_TRACE(robot.name);
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      if (bodies.table == nullptr) continue;
      const PairSeparationTable& table = *bodies.table;
      for (int i = 0; i < 400; ++i) {
        Values at{};
        std::array<double, 2> values{};
        for (int k = 0; k < table.joints; ++k) {
          const PairSeparationTable::Axis& axis = table.axes[k];
          values[k] =
              random.uniform(static_cast<double>(axis.lower), static_cast<double>(axis.upper));
          at[k] = static_cast<float>(values[k]);
        }
        if (apart(*robot.model, bodies, values)) continue;
        ++contacts;
        EXPECT_FALSE(table.free(at, at));
      }
    }
  }
  EXPECT_GT(contacts, 200);
}

TEST(SimdTable, NothingIsKnownOutsideTheLimitsOrOfWhatIsNoNumber) {
  const float bad = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  Random random(43);
  int asked = 0;
  for (const Named& robot : robotsWithTables()) {
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      if (bodies.table == nullptr) continue;
      const PairSeparationTable& table = *bodies.table;
      for (int i = 0; i < 200; ++i) {
        Values lower{};
        Values upper{};
        randomBox(random, table, lower, upper);
        if (!table.free(lower, upper)) continue;
        ++asked;
        const int k = random.below(table.joints);
        const auto spoil = [&](float low, float high) {
          Values from = lower;
          Values to = upper;
          from[k] = low;
          to[k] = high;
          return table.free(from, to);
        };
        EXPECT_FALSE(spoil(bad, upper[k]));
        EXPECT_FALSE(spoil(lower[k], bad));
        EXPECT_FALSE(spoil(bad, bad));
        EXPECT_FALSE(spoil(std::nextafter(table.axes[k].lower, -infinity), upper[k]));
        EXPECT_FALSE(spoil(lower[k], std::nextafter(table.axes[k].upper, infinity)));
        EXPECT_FALSE(spoil(-infinity, infinity));
      }
    }
  }
  EXPECT_GT(asked, 500);
}

}  // namespace
}  // namespace swept::simd_test
