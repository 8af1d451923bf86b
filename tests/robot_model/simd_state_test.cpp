// SPDX-License-Identifier: BSD-3-Clause
// One state against itself, whose lanes are pairs of balls, beside eight states, a lane each.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <string>

#include "certify/state_check.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/kernels/self_walk.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "simd/search/simd_search.hpp"
#include "simd_targets.hpp"
#include "table_robots.hpp"

namespace swept::simd_test {
namespace {

using detail::SimdMode;
using detail::SimdModel;
using detail::SimdNode;
using detail::SimdScratch;
using detail::WorkspaceData;
using States = std::vector<std::vector<double>>;

std::string number(double value) {
  return std::string("'") + std::to_string(value) + "'";
}

std::string randomPiece(Random& random, double size) {
  const auto length = [&] { return random.uniform(0.02, 0.5) * size; };
  std::string shape;
  switch (random.below(3)) {
    case 0:
      shape = std::string("<sphere radius=") + number(length()) + "/>";
      break;
    case 1:
      shape =
          "<cylinder radius=" + number(0.5 * length()) + " length=" + number(2 * length()) + "/>";
      break;
    default:
      shape = std::string("<box size='") + std::to_string(length()) + " " +
              std::to_string(length()) + " " + std::to_string(2 * length()) + "'/>";
  }
  return std::string("<collision><origin xyz='") + triple(random, 0.5 * size) + "' rpy='" +
         triple(random, 3.0) + "'/><geometry>" + shape + "</geometry></collision>";
}

/// A tree of links that turn and slide. Some have several pieces, one has more than a row of eight
/// of them, one none.
std::string randomTree(Random& random) {
  std::string links;
  std::string joints;
  constexpr int kLinks = 11;
  constexpr double kSize = 0.3;
  for (int i = 0; i < kLinks; ++i) {
    const std::string name = std::string("link") + std::to_string(i);
    const int pieces = i == 4 ? 11 : i == 6 ? 0 : random.chance(0.4) ? 3 : 1;
    links += std::string("<link name='") + name + "'>";
    for (int k = 0; k < pieces; ++k) links += randomPiece(random, pieces > 3 ? 0.5 * kSize : kSize);
    links += "</link>\n";
    if (i == 0) continue;
    const int parent = random.chance(0.4) ? random.below(i) : i - 1;
    const bool slides = random.chance(0.15);
    joints += std::string("<joint name='joint") + std::to_string(i) + "' type='" +
              (slides ? "prismatic" : "revolute") + "'><parent link='link" +
              std::to_string(parent) + "'/><child link='" + name + "'/><origin xyz='" +
              triple(random, 1.5 * kSize) + "' rpy='" + triple(random, 3.0) + "'/><axis xyz='" +
              triple(random, 1.0) + "'/><limit lower='-" + (slides ? "0.2" : "2.5") +
              "' upper='2.5' effort='1' velocity='1'/></joint>\n";
  }
  return std::string("<robot name='tree'>") + links + joints + "</robot>";
}

std::vector<Named> buildTrees() {
  Random random(81);
  std::vector<Named> trees;
  for (int i = 0; i < 5; ++i) {
    const auto robot = Robot::parse(randomTree(random), "tree.urdf");
    CheckerOptions options;
    options.margin = i % 2 == 0 ? 0.0 : 0.004;
    trees.push_back(
        {"tree" + std::to_string(i), detail::compileChecker(robot, *robot->findGroup("all"),
                                                            std::make_shared<World>(), options)});
  }
  return trees;
}

/// Built once.
const std::vector<Named>& trees() {
  static const std::vector<Named> robots = buildTrees();
  return robots;
}

States randomStates(Random& random, const CheckerModel& model, int count) {
  States states(static_cast<std::size_t>(count));
  for (std::vector<double>& state : states)
    for (int i = 0; i < model.kinematics.dimension; ++i) {
      const bool bounded = std::isfinite(model.kinematics.upper[i] - model.kinematics.lower[i]);
      state.push_back(bounded ? random.uniform(model.kinematics.lower[i], model.kinematics.upper[i])
                              : random.uniform(-3.0, 3.0));
    }
  return states;
}

/// The pairs left open in the first lane, with 1 added to twice the index where that is final.
std::vector<std::uint32_t> openOf(const SimdScratch& scratch) {
  std::vector<std::uint32_t> pairs;
  for (const std::uint32_t pair : scratch.block.open)
    if ((scratch.block.openLanes[pair] & 1U) != 0)
      pairs.push_back(2 * pair + (scratch.block.finalLanes[pair] & 1U));
  std::ranges::sort(pairs);
  return pairs;
}

/// The walk of a state, and that of eight states at the same poses.
class BothWalks {
 public:
  explicit BothWalks(const SimdModel& model) : model_(model), one_(model), eight_(model) {}

