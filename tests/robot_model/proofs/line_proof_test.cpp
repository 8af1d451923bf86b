// SPDX-License-Identifier: BSD-3-Clause
// Proofs of lines in files, against samples of the tool's way: what is claimed is shown if it is a
// little more than the samples have, and refused if it is less, however the file is signed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "message_of.hpp"
#include "models_dir.hpp"
#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "transcript.hpp"
#include "verify/check.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using verify::Json;

/// The largest deviations of a path from its lines.
struct Off {
  double position = 0.0, angle = 0.0;
};

class LineProof : public testing::Test {
 protected:
  static std::shared_ptr<const Checker> arm(const CheckerOptions& options = {}) {
    const std::string rook = modelsDir() + "/robots/rook7/rook7";
    return std::make_shared<const Checker>(Robot::load(rook + ".urdf", rook + ".srdf"), "arm",
                                           std::make_shared<const World>(), options);
  }
  std::vector<double> ready() const {
    return namedConfiguration(checker_->robot(), checker_->group(), "ready");
  }
  /// Along v (m), turned by w (rad), from where the one before ends.
  ToolLine lineFrom(const std::vector<double>& start, const Vector3d& v, const Vector3d& w) const {
    const ToolLinePlanner planner(checker_, tool_);
    Workspace workspace(*checker_);
    Isometry3d goal = planner.pose(start);
    goal.translation() += v;
    if (w.norm() > 0.0)
      goal.linear() =
          Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix() * goal.linear();
    return planner.plan(start, goal, workspace, options_);
  }
  /// Two lines, the second of which turns.
  std::vector<ToolLine> lines() const {
    std::vector<ToolLine> all{lineFrom(ready(), {0.02, 0.05, -0.1}, Vector3d::Zero())};
    all.push_back(lineFrom(all[0].wayPoints.back(), {0, -0.1, 0.03}, {0.2, -0.3, 0.1}));
    return all;
  }
  std::filesystem::path written(const std::vector<ToolLine>& lines) const {
    const std::filesystem::path file = folder_.path() / "line.json";
    EXPECT_EQ(writeLineProof(file, *checker_, tool_, lines, options_).missing, "");
    return file;
  }
  static std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  static Json jsonOf(const std::filesystem::path& file) { return Json::parse(textOf(file)); }
  /// What is said of a file with other claims, which are signed again.
  static std::string refusal(Json path) {
    path["proof"]["digests"]["claims"] = verify::claimDigests(path);
    try {
      verify::checkProof(path, path["model"]);
    } catch (const verify::Refusal& refusal) {
      return refusal.what();
    }
    return {};
  }
  /// From poses of the library at 200 times of each chord.
  Off sampled(const ToolLine& line) const {
    const Eigen::Matrix3d begin = line.model_from_start.linear();
    const Eigen::AngleAxisd turn(line.model_from_goal.linear() * begin.transpose());
    const Vector3d way = line.model_from_goal.translation() - line.model_from_start.translation();
    Off off;
    for (std::size_t i = 0; i + 1 < line.shares.size(); ++i) {
      const LinkMotion motion(checker_->robot(), "arm", tool_.body, line.wayPoints[i],
                              line.wayPoints[i + 1]);
      const double from = line.shares[i], to = line.shares[i + 1];
      for (int k = 0; k <= 200; ++k) {
        const double t = k / 200.0, share = from + t * (to - from);
        const Isometry3d pose = motion.at(t) * tool_.body_from_frame;
        const Vector3d p = pose.translation() - line.model_from_start.translation();
        const double nearest =
            way.squaredNorm() > 0.0 ? std::clamp(p.dot(way) / way.squaredNorm(), from, to) : 0.0;
        off.position = std::max(off.position, (p - nearest * way).norm());
        const Eigen::Matrix3d wanted =
            Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix() * begin;
        off.angle =
            std::max(off.angle, Eigen::AngleAxisd(wanted.transpose() * pose.linear()).angle());
      }
    }
    return off;
  }
  test::TemporaryFolder folder_;
  ConstraintFrame tool_{.body = "tool",
                        .body_from_frame = Isometry3d(Eigen::Translation3d(0.01, 0.02, 0.03))};
  ToolLineOptions options_;
  std::shared_ptr<const Checker> checker_ = arm();
};

