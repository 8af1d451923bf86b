// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "program.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// An arm of three links on a base: the upper one reaches neither the base nor `wall`, which stands
/// a quarter turn away, the hand reaches both. `cap` sits in the base.
class Mill {
  TemporaryFolder folder_;

 public:
  Mill()
      : urdf(folder_.write("mill.urdf", R"(<?xml version="1.0"?>
<robot name="mill">
  <link name="base"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="cap"><collision><origin xyz="0 0 0.02"/><geometry><sphere radius="0.05"/></geometry></collision></link>
  <link name="stand"/>
  <link name="wall"><collision><geometry><box size="0.2 0.02 0.4"/></geometry></collision></link>
  <link name="shoulder"/>
  <link name="upper"><collision><origin xyz="0.2 0 0"/><geometry><box size="0.2 0.04 0.04"/></geometry></collision></link>
  <link name="elbow"/>
  <link name="hand"><collision><origin xyz="0.22 0 0"/><geometry><sphere radius="0.04"/></geometry></collision></link>
  <joint name="in" type="fixed"><parent link="base"/><child link="stand"/></joint>
  <joint name="on" type="fixed"><parent link="stand"/><child link="cap"/></joint>
  <joint name="beside" type="fixed"><parent link="stand"/><child link="wall"/><origin xyz="0 0.45 0"/></joint>
  <joint name="pan" type="continuous"><parent link="base"/><child link="shoulder"/><axis xyz="0 0 1"/></joint>
  <joint name="hold" type="fixed"><parent link="shoulder"/><child link="upper"/></joint>
  <joint name="bend" type="revolute"><parent link="upper"/><child link="elbow"/><origin xyz="0.3 0 0"/>
    <axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="grip" type="fixed"><parent link="elbow"/><child link="hand"/></joint>
</robot>
)")) {}
  std::string write(const std::string& name, const std::string& pairs) const {
    return folder_.write(name,
                         "<robot name=\"mill\">\n  <group name=\"arm\"><joint name=\"pan\"/>"
                         "<joint name=\"bend\"/></group>\n" +
                             pairs + "</robot>\n");
  }
  const TemporaryFolder& folder() const { return folder_; }

  std::string urdf;
};

std::string disabled(const std::string& a, const std::string& b, const std::string& reason) {
  return "  <disable_collisions link1=\"" + a + "\" link2=\"" + b + "\" reason=\"" + reason +
         "\"/>\n";
}

TEST(Acm, SaysWhyForEachPairAndWritesAnSrdf) {
  const Mill mill;
  const std::string out = mill.folder().path("out.srdf");
  const Outcome run = runSwept({"acm", mill.urdf, "-o", out});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const std::string plain = std::regex_replace(run.out, std::regex("[0-9.e+-]+ s\n"), "# s\n");
  EXPECT_THAT(plain, HasSubstr("link   link   collision    why\n"
                               "base   cap    always       rigidly attached\n"
                               "base   wall   never        rigidly attached\n"
                               "base   upper  never        proven for 1 variable\n"
                               "base   hand   may collide  at pan="));
  EXPECT_THAT(plain, HasSubstr("wall   upper  never        proven for 1 variable\n"));
  EXPECT_THAT(plain, HasSubstr("upper  hand   may collide  at bend="));
  EXPECT_THAT(plain, HasSubstr("10 pairs: 0 adjacent, 5 never, 1 always, 0 default, 4 may collide, "
                               "0 unknown; # s\nSRDF written to " +
                               out + "\n"));
  EXPECT_EQ(mill.folder().read("out.srdf"),
            "<?xml version=\"1.0\"?>\n<robot name=\"mill\">\n" + disabled("base", "cap", "Always") +
                disabled("base", "wall", "Never") + disabled("base", "upper", "Never") +
                disabled("cap", "wall", "Never") + disabled("cap", "upper", "Never") +
                disabled("wall", "upper", "Never") + "</robot>\n");
  // It is read back, and what it disables is as it says.
  const auto info = jsonOf(runSwept({"info", mill.urdf, "--srdf", out, "--json"}));
  EXPECT_EQ(info["disabled_pairs"].size(), 6u);
  const Outcome again = runSwept({"acm", mill.urdf, "--srdf", out});
  EXPECT_EQ(again.exitCode, 0);
  EXPECT_THAT(again.out, HasSubstr("SRDF " + out + ": 6 disabled, 0 different\n"));
}

TEST(Acm, ComparesWithTheSrdfBesideTheUrdf) {
  const Mill mill;
  const std::string srdf = mill.write("mill.srdf", disabled("hand", "base", "Never") +
                                                       disabled("base", "cap", "Default") +
                                                       disabled("base", "upper", "Never"));
  const Outcome run = runSwept({"acm", mill.urdf, "-o", srdf});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, HasSubstr("SRDF " + srdf + ": 3 disabled, 5 different\n"));
  EXPECT_THAT(run.out,
              HasSubstr("disabled in the SRDF, but may collide:\n  base - hand (Never): pan="));
  EXPECT_THAT(run.out, HasSubstr("checked in vain, never collide:\n  base - wall\n"));