  bool walk(const CheckerModel& robot, const std::vector<double>& state) {
    for (SimdScratch* scratch : {&one_, &eight_}) {
      if (!detail::compileSimdState(model_, robot.kinematics, state, *scratch)) return false;
      detail::searchStates(model_, SimdMode::State, detail::SimdContacts::Ignored, *scratch);
    }
    detail::SimdBlock& block = eight_.block;
    for (const std::uint32_t pair : block.open) block.openLanes[pair] = block.finalLanes[pair] = 0;
    block.open.clear();
    block.mode = SimdMode::States;
    detail::walkSelf(model_, eight_);
    return true;
  }

  std::vector<std::uint32_t> openOfOne() const { return openOf(one_); }
  std::vector<std::uint32_t> openOfEight() const { return openOf(eight_); }
  double rounding() const { return static_cast<double>(one_.rounding); }

 private:
  const SimdModel& model_;
  SimdScratch one_, eight_;
};

/// What covers prove they prove in either, pair by pair; tables may be asked less.
TEST(SimdState, ProvesWhatEightStatesDo) {
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    Random random(82);
    int open = 0;
    int none = 0;
    int final = 0;
    int closed = 0;
    for (const Named& tree : trees()) {
      SCOPED_TRACE(tree.name);
      SimdModel withoutTables = tree.model->simd;
      for (detail::SimdBodyPair& pair : withoutTables.bodyPairs) pair.table = nullptr;
      BothWalks covers(withoutTables);
      BothWalks tables(tree.model->simd);
      for (const std::vector<double>& state : randomStates(random, *tree.model, 300)) {
        ASSERT_TRUE(covers.walk(*tree.model, state));
        const std::vector<std::uint32_t> pairs = covers.openOfOne();
        ASSERT_EQ(pairs, covers.openOfEight());
        open += static_cast<int>(pairs.size());
        none += pairs.empty() ? 1 : 0;
        for (const std::uint32_t pair : pairs) final += static_cast<int>(pair & 1U);
        ASSERT_TRUE(tables.walk(*tree.model, state));
        const std::vector<std::uint32_t> some = tables.openOfOne();
        const std::vector<std::uint32_t> all = tables.openOfEight();
        ASSERT_TRUE(std::ranges::includes(all, some));
        for (const std::uint32_t pair : pairs)
          closed += std::ranges::binary_search(some, pair) ? 0 : 1;
      }
    }
    RecordProperty(std::string("tally_") + hwy::TargetName(target),
                   std::to_string(open) + " open, " + std::to_string(none) + " with none, " +
                       std::to_string(final) + " final");
    EXPECT_GT(open, 1000);
    EXPECT_GT(none, 100);
    EXPECT_GT(final, 100);
    EXPECT_GT(closed, 0) << "tables are not asked";
  }
}

TEST(SimdState, VerdictsAreThoseOfManyStatesAndOfExactGeometry) {
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    Random random(83);
    int asked = 0;
    int free = 0;
    int inLanes = 0;
    for (const Named& tree : trees()) {
      SCOPED_TRACE(tree.name);
      const CheckerModel& model = *tree.model;
      WorkspaceData one(model);
      WorkspaceData many(model);
      WorkspaceData exact(model);
      const States states = randomStates(random, model, 160);
      std::vector<double> values;
      for (const std::vector<double>& state : states)
        values.insert(values.end(), state.begin(), state.end());
      std::vector<Verdict> verdicts(states.size());
      detail::checkStates(model, values, verdicts, many);
      for (std::size_t i = 0; i < states.size(); ++i) {
        SCOPED_TRACE(i);
        const Verdict found = detail::checkState(model, states[i], one);
        const detail::SimdBlock& block = one.simd.block;
        inLanes += block.contactLanes != 0 || block.open.empty() ? 1 : 0;
        WorkspaceData fresh(model);
        ASSERT_EQ(found, detail::checkState(model, states[i], fresh));
        ASSERT_EQ(found, verdicts[i]);
        const StateReport report = detail::reportState(model, states[i], exact);
        ASSERT_EQ(found, report.verdict);
        ++asked;
        free += found == Verdict::Free ? 1 : 0;
      }
    }
    RecordProperty(std::string("tally_") + hwy::TargetName(target),
                   std::to_string(free) + " of " + std::to_string(asked) + " free, " +
                       std::to_string(inLanes) + " in lanes");
    EXPECT_GT(free, 0.3 * asked);
    EXPECT_LT(free, 0.7 * asked);
    EXPECT_GT(inLanes, 0.5 * asked);
  }
}