TEST_F(LineProof, ClaimsWhatToolLineOptionsSay) {
  const std::vector<ToolLine> all = lines();
  ASSERT_TRUE(all[0].complete() && all[1].complete());
  const CheckedProof proof = verifyProof(written(all));
  EXPECT_EQ(proof.refusal, "");
  const std::size_t first = all[0].shares.size() - 1;
  EXPECT_EQ(proof.segments, first + all[1].shares.size() - 1);
  ASSERT_EQ(proof.constraints.size(), 2U);
  const std::string within = " point (0.01, 0.02, 0.03) of tool within 0.001 m of the line from (";
  const std::string angle = ", and within 0.00873 rad of its orientation there";
  EXPECT_TRUE(
      proof.constraints[0].starts_with("in segments 1 to " + std::to_string(first) + within))
      << proof.constraints[0];
  EXPECT_TRUE(proof.constraints[0].ends_with(angle)) << proof.constraints[0];
  EXPECT_TRUE(proof.constraints[1].starts_with("in segments " + std::to_string(first + 1) + " to " +
                                               std::to_string(proof.segments) + within))
      << proof.constraints[1];
  EXPECT_TRUE(proof.constraints[1].ends_with(angle + ", turned by (0.2, -0.3, 0.1) rad on the way"))
      << proof.constraints[1];
}

/// Claims between the samples and a little more hold; claims of a little less are refused.
TEST_F(LineProof, OfRandomLinesIsAsSharpAsTheTruth) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-0.08, 0.08), angle(-0.3, 0.3);
  int shown = 0, refusedPlaces = 0, refusedTurns = 0;
  for (int i = 0; i < 12; ++i) {
    options_ = {.position = i % 2 == 0 ? 1e-3 : 1e-2, .angle = i % 3 == 0 ? 0.05 : 0.01};
    const Vector3d v(side(random), side(random), side(random));
    const Vector3d w = i % 4 == 0 ? Vector3d::Zero().eval()
                                  : Vector3d(angle(random), angle(random), angle(random));
    const ToolLine line = lineFrom(ready(), v, w);
    if (line.shares.size() < 2) continue;
    Json path = jsonOf(written({line}));
    const Off off = sampled(line);
    ASSERT_LE(off.position, options_.position) << i;
    ASSERT_LE(off.angle, options_.angle) << i;
    path["lines"][0]["position"] = 1.001 * off.position + 1e-8;
    path["lines"][0]["angle"] = 1.001 * off.angle + 1e-8;
    EXPECT_EQ(refusal(path), "") << i;
    ++shown;
    Json place = path, turn = path;
    place["lines"][0]["position"] = 0.999 * off.position - 1e-9;
    turn["lines"][0]["angle"] = 0.999 * off.angle - 1e-9;
    refusedPlaces += refusal(place).find("line of tool: not shown") != std::string::npos;
    refusedTurns += refusal(turn).find("line of tool: not shown") != std::string::npos;
  }
  EXPECT_GE(shown, 8);
  EXPECT_EQ(refusedPlaces, shown);
  EXPECT_EQ(refusedTurns, shown);
}

TEST_F(LineProof, OfAnotherLineIsRefused) {
  const Json path = jsonOf(written(lines()));
  EXPECT_EQ(refusal(path), "");
  const auto changed = [&](const auto& change) {
    Json own = path;
    change(own["lines"][0]);
    return refusal(own);
  };
  const std::string off = "segment 1, line of tool: not shown";
  EXPECT_TRUE(changed([](Json& line) {
                line["begin"][9] = line["begin"][9].get<double>() + 0.0011;
              }).starts_with(off));
  EXPECT_TRUE(changed([](Json& line) { line["tool"]["pose"][9] = 0.0125; }).starts_with(off));
  EXPECT_NE(changed([](Json& line) { line["way"][2] = -0.09; }), "");
  EXPECT_NE(changed([](Json& line) { line["turn"][2] = 0.02; }), "");
  EXPECT_NE(changed([](Json& line) { line["first"] = 1; }), "");
  EXPECT_TRUE(changed([](Json& line) { line["tool"]["link"] = "link5"; }).find("not shown") !=
              std::string::npos);
  // Without a signature, whatever it is.
  Json unsigned_ = path;
  unsigned_["lines"][0]["position"] = 0.002;
  std::ofstream(folder_.path() / "unsigned.json") << unsigned_.dump();
  EXPECT_EQ(verifyProof(folder_.path() / "unsigned.json").refusal,
            "path file, lines: is not as it was when the path was certified");
  unsigned_.erase("lines");
  std::ofstream(folder_.path() / "unsigned.json") << unsigned_.dump();
  EXPECT_EQ(verifyProof(folder_.path() / "unsigned.json").refusal,
            "path file, lines: is not there, and was when the path was certified");
}

