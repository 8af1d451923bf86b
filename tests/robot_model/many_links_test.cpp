// SPDX-License-Identifier: BSD-3-Clause
// What building a checker takes for a robot of many links, counted. For a chain it grew with the
// power 3.5 of their number: proofs that pairs never meet had no limit together, and the square of
// the joints between two links in each step; each common ancestor had arms of all that hangs on it;
// and of more pairs than 1200 for which there are joint tables, none had one.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "acm/never_pairs.hpp"
#include "acm/never_proof.hpp"
#include "certify/workspace_data.hpp"
#include "kinematics/common_ancestors.hpp"
#include "long_robots.hpp"
#include "simd/tables/pair_separation_table.hpp"
#include "simd/tables/table_candidates.hpp"

namespace swept {
namespace {

using detail::LinkQuestion;

std::vector<LinkQuestion> questionsOf(const Robot& robot) {
  std::set<std::pair<int, int>> connected;
  for (const Joint& joint : robot.joints())
    if (joint.parentLink >= 0) connected.insert(std::minmax(joint.parentLink, joint.childLink));
  const int links = static_cast<int>(robot.links().size());
  std::vector<LinkQuestion> questions;
  for (int a = 1; a < links; ++a)
    for (int b = a + 1; b < links; ++b)
      if (!connected.contains({a, b})) questions.push_back({a, b, 0.0});
  return questions;
}

struct Proven {
  std::int64_t work = 0;
  std::vector<bool> never;
  int count = 0;
};

constexpr std::int64_t kBudget = 3000;

Proven prove(const Robot& robot, std::int64_t mostWork, unsigned threads = 0) {
  std::vector<LinkQuestion> questions = questionsOf(robot);
  Proven proven;
  proven.work = detail::proveNever(robot, questions, kBudget, mostWork, threads);
  for (const LinkQuestion& question : questions) {
    proven.never.push_back(question.never);
    proven.count += question.never ? 1 : 0;
  }
  return proven;
}

constexpr std::int64_t kUnlimited = std::int64_t{1} << 60;

TEST(ManyLinks, ProofsKeepWithinTheirWorkTogether) {
  constexpr std::int64_t kMost = 50'000'000;
  std::int64_t before = 0;
  for (const int links : {50, 100, 200}) {
    const auto robot = test::ballChain(links, 3.0);
    const Proven proven = prove(*robot, kMost);
    EXPECT_LE(proven.work, kMost * 1.01);
    // There is more to do than they may.
    EXPECT_GT(proven.work, kMost / 2);
    if (before > 0) {
      EXPECT_LE(static_cast<double>(proven.work), 4.5 * static_cast<double>(before));
    }
    before = proven.work;
  }
}

TEST(ManyLinks, ProofsThatAreLeftOutAreThoseOfLinksFarApart) {
  const auto robot = test::ballChain(80, 0.1);
  const Proven all = prove(*robot, kUnlimited);
  const Proven some = prove(*robot, all.work / 4);
  EXPECT_LE(some.work, all.work / 4 + all.work / 100);
  EXPECT_GT(some.count, 100);
  EXPECT_LT(some.count, all.count);
  const std::vector<LinkQuestion> questions = questionsOf(*robot);
  int mostProven = 0;
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (!some.never[i]) continue;
    EXPECT_TRUE(all.never[i]);
    mostProven = std::max(mostProven, questions[i].linkB - questions[i].linkA);
  }
  for (std::size_t i = 0; i < questions.size(); ++i) {
    if (questions[i].linkB - questions[i].linkA >= mostProven) continue;
    EXPECT_EQ(some.never[i], all.never[i]) << questions[i].linkA << ", " << questions[i].linkB;
  }
}

TEST(ManyLinks, ProofsAreTheSameOnAnyNumberOfThreads) {
  const auto robot = test::handOf(6, 12, 0.3);
  const Proven one = prove(*robot, 20'000'000, 1);
  for (const unsigned threads : {2U, 5U, 16U}) {
    const Proven many = prove(*robot, 20'000'000, threads);
    EXPECT_EQ(many.work, one.work);
    EXPECT_EQ(many.never, one.never);
  }
  EXPECT_GT(one.count, 10);
  EXPECT_LT(one.count, prove(*robot, kUnlimited).count);
}

/// How a proof about two links of a chain of balls ends with so much work.
struct Ended {
  detail::NeverProof::State state;
  std::int64_t work;
};

Ended proveWith(double limit, std::int64_t mostWork) {
  const auto robot = test::ballChain(9, limit);
  const detail::KinematicModel model = detail::wholeKinematics(*robot);
  const detail::LinkPieces a = detail::piecesOf(*robot, model, 1);
  const detail::LinkPieces b = detail::piecesOf(*robot, model, 8);
  const detail::LinkChain chain(*robot, model, model.bodyOfLink[1], model.bodyOfLink[8]);
  detail::LinkChain::Place place;
  chain.startFrom(robot->defaultState(), place);
  detail::NeverProof proof(a, b, chain, 0.0, place);
  const auto state = proof.run(kBudget, mostWork);
  return {state, proof.work()};
}

TEST(ManyLinks, AProofThatRunsOutOfWorkProvesNothing) {
  using State = detail::NeverProof::State;
  for (std::int64_t work = 1; work < 100'000; work += 1 + work / 8)
    EXPECT_NE(proveWith(3.0, work).state, State::Proven) << work;
  const Ended whole = proveWith(0.25, kUnlimited);
  ASSERT_EQ(whole.state, State::Proven);
  for (std::int64_t work = 1; work < 2 * whole.work; work += 1 + work / 8)
    EXPECT_EQ(proveWith(0.25, work).state, work > whole.work ? State::Proven : State::Open) << work;
}

std::shared_ptr<const detail::CheckerModel> compiled(const std::shared_ptr<const Robot>& robot) {
  return detail::compileChecker(robot, robot->groups().front(), std::make_shared<World>(), {});
}

/// Numbers of all references and hulls, and of what they share.
std::size_t armsOf(const detail::SimdModel& lanes) {
  std::size_t numbers = lanes.hulls->arms.size() + lanes.hulls->growths.size();
  for (const detail::SimdReference& reference : lanes.references) {
    numbers +=
        detail::kLanes * (reference.arms.size() + reference.carried.size()) + reference.slot.size();
    for (const detail::SimdReference::Growth& growth : reference.growths)
      numbers += detail::kLanes * growth.shares.size();
  }
  for (const detail::SimdCarried& joint : lanes.carried)
    numbers += joint.arms.size() + joint.bodies.size();
  return numbers;
}

TEST(ManyLinks, BoundsTakeRoomAsThePairsDo) {
  const std::size_t at150 = armsOf(compiled(test::ballChain(150, 3.0))->simd);
  const std::size_t at300 = armsOf(compiled(test::ballChain(300, 3.0))->simd);
  EXPECT_LE(at300, 4 * 300 * 300);
  EXPECT_LE(static_cast<double>(at300), 4.5 * static_cast<double>(at150));
}

/// What slides makes arms of all joints before it longer.
TEST(ManyLinks, BoundsOfWhatSlidesTakeRoomAsThePairsDo) {
  const std::size_t at150 = armsOf(compiled(test::telescope(150))->simd);
  const std::size_t at300 = armsOf(compiled(test::telescope(300))->simd);
  EXPECT_LE(at300, 4 * 300 * 300);
  EXPECT_LE(static_cast<double>(at300), 4.5 * static_cast<double>(at150));
}

struct Tables {
  std::size_t number = 0;
  std::size_t cells = 0;
};

Tables tablesOf(const detail::CheckerModel& model) {
  Tables tables;
  for (const detail::SimdBodyPair& bodies : model.simd.bodyPairs) {
    if (bodies.table == nullptr || bodies.table->joints == 0) continue;
    ++tables.number;
    tables.cells += bodies.table->cells.size();
  }
  return tables;
}

/// What 128 of the finest tables have.
constexpr std::size_t kMostCells = std::size_t{128} * 192 * 192;

TEST(ManyLinks, SomePairsHaveTablesWhereNotAllCan) {
  const auto model = compiled(test::combOfArms(80));
  const Tables tables = tablesOf(*model);
  EXPECT_GT(model->simd.bodyPairs.size(), 1200U);
  EXPECT_GT(tables.number, 20U);
  EXPECT_LE(tables.cells, kMostCells);
}

TEST(ManyLinks, TablesAreTriedForTheNearest) {
  const auto model = compiled(test::combOfArms(30));
  const std::vector<char> never(model->simd.bodyPairs.size(), 0);
  // Neighbours, and next ones but one.
  const auto some = detail::tableCandidates(*model, model->simd, never, 29 + 28);
  ASSERT_EQ(some.bodyPairs.size(), 57U);
  for (const std::int32_t i : some.bodyPairs)
    EXPECT_LE(model->simd.bodyPairs[i].bodyB - model->simd.bodyPairs[i].bodyA, 2);
  EXPECT_EQ(some.coarseness, 1);
  const auto all = detail::tableCandidates(*model, model->simd, never, 10'000);
  EXPECT_EQ(all.bodyPairs.size(), 435U);
  EXPECT_EQ(all.coarseness, 2);
}

TEST(ManyLinks, TablesOfManyPairsAreCoarser) {
  // Thick links, of which those next but one along the chain may meet.
  const Tables few = tablesOf(*compiled(test::ballChain(40, 3.0, 0.045)));
  EXPECT_EQ(few.number, 38U);
  EXPECT_EQ(few.cells, few.number * 192 * 192);
  const Tables many = tablesOf(*compiled(test::ballChain(300, 3.0, 0.045)));
  EXPECT_EQ(many.number, 298U);
  EXPECT_LE(many.cells, kMostCells);
}

/// The last body that carries both, going up from them.
TEST(ManyLinks, CommonAncestorsAreThoseFoundGoingUp) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    detail::KinematicModel model;
    model.bodies.emplace_back();
    for (int i = 1; i < 40; ++i) {
      detail::MovingBody body;
      body.parent = std::uniform_int_distribution<int>(std::max(0, i - 6), i - 1)(random);
      model.bodies.push_back(body);
    }
    detail::CommonAncestors ancestors(model);
    for (int a = 0; a < 40; ++a) {
      ancestors.setFirst(a);
      for (int b = 0; b < 40; ++b) {
        std::vector<int> ofA, ofB;
        for (int i = a; i >= 0; i = model.bodies[i].parent) ofA.insert(ofA.begin(), i);
        for (int i = b; i >= 0; i = model.bodies[i].parent) ofB.insert(ofB.begin(), i);
        const auto common = std::ranges::mismatch(ofA, ofB);
        ASSERT_EQ(ancestors.with(b), *std::prev(common.in1));
        ASSERT_EQ(ancestors.jointsTo(b), (ofA.end() - common.in1) + (ofB.end() - common.in2));
      }
    }
  }
}

}  // namespace
}  // namespace swept
