// SPDX-License-Identifier: BSD-3-Clause
// SRDFs with disabled pairs: what is written is read back, and the rest stays byte for byte.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "input_files.hpp"
#include "matrix_robots.hpp"

namespace swept {
namespace {

std::shared_ptr<const Robot> robot() {
  return Robot::parse(
      "<robot name='r&amp;d'><link name='a'/><link name='b'/><link name='c &lt; d'/>"
      "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>"
      "<joint name='k' type='continuous'><parent link='b'/><child link='c &lt; "
      "d'/></joint></robot>",
      "r.urdf");
}

LinkPairReport pairOf(int a, int b, PairStatus status) {
  LinkPairReport report;
  report.linkA = a;
  report.linkB = b;
  report.status = status;
  return report;
}

std::vector<LinkPairReport> reports() {
  return {pairOf(0, 1, PairStatus::MayCollide), pairOf(0, 2, PairStatus::Never),
          pairOf(1, 2, PairStatus::Adjacent)};
}

const std::string kNever = R"(<disable_collisions link1="a" link2="c &lt; d" reason="Never"/>)";
const std::string kAdjacent =
    R"(<disable_collisions link1="b" link2="c &lt; d" reason="Adjacent"/>)";

std::string rewritten(const std::string& text) {
  return srdfWithPairs(*robot(), reports(), text, "r.srdf");
}

TEST(SrdfPairs, OnlyCertainReasonsAreWritten) {
  std::vector<LinkPairReport> pairs = reports();
  pairs[0].status = PairStatus::Unknown;
  pairs[1].status = PairStatus::Default;
  pairs[2].status = PairStatus::Always;
  const std::string text = srdfWithPairs(*robot(), pairs);
  EXPECT_EQ(text,
            "<?xml version=\"1.0\"?>\n<robot name=\"r&amp;d\">\n"
            "  <disable_collisions link1=\"a\" link2=\"c &lt; d\" reason=\"Default\"/>\n"
            "  <disable_collisions link1=\"b\" link2=\"c &lt; d\" reason=\"Always\"/>\n"
            "</robot>\n");
}

TEST(SrdfPairs, ANewOneIsReadBack) {
  test::Warnings warnings;
  const std::string text = rewritten("");
  const auto back = Robot::parse(
      "<robot name='r&amp;d'><link name='a'/><link name='b'/><link name='c &lt; d'/>"
      "<joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>"
      "<joint name='k' type='continuous'><parent link='b'/><child link='c &lt; "
      "d'/></joint></robot>",
      "r.urdf", text, "r.srdf", warnings.options());
  ASSERT_EQ(back->disabledPairs().size(), 2u);
  EXPECT_EQ(back->disabledPairs()[0].linkB, 2);
  EXPECT_EQ(back->disabledPairs()[0].reason, "Never");
  EXPECT_EQ(back->disabledPairs()[1].reason, "Adjacent");
  EXPECT_THAT(warnings.lines, testing::IsEmpty());
}

TEST(SrdfPairs, ReplacesWhereTheFirstOneStands) {
  const std::string before =
      "<?xml version='1.0'?>\n<!-- <disable_collisions link1='a' link2='b'/> -->\n"
      "<robot   name=\"r&amp;d\" >\n\t<group name='g'><joint name='j'/></group>\n"
      "<![CDATA[<disable_collisions/>]]>\n";
  const std::string after =
      "  <passive_joint name='k' />   <!-- x > y -->\n\n</robot>\n<!-- end -->";
  EXPECT_EQ(rewritten(before +
                      "    <disable_collisions link1='a' link2='b' reason='>'/>\n"
                      "  <!-- kept -->\n"
                      "\t<disable_collisions link1='a' link2='c &lt; d'\n reason='old'>\n"
                      "</disable_collisions>  \n" +
                      after),
            before + "    " + kNever + "\n    " + kAdjacent + "\n  <!-- kept -->\n" + after);
  // Not alone in its line, and lines that end as Windows ends them.
  EXPECT_EQ(rewritten("<robot name='r&amp;d'><disable_collisions link1='a' link2='b'/><!-- a -->"
                      "<disable_collisions link1='a' link2='b'/></robot>"),
            "<robot name='r&amp;d'>" + kNever + kAdjacent + "<!-- a --></robot>");
  EXPECT_EQ(rewritten("<robot name='r&amp;d'>\r\n <disable_collisions link1='a' link2='b'/>\r\n"
                      "</robot>\r\n"),
            "<robot name='r&amp;d'>\r\n " + kNever + "\r\n " + kAdjacent + "\r\n</robot>\r\n");
}

TEST(SrdfPairs, AddsWhereThereAreNone) {
  const std::string lines = "  " + kNever + "\n  " + kAdjacent + "\n";
  EXPECT_EQ(rewritten("<robot name='r&amp;d'>\n  </robot>\n"),
            "<robot name='r&amp;d'>\n" + lines + "  </robot>\n");
  EXPECT_EQ(rewritten("<robot name='r&amp;d'></robot>"),
            "<robot name='r&amp;d'>\n" + lines + "</robot>");
  EXPECT_EQ(rewritten("<robot name='r&amp;d'/><!-- / -->"),
            "<robot name='r&amp;d'>\n" + lines + "</robot><!-- / -->");
}

TEST(SrdfPairs, KeepsWhatItDoesNotKnowAndWhatIsEnabled) {
  const std::string unknown = "<disable_collisions link1='a' link2='ghost' reason='Never'/>\n";
  const std::string enabled = "<enable_collisions link1='c &lt; d' link2='a'/>\n";
  EXPECT_EQ(rewritten("<robot name='r&amp;d'>\n" + unknown +
                      "<disable_collisions link1='a' link2='b' reason='Never'/>\n" + enabled +
                      "</robot>"),
            "<robot name='r&amp;d'>\n" + unknown + kAdjacent + "\n" + enabled + "</robot>");
  EXPECT_EQ(
      rewritten("<robot name='r&amp;d'>\n" + unknown + "</robot>"),
      "<robot name='r&amp;d'>\n" + unknown + "  " + kNever + "\n  " + kAdjacent + "\n</robot>");
}

TEST(SrdfPairs, RefusesWhatIsNoSrdf) {
  EXPECT_EQ(test::inputError([] { rewritten("<robot>\n<disable_collisions link1='a'/></robot>"); }),
            "r.srdf:1: error: <robot> has no attribute 'name'");
  EXPECT_THAT(test::inputError([] { rewritten("<robot name='x'>\n<group>"); }),
              testing::StartsWith("r.srdf:2: error: malformed XML: "));
}

}  // namespace
}  // namespace swept