/// Margins that the balls around two bodies keep by a hair, or not.
TEST(SimdState, NoMarginIsMissedByAHair) {
  for (const std::int64_t target : simdTargets()) {
    const OnTarget on(target);
    Random random(84);
    int asked = 0;
    int within = 0;
    int proven = 0;
    for (int round = 0; round < 150; ++round) {
      ChainOptions options;
      options.types.assign(4 + static_cast<std::size_t>(random.below(12)), JointType::Revolute);
      options.branches = random.chance(0.5) ? 0.5 : 0.0;
      options.link = random.scale(1e-2, 1e1);
      CheckerModel model = robotOf(random, options);
      const int last = static_cast<int>(model.robotGeometry.size()) - 1;
      const int first = random.below(last);
      const int bodies[] = {model.robotGeometry[first].body, model.robotGeometry[last].body};
      if (bodies[0] == bodies[1]) continue;
      detail::GeometryPair pair;
      pair.a = first;
      pair.b = last;
      pair.self = true;
      pair.reference = commonAncestor(model.kinematics, bodies[0], bodies[1]);
      model.pairs.push_back(pair);
      SimdModel lanes = simdModelOf(model);
      if (!lanes.usable) continue;
      BothWalks walks(lanes);
      for (int i = 0; i < 20; ++i) {
        const auto q = configuration(random, model.kinematics, 3.0, options.link);
        ASSERT_TRUE(walks.walk(model, q));
        Vector at[2];
        Real radii = 0;
        for (const int k : {0, 1}) {
          const SimdNode& node = lanes.nodes[lanes.rootOfGeometry[k == 0 ? first : last]];
          at[k] =
              exactPoint(model.kinematics, q, q, 0, bodies[k], 0, centerOf(lanes, bodies[k], node));
          radii += static_cast<Real>(node.radius);
        }
        const Real gap = (at[1] - at[0]).norm() - radii;
        if (gap <= 0) continue;
        const Real off =
            static_cast<Real>(walks.rounding()) + static_cast<Real>(1e-6) * (gap + radii);
        lanes.margin = static_cast<float>(
            gap + static_cast<Real>(random.chance(0.5) ? random.uniform(-12.0, 2.0) : 0.0) * off);
        lanes.rootRows = detail::compileRootRows(lanes);
        ASSERT_TRUE(walks.walk(model, q));
        ASSERT_EQ(walks.openOfOne(), walks.openOfEight());
        const bool open = !walks.openOfOne().empty();
        ++asked;
        within += gap <= static_cast<Real>(lanes.margin) ? 1 : 0;
        proven += open ? 0 : 1;
        ASSERT_TRUE(open || gap > static_cast<Real>(lanes.margin));
      }
    }
    RecordProperty(std::string("tally_") + hwy::TargetName(target),
                   std::to_string(asked) + " asked, " + std::to_string(within) + " within, " +
                       std::to_string(proven) + " proven");
    EXPECT_GT(asked, 1000);
    EXPECT_GT(within, 0.2 * asked);
    EXPECT_GT(proven, 0.1 * asked);
  }
}

}  // namespace
}  // namespace swept::simd_test
