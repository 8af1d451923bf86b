// SPDX-License-Identifier: BSD-3-Clause
#include "swept/proofs/path_proof.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "sliding_cube.hpp"
#include "swept/core/enclosing_spheres.hpp"
#include "swept/robot_model/path_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "transcript.hpp"

namespace swept {
namespace {

using testing::HasSubstr;
using States = std::vector<std::vector<double>>;

const States kOver{{-1, 0}, {-1, 0.5}, {1, 0.5}, {1, 0}};

class PathProof : public testing::Test {
 protected:
  /// The message of the UsageError that `action` throws; empty when it throws none.
  static std::string usageError(const std::function<void()>& action) {
    try {
      action();
    } catch (const UsageError& error) {
      return error.what();
    }
    return {};
  }
  std::string refusal(const States& states, const std::string& name = "proof.json") const {
    return usageError([&] {
      writeProof(folder_.path() / name, checker_, states, certifyPath(checker_, states));
    });
  }
  std::filesystem::path written(const States& states) const {
    const std::filesystem::path file = folder_.path() / "proof.json";
    EXPECT_TRUE(writeProof(file, checker_, states, certifyPath(checker_, states)).isWritten());
    return file;
  }
  static std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

  Checker checker_{test::slidingCube(), "all", test::worldWithCube()};
  test::TemporaryFolder folder_;
};

TEST_F(PathProof, IsTheSameInEveryFloatingPointEnvironment) {
  const std::filesystem::path file = written(kOver);
  test::expectSameInEveryEnvironment(
      {{"written", [&](test::Transcript& t) { t.add(textOf(written(kOver))); }},
       {"verified", [&](test::Transcript& t) {
          for (const CheckedProof& proof : {verifyProof(file), verifyProof(file, checker_)})
            t.add(proof.refusal, proof.intervals, proof.planes, proof.clearance);
        }}});
}

TEST_F(PathProof, HoldsAndKeepsWhatIsTrue) {
  const CheckedProof proof = verifyProof(written(kOver));
  EXPECT_EQ(proof.refusal, "");
  EXPECT_EQ(proof.segments, 3u);
  EXPECT_EQ(proof.pairs, 1u);
  EXPECT_GE(proof.planes, 3u);
  EXPECT_GT(proof.clearanceWorld, 0.15);  // half of what is kept, and no more than all of it
  EXPECT_LE(proof.clearanceWorld, 0.3);
  EXPECT_TRUE(std::isinf(proof.clearanceSelf));
}

TEST_F(PathProof, HasTheConstraintsOfItsChecker) {
  const auto within = [this](double height) {
    return checker_.withConstraints(
        {.joints = {{.joint = "z", .position = 0.0, .above = height, .below = 0.0}}});
  };
  const Checker low = within(0.5);
  const std::filesystem::path file = folder_.path() / "low.json";
  EXPECT_TRUE(writeProof(file, low, kOver, certifyPath(low, kOver)).isWritten());
  const std::vector<std::string> shown{"joint z from 0 to 0.5"};
  EXPECT_EQ(verifyProof(file).constraints, shown);
  EXPECT_EQ(verifyProof(file, low).constraints, shown);
  EXPECT_EQ(verifyProof(file, checker_).constraints, shown) << "who asks for none gets more";
  EXPECT_EQ(verifyProof(file, within(0.6)).refusal,
            "constraints: they are not those of the checker");
  EXPECT_EQ(verifyProof(written(kOver), low).refusal,
            "constraints: they are not those of the checker");
}

/// At 1e7 m the library takes micrometres for rounding, and the checker of proofs millimetres.
TEST_F(PathProof, OfAConstraintThatCannotBeShownIsNotWritten) {
  constexpr double kFar = 1e7;
  const Checker far = checker_.withConstraints(
      {.positions = {
           {.frame = {.body = "cube",
                      .body_from_frame = Eigen::Isometry3d(Eigen::Translation3d(kFar, 0.0, 0.0))},
            .regions = {{.type = ConstraintRegion::Type::Box,
                         .size = {5.0, 1.0, 1.0 + 1e-4},
                         .reference_from_region =
                             Eigen::Isometry3d(Eigen::Translation3d(kFar, 0.0, 0.0))}}}}});
  const PathCertificate certificate = certifyPath(far, kOver);
  ASSERT_EQ(certificate.segments[1].certificate.verdict, Verdict::Free);
  const std::filesystem::path file = folder_.path() / "far.json";
  EXPECT_EQ(writeProof(file, far, kOver, certificate).missing, "segment 1, position of cube");
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(PathProof, IsAPathAgain) {
  const auto& group = checker_.group();
  EXPECT_EQ(readPath(written(kOver), checker_.robot(), group), kOver);
}

TEST_F(PathProof, OfOneStateIsThatItStays) {
  const CheckedProof proof = verifyProof(written({{1, 0}}));
  EXPECT_TRUE(proof.holds());
  EXPECT_EQ(proof.segments, 1u);
}

TEST_F(PathProof, IsRefusedOnceItIsChanged) {
  std::string text = textOf(written(kOver));
  const auto at = text.find("[1.0,0.5]");
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 9, "[1.0,0.4]");
  const CheckedProof proof = verifyProof(folder_.write("changed.json", text));
  EXPECT_EQ(proof.refusal, "state 3: is not as it was when the path was certified");
  EXPECT_EQ(proof.planes, 0u);
}

TEST_F(PathProof, IsAboutItsOwnWorld) {
  const std::filesystem::path file = written(kOver);
  EXPECT_TRUE(verifyProof(file, checker_).holds());
  const Checker other = checker_.withBody(
      {.name = "other", .parts = {{makeSphere(0.1), Eigen::Isometry3d::Identity()}}});
  EXPECT_THAT(verifyProof(file, other).refusal, HasSubstr("other"));
}

TEST_F(PathProof, IsNotWrittenOfAPathThatIsNotFree) {
  EXPECT_EQ(refusal({{-1, 1}, {-1, 0}, {1, 0}}),
            "'" + (folder_.path() / "proof.json").string() +
                "': there is no proof of a path that is not free: segment 2 of 2 is collision");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "proof.json"));
}