TEST_F(LineProof, OfWhatIsNoLineIsRefused) {
  const Json path = jsonOf(written(lines()));
  const auto with = [&](const char* key, const Json& value) {
    Json own = path;
    own["lines"][1][key] = value;
    return refusal(own);
  };
  EXPECT_EQ(with("shares", Json::array({0.0})), "line 2: fewer than two shares");
  EXPECT_EQ(with("shares", Json::array({0.0, 0.5, 0.5})), "line 2: shares do not increase");
  EXPECT_EQ(with("shares", Json::array({0.0, 1.5})), "line 2: shares are from 0 to 1");
  EXPECT_EQ(with("first", 1000), "line 2: there is no segment 1000");
  EXPECT_EQ(with("first", -1), "line 2: there is no segment -1");
  EXPECT_EQ(with("first", path["states"].size() - 2),
            "line 2: more shares than the path has states");
  EXPECT_EQ(with("position", -1.0), "line 2, position: negative");
  EXPECT_EQ(with("angle", "any"), "line 2, angle: not a number: \"any\"");
  EXPECT_EQ(with("way", Json::array({1, 2})), "line 2, way: not three numbers");
  EXPECT_EQ(with("turn", Json::array({1e40, 0, 0})), "line 2, turn: it is too large");
  EXPECT_EQ(with("speed", 1.0), "line 2: it has no speed");
  EXPECT_EQ(with("tool", Json{{"link", nullptr}, {"pose", path["lines"][1]["begin"]}}),
            "line 2: no link carries the tool");
  Json own = path;
  own["lines"] = 3;
  EXPECT_EQ(refusal(own), "lines: not a list");
}

/// The tube is about what is free, not about the deviation.
TEST_F(LineProof, IsOfThePathItself) {
  CheckerOptions options;
  options.tracking.rotation = 0.005;
  checker_ = arm(options);
  const CheckedProof proof = verifyProof(written({lineFrom(ready(), {0, 0, -0.05}, {0, 0, 0})}));
  EXPECT_EQ(proof.refusal, "");
  EXPECT_EQ(proof.tube.size(), 7U);
  EXPECT_EQ(proof.constraints.size(), 1U);
}

TEST_F(LineProof, OfAnyOrientationSaysNothingOfIt) {
  options_.angle = 4.0;
  const std::filesystem::path file = written({lineFrom(ready(), {0, 0, -0.05}, {0, 0, 0})});
  const CheckedProof proof = verifyProof(file);
  EXPECT_EQ(proof.refusal, "");
  EXPECT_EQ(proof.constraints[0].find("orientation"), std::string::npos) << proof.constraints[0];
  EXPECT_TRUE(jsonOf(file)["lines"][0]["angle"].is_null());
}

TEST_F(LineProof, RefusesLinesThatDoNotJoin) {
  std::vector<ToolLine> all = lines();
  const std::filesystem::path file = folder_.path() / "none.json";
  const auto write = [&] { writeLineProof(file, *checker_, tool_, all, options_); };
  std::swap(all[0], all[1]);
  EXPECT_EQ(test::messageOf(write), "line 2 does not begin where the one before ends");
  all[1].shares.pop_back();
  EXPECT_EQ(test::messageOf(write), "line 2 has not one share for each way point");
  all.clear();
  EXPECT_EQ(test::messageOf(write), "a proof of no line");
  EXPECT_THROW(writeLineProof(folder_.path() / "none.csv", *checker_, tool_, lines(), options_),
               UsageError);
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// Half of the deviation that the lines were made for is not shown, and not written.
TEST_F(LineProof, ThatCannotBeShownIsNotWritten) {
  options_.position = 0.01;
  const std::vector<ToolLine> all{lineFrom(ready(), {0.02, 0.05, -0.1}, {0, 0, 0})};
  options_.position = 0.2 * sampled(all[0]).position;
  const std::filesystem::path file = folder_.path() / "none.json";
  const std::string missing = writeLineProof(file, *checker_, tool_, all, options_).missing;
  EXPECT_TRUE(missing.starts_with("segment ") && missing.ends_with(", line of tool")) << missing;
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(LineProof, IsTheSameInEveryFloatingPointEnvironment) {
  const std::vector<ToolLine> all{lineFrom(ready(), {0, 0, -0.05}, {0, 0, 0.1})};
  test::expectSameInEveryEnvironment(
      {{"written", [&](test::Transcript& t) { t.add(textOf(written(all))); }},
       {"verified", [&](test::Transcript& t) {
          const CheckedProof proof = verifyProof(written(all));
          t.add(proof.refusal, proof.intervals, proof.planes, proof.clearance);
        }}});
}

}  // namespace
}  // namespace swept