  // The command that it prints confirms the witness.
  std::smatch match;
  ASSERT_TRUE(std::regex_search(run.out, match, std::regex("\n    (swept check [^\n]*)\n")));
  const Outcome check = runShell(match[1].str());
  EXPECT_EQ(check.exitCode, 1) << check.err;
  EXPECT_THAT(check.out, HasSubstr("  base - hand: distance "));

  // The rest of the file is as it was.
  EXPECT_THAT(mill.folder().read("mill.srdf"),
              testing::StartsWith("<robot name=\"mill\">\n  <group name=\"arm\">"
                                  "<joint name=\"pan\"/><joint name=\"bend\"/></group>\n" +
                                  disabled("base", "cap", "Always")));
  const Outcome again = runSwept({"acm", mill.urdf});
  EXPECT_EQ(again.exitCode, 0);
  EXPECT_THAT(again.out, HasSubstr(": 6 disabled, 0 different\n"));
}

TEST(Acm, NothingIsDisabledOnSamplesAlone) {
  const Mill mill;
  const std::string srdf = mill.write("some.srdf", disabled("base", "upper", "Never"));
  const std::string out = mill.folder().path("out.srdf");
  const Outcome run =
      runSwept({"acm", mill.urdf, "--srdf", srdf, "--budget", "0", "--samples", "500", "-o", out});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(
      run.out,
      HasSubstr("base   upper  unknown      0.0 % proven, for 1 variable, nearest seen 0.0"));
  EXPECT_THAT(run.out,
              HasSubstr("disabled in the SRDF, not known to be apart:\n  base - upper (Never)\n"));
  EXPECT_THAT(mill.folder().read("out.srdf"), Not(HasSubstr("upper")));
}

TEST(Acm, TheMarginCounts) {
  const Mill mill;
  // The upper arm's end is 0.3 m from the axis, the wall 0.44 m.
  const auto statusAt = [&](const char* margin) {
    const Outcome run = runSwept({"acm", mill.urdf, "--json", "--margin", margin});
    const auto json = jsonOf(run);
    for (const auto& pair : json["pairs"])
      if (pair["link_a"] == "wall" && pair["link_b"] == "upper")
        return pair["status"].get<std::string>();
    return std::string("none");
  };
  EXPECT_EQ(statusAt("0.13"), "never");
  EXPECT_EQ(statusAt("0.15"), "may collide");
}

TEST(Acm, JsonHoldsTheSame) {
  const Mill mill;
  const std::string srdf = mill.write("some.srdf", disabled("base", "hand", "Never"));
  const Outcome run = runSwept({"acm", mill.urdf, "--srdf", srdf, "--json"});
  EXPECT_EQ(run.exitCode, 1);
  const auto json = jsonOf(run);
  EXPECT_EQ(json["srdf"], srdf);
  EXPECT_EQ(json["counts"]["never"], 5);
  EXPECT_EQ(json["counts"]["may collide"], 4);
  ASSERT_EQ(json["pairs"].size(), 10u);
  for (const auto& pair : json["pairs"]) {
    const bool touches = pair["status"] == "may collide" || pair["status"] == "always";
    EXPECT_EQ(pair["witness"].is_object(), touches) << pair;
    EXPECT_EQ(pair["witness"].size(), touches ? pair["variables"].size() : 0) << pair;
    EXPECT_EQ(pair["proven"] == 1.0, pair["status"] == "never") << pair;
  }
  EXPECT_EQ(json["differences"][0]["kind"], "disabled_but_may_collide");
  EXPECT_THAT(json["differences"][0]["command"].get<std::string>(),
              testing::StartsWith("swept check " + mill.urdf + " --srdf none "));
  EXPECT_TRUE(json["output"].is_null());
  // The same seed, the same witnesses.
  const auto again = jsonOf(runSwept({"acm", mill.urdf, "--srdf", srdf, "--json"}));
  EXPECT_EQ(again["pairs"], json["pairs"]);
}

TEST(Acm, RefusesWhatCannotBeUsed) {
  const Mill mill;
  const std::string broken = mill.folder().write("broken.srdf", "<robot name='mill'>\n<group>\n");
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  for (const Case& c : {
           Case{{"acm"}, "swept: error: robot is required"},
           Case{{"acm", "none.urdf"}, "none.urdf: error: file not found"},
           Case{{"acm", mill.urdf, "--srdf", broken}, broken + ":2: error: malformed XML"},
           Case{{"acm", mill.urdf, "-o", mill.folder().path("no/such.srdf")}, "cannot write '"},
           Case{{"acm", mill.urdf, "-o", mill.folder().path()}, "Is a directory"},
           Case{{"acm", mill.urdf, "--budget", "-1"}, "must be between 0 and 1e15, not -1"},
           Case{{"acm", mill.urdf, "--samples", "x"}, "must be between 0 and 1e9, not x"},
           Case{{"acm", mill.urdf, "--seed", "0"}, "must be between 1 and 4294967295, not 0"},
           Case{{"acm", mill.urdf, "--group", "arm"}, "--group"},
       }) {
    const Outcome run = runSwept(c.arguments);
    EXPECT_EQ(run.exitCode, 3) << c.message;
    EXPECT_EQ(run.out, "");
    EXPECT_THAT(run.err, HasSubstr(c.message));
  }
}

}  // namespace
}  // namespace swept::test
