// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "swept/robot_model/checker.hpp"

/// What Free says nothing about can be asked for.
namespace swept {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::string link(const std::string& name, const std::string& inside) {
  return "<link name='" + name + "'>" + inside + "</link>";
}

std::string slide(const std::string& parent, const std::string& child) {
  return "<joint name='" + child + "' type='prismatic'><parent link='" + parent +
         "'/><child link='" + child + "'/><axis xyz='1 0 0'/><limit lower='-1' upper='1'/></joint>";
}

const std::string kShape = "<geometry><sphere radius='0.1'/></geometry>";
const std::string kShown = "<visual>" + kShape + "</visual>";
const std::string kSolid = "<collision>" + kShape + "</collision>";

/// A base and two slides beside each other.
std::shared_ptr<const Robot> twoSlides(const std::string& base, const std::string& a,
                                       const std::string& b, const LoadOptions& options = {}) {
  return Robot::parse("<robot name='r'>" + link("base", base) + link("a", a) + link("b", b) +
                          slide("base", "a") + slide("base", "b") + "</robot>",
                      "r.urdf", {}, {}, options);
}

TEST(LinksWithoutGeometry, AreThoseThatAreOnlyShown) {
  EXPECT_THAT(twoSlides(kShown, kShown + kSolid, "")->linksWithoutGeometry(), ElementsAre("base"));
  EXPECT_THAT(twoSlides("", kSolid, "<visual/>")->linksWithoutGeometry(), IsEmpty());
  const Checker checker(twoSlides(kShown, kShown, kSolid), "all", std::make_shared<World>());
  // The base does not move.
  EXPECT_THAT(checker.linksWithoutGeometry(), ElementsAre("a"));
}

TEST(LinksWithoutGeometry, AreWarnedOfApartFromTheRest) {
  std::vector<std::string> plain, unchecked;
  LoadOptions options;
  options.warn = [&](const std::string& line) { plain.push_back(line); };
  twoSlides("", kShown, kSolid, options);
  EXPECT_THAT(plain, ElementsAre("r.urdf:1: warning: link 'a' has a <visual> and no <collision>: "
                                 "nothing is checked against it"));
  plain.clear();
  options.warnOfUnchecked = [&](const std::string& line) { unchecked.push_back(line); };
  twoSlides("", kShown, kShown, options);
  EXPECT_THAT(plain, IsEmpty());
  EXPECT_THAT(unchecked, ElementsAre("r.urdf:1: warning: links 'a', 'b' have a <visual> and no "
                                     "<collision>: nothing is checked against them"));
}

TEST(CheckerThatChecksNothing, SaysSo) {
  const auto empty = std::make_shared<const World>();
  const auto far = std::make_shared<World>();
  far->add("post", makeSphere(0.1), Eigen::Isometry3d(Eigen::Translation3d(0, 50, 0)));
  EXPECT_FALSE(Checker(twoSlides("", kSolid, kSolid), "all", empty).checksNothing());
  EXPECT_TRUE(Checker(twoSlides("", kSolid, ""), "all", empty).checksNothing());
  EXPECT_TRUE(Checker(twoSlides("", kShown, kShown), "all", far).checksNothing());
  // Of no pair that is looked at, but one that is proven out of reach.
  const Checker proven(twoSlides("", kSolid, ""), "all", far);
  EXPECT_THAT(proven.checkedPairs(), IsEmpty());
  EXPECT_FALSE(proven.checksNothing());
  CheckerOptions allowed;
  allowed.rules.allow("a", "b");
  EXPECT_TRUE(Checker(twoSlides("", kSolid, kSolid), "all", empty, allowed).checksNothing());
}

TEST(EmptyScenes, AreWarnedOf) {
  const test::TemporaryFolder folder;
  test::Warnings warnings;
  const auto file = folder.write("empty.scene", "empty\n.\n");
  World::load(file, warnings.options());
  EXPECT_THAT(warnings.lines,
              ElementsAre(file.string() + ": warning: no body of the scene has geometry: the robot "
                                          "is checked in an empty world"));
}

}  // namespace
}  // namespace swept
