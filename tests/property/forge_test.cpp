// SPDX-License-Identifier: BSD-3-Clause
// Some thousand of the files that forge makes by the million; the bounds of the checker of proofs
// against 50 digits; and tests of the judge itself.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

#include "forgeries/campaign.hpp"
#include "forgeries/claim.hpp"
#include "forgeries/judge.hpp"
#include "forgeries/scene.hpp"
#include "verify/check.hpp"
#include "verify/motion.hpp"
#include "verify/proof.hpp"
#include "verify/trajectory.hpp"

namespace {

using namespace forgeries;
using Eigen::Vector3d;
namespace verify = swept::verify;

TEST(Forge, NoFalseProofIsVerified) {
  CampaignOptions options;
  options.count = 6000;
  const CampaignReport report = runCampaign(options);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  EXPECT_EQ(report.files, options.count);
  // The suite says something only if much of what is forged is believed, and much is not.
  EXPECT_GT(report.accepted, options.count / 5);
  EXPECT_LT(report.accepted, options.count * 4 / 5);
  for (std::size_t i = 0; i < kFields; ++i) {
    EXPECT_GT(report.made[i], options.count / 50) << kFieldNames[i];
    EXPECT_GT(report.believed[i], 20u) << kFieldNames[i];
    EXPECT_LT(report.believed[i], report.made[i]) << kFieldNames[i];
  }
}

/// A pair of bodies of a scene on its first segment.
struct Subject {
  Json path;
  verify::Model model;
  verify::PairToProve pair{};
  const verify::Body& a() const { return model.bodies[static_cast<std::size_t>(pair.a)]; }
  const verify::Body& b() const { return model.bodies[static_cast<std::size_t>(pair.b)]; }
};

/// The motion of the first segment.
verify::Motion motionOf(const Subject& subject) {
  if (subject.path.contains("trajectory")) {
    const auto points = verify::readPoints(subject.path["trajectory"], subject.model);
    return {subject.model, points[0], points[1]};
  }
  const auto states = subject.path["states"].get<std::vector<std::vector<double>>>();
  return {subject.model, states[0], states[1]};
}

/// False where no pair of the scene moves.
bool draw(Random& random, const std::vector<Field>& fields, Subject& subject) {
  subject.path = makeScene(random);
  for (const Field field : fields) mutate(subject.path, field, random);
  takePositions(subject.path);
  try {
    subject.model = verify::readModel(subject.path["model"]);
    motionOf(subject);
  } catch (const verify::Refusal&) {
    return false;
  }
  const std::vector<verify::PairToProve> pairs = verify::pairsToProve(subject.model);
  if (pairs.empty()) return false;
  subject.pair = pairs[random.below(pairs.size())];
  return true;
}

/// What doubles make of the distance along a direction at the middle of an interval.
double plainDistance(const Subject& subject, const verify::PairMotion& motion, const Vector3d& n) {
  const auto most = [&](const verify::Body& body, const verify::Placed& placed, const Vector3d& d) {
    const Eigen::Isometry3d& pose = placed.reference_from_link;
    return body.support(0, pose.linear().transpose() * d) + d.dot(pose.translation());
  };
  return -most(subject.b(), motion.placedB(), -n) - most(subject.a(), motion.placedA(), n);
}

struct Counts {
  int cases = 0;
  int over = 0;     ///< plain doubles say more than is true
  int farOver = 0;  ///< by more than 1e-6 m
  int useful = 0;   ///< the bound is within 1e-6 m of the truth
  int nothing = 0;  ///< the bound is more than 1 m below it
  int walls = 0;
  int curves = 0;
  int tubes = 0;
};

/// One interval of a motion, one direction or wall.
void compare(Random& random, const Subject& subject, Counts& counts) {
  const double length = random.scale(-16.0, -2.0);
  const double begin = random.uniform(0.0, 1.0 - length), end = begin + length;
  const double middle = 0.5 * (begin + end);
  const verify::Motion motion = motionOf(subject);
  const verify::PairMotion part(subject.model, motion, subject.pair, begin, end);
  const bool wall = subject.b().nodes().empty();
  Vector3d n = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
  if (random.chance(0.3)) n = random.sign() * Vector3d::Unit(static_cast<int>(random.below(3)));
  const int side = wall && random.chance(0.5) ? -1 : 1;
  if (wall) n = -side * subject.b().flats()[0].normal;
  const auto truth = [&](double t, Random* errors) {
    const std::string &a = subject.a().name(), &b = subject.b().name();
    return wall ? wallSeparation(subject.path, 0, a, b, 0, side, t, errors)
                : separation(subject.path, 0, a, b, Json{n.x(), n.y(), n.z()}, t, errors);
  };
  if (wall && side < 0 && subject.b().flats()[0].solid) return;
  const double gap = wall ? part.gapToFlat(0, 0, side) : part.gap(0, 0, n);
  if (!std::isfinite(gap)) return;
  Real least = truth(middle, nullptr);
  const double plain =
      wall ? -side * subject.b().flats()[0].offset -
                 (subject.a().support(0,
                                      part.placedA().reference_from_link.linear().transpose() * n) +
                  n.dot(part.placedA().reference_from_link.translation()))
           : plainDistance(subject, part, n);
  ++counts.cases;
  counts.walls += wall ? 1 : 0;
  counts.over += Real(plain) > least ? 1 : 0;
  counts.farOver += Real(plain) > least + Real(1e-6) ? 1 : 0;
  const bool inTube = subject.path["model"].contains("tracking");
  counts.curves += subject.path.contains("trajectory") ? 1 : 0;
  counts.tubes += inTube ? 1 : 0;
  for (const double t : {begin, end, random.uniform(begin, end), random.uniform(begin, end)})
    for (int k = 0; k < (inTube ? 4 : 1); ++k) least = std::min(least, truth(t, &random));
  ASSERT_LE(Real(gap), least) << begin << " to " << end << " " << subject.path.dump();
  counts.useful += Real(gap) >= least - Real(1e-6) ? 1 : 0;
  counts.nothing += Real(gap) < least - Real(1) ? 1 : 0;
}

/// Offsets, values, origins, coordinates and planes that take each other back, one or two at once:
/// of a length of 1e16 m not a metre is left. What the bounds take off has to be more than what
/// doubles lose, and of small numbers little.
TEST(ProofRounding, BoundsAreBelowTheTruthWhereNumbersCancel) {
  constexpr int kCases = 4000;
  const std::vector<Field> cancelling = {Field::Offset, Field::Value, Field::Origin, Field::Shape,
                                         Field::Wall,   Field::Body,  Field::Turn,   Field::Time,
                                         Field::Rate,   Field::Tube};
  Counts counts;
  for (int i = 0; i < kCases; ++i) {
    Random random(11, static_cast<std::uint64_t>(i));
    std::vector<Field> fields{cancelling[random.below(cancelling.size())]};
    if (random.chance(0.5)) fields.push_back(cancelling[random.below(cancelling.size())]);
    if (random.chance(0.2)) fields.push_back(random.chance(0.5) ? Field::Axis : Field::Rotation);
    Subject subject;
    if (!draw(random, fields, subject)) continue;
    compare(random, subject, counts);
    if (HasFatalFailure()) return;
  }
  std::cout << counts.cases << " cases, " << counts.walls << " of walls, " << counts.curves
            << " of trajectories, " << counts.tubes << " in tubes; plain doubles say more in "
            << counts.over << ", by more than a micrometre in " << counts.farOver
            << "; bounds are within one in " << counts.useful << " and say nothing in "
            << counts.nothing << std::endl;
  EXPECT_GT(counts.cases, kCases / 2);
  EXPECT_GT(counts.walls, kCases / 20);
  EXPECT_GT(counts.curves, kCases / 10);
  EXPECT_GT(counts.tubes, kCases / 10);
  EXPECT_GT(counts.over, counts.cases / 4);
  EXPECT_GT(counts.farOver, counts.cases / 20);
  EXPECT_GT(counts.useful, counts.cases / 4);
  EXPECT_GT(counts.nothing, counts.cases / 20);
}

/// Two readings of the same files: without large numbers they agree to rounding.
TEST(ForgeJudge, AgreesWithTheCheckerOnOrdinaryNumbers) {
  int compared = 0, curves = 0;
  for (int i = 0; i < 400; ++i) {
    Random random(12, static_cast<std::uint64_t>(i));
    Subject subject;
    if (!draw(random, {}, subject) || subject.b().nodes().empty()) continue;
    if (subject.path["model"].contains("tracking")) continue;  // bounds are below by what it is
    curves += subject.path.contains("trajectory") ? 1 : 0;
    const double t = random.uniform(0.0, 1.0);
    const verify::Motion motion = motionOf(subject);
    const verify::PairMotion part(subject.model, motion, subject.pair, t, t);
    const Vector3d n = Vector3d(random.normal(), random.normal(), random.normal()).normalized();
    const Real truth = separation(subject.path, 0, subject.a().name(), subject.b().name(),
                                  Json{n.x(), n.y(), n.z()}, t);
    EXPECT_NEAR(part.gap(0, 0, n), truth.convert_to<double>(), 1e-7);
    ++compared;
  }
  EXPECT_GT(compared, 200);
  EXPECT_GT(curves, 50);
}

void raiseBounds(Json& tree, double by) {
  if (tree.is_array()) {
    Json& bound = tree[tree.size() == 4 ? 3 : 1];
    bound = bound.get<double>() + by;
    return;
  }
  for (Json& halves : tree)
    for (Json& half : halves) raiseBounds(half, by);
}

void raiseBoundsOf(Json& pair, double by) {
  if (pair.contains("intervals"))
    for (Json& interval : pair["intervals"]) raiseBounds(interval[2], by);
  if (!pair.contains("flats")) return;
  for (Json& list : pair["flats"])
    for (Json& interval : list) raiseBounds(interval[2], by);
}

/// A judge that never complains proves nothing: here are claims that are not true.
TEST(ForgeJudge, RefutesBoundsThatAreTooLarge) {
  int accepted = 0, refuted = 0;
  for (std::uint64_t i = 0; i < 300; ++i) {
    Random random(13, i);
    Json path = makeScene(random);
    try {
      claimMost(path, random);
      sign(path);
      if (verify::checkProof(path, path["model"]).pairs == 0) continue;
    } catch (const verify::Refusal&) {
      continue;
    }
    ++accepted;
    EXPECT_EQ(refutation(path, random), "");
    for (Json& segment : path["proof"]["segments"])
      for (Json& pair : segment["pairs"]) raiseBoundsOf(pair, 0.1);
    refuted += refutation(path, random).empty() ? 0 : 1;
  }
  EXPECT_GT(accepted, 100);
  EXPECT_GT(refuted, accepted / 2);
}

TEST(ForgeJudge, KnowsInsideFromOutside) {
  const Vec o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const Shell shell{{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
  int inside = 0;
  Random random(14, 0);
  for (int i = 0; i < 500; ++i) {
    const double a = random.uniform(-0.2, 0.6), b = random.uniform(-0.2, 0.6),
                 c = random.uniform(-0.2, 0.6);
    const bool truth = a > 0.0 && b > 0.0 && c > 0.0 && a + b + c < 1.0;
    EXPECT_EQ(isInside(shell, {Real(a), Real(b), Real(c)}), truth);
    inside += truth ? 1 : 0;
  }
  EXPECT_GT(inside, 50);
  EXPECT_LT(inside, 450);
}

}  // namespace