TEST_F(PathProof, IsNotWrittenOnceItIsStopped) {
  const PathCertificate certificate = certifyPath(checker_, kOver);
  const std::filesystem::path file = folder_.path() / "proof.json";
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(writeProof(file, checker_, kOver, certificate, {}, stop.get_token()), SearchStopped);
  EXPECT_FALSE(std::filesystem::exists(file));
  EXPECT_TRUE(writeProof(file, checker_, kOver, certificate).isWritten());
  EXPECT_THROW(verifyProof(file, stop.get_token()), SearchStopped);
  EXPECT_THROW(verifyProof(file, checker_, stop.get_token()), SearchStopped);
  EXPECT_TRUE(verifyProof(file, checker_).holds());
}

TEST_F(PathProof, OfStatesIsNotWrittenBesideMovingObstacles) {
  const Checker moving = checker_.withObstacle(
      {.name = "cart",
       .parts = {{makeSphere(0.1), Eigen::Isometry3d::Identity()}},
       .waypoints = {
           {.time = 0.0, .world_from_body = Eigen::Isometry3d(Eigen::Translation3d(0, 2, 0))}}});
  const States states{{-1, 0, 0}, {-1, 0.5, 1}};
  const PathCertificate certificate = certifyPath(moving, states);
  EXPECT_EQ(certificate.verdict(), Verdict::Free);
  EXPECT_EQ(
      usageError([&] { writeProof(folder_.path() / "proof.json", moving, states, certificate); }),
      "there is no proof of a path beside 'cart', which moves");
}

TEST_F(PathProof, RefusesFilesThatAreNone) {
  EXPECT_THAT(refusal(kOver, "proof.yaml"), HasSubstr("a file with a proof ends in .json"));
  EXPECT_THAT(refusal(kOver, "absent/proof.json"), HasSubstr("No such file or directory"));
  EXPECT_THAT(test::inputError([&] { verifyProof(folder_.write("plain.json", "{}")); }),
              HasSubstr("there is no proof in it"));
  EXPECT_THAT(
      test::inputError([&] { verifyProof(folder_.write("bare.json", R"({"proof": {}})")); }),
      HasSubstr("the robot and the world are not in it"));
}

TEST_F(PathProof, RefusesACertificateOfSomethingElse) {
  const std::filesystem::path file = folder_.path() / "proof.json";
  const PathCertificate shorter = certifyPath(checker_, States{{1, 0}, {1, 1}});
  EXPECT_THROW(writeProof(file, checker_, kOver, shorter), std::invalid_argument);
  const PathCertificate bare = certifyPath(checker_, kOver, {.clearances = false});
  EXPECT_THROW(writeProof(file, checker_, kOver, bare), std::invalid_argument);
}

}  // namespace
}  // namespace swept
