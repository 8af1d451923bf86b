// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/collision_rules.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::agreementOf;
using test::armSrdf;
using test::armUrdf;
using test::messageOf;
using test::parseArm;
using test::shared;

TEST(CollisionRules, TheRuleThatNamesMoreCountsAndOfEqualsTheLast) {
  CollisionRules rules;
  rules.allow("*", "table").check("hand", "*").allow("left_*_tip", "ta*e", "two patterns are less");
  EXPECT_TRUE(rules.allowed("arm", "table").value());
  EXPECT_TRUE(rules.allowed("table", "arm").value());
  EXPECT_FALSE(rules.allowed("hand", "table").value());
  EXPECT_FALSE(rules.allowed("table", "hand").value());
  EXPECT_EQ(rules.decisive("left_finger_tip", "table")->reason, "");
  EXPECT_EQ(rules.decisive("left__tip", "tale")->reason, "two patterns are less");
  EXPECT_FALSE(rules.allowed("left_tip", "shelf").has_value());
  EXPECT_FALSE(rules.allowed("arm", "shelf").has_value());
  EXPECT_EQ(rules.decisive("arm", "shelf"), nullptr);
  rules.allow("table", "hand", "both are named").check("*", "*", "all");
  EXPECT_EQ(rules.decisive("hand", "table")->reason, "both are named");
  EXPECT_EQ(rules.decisive("arm", "shelf")->reason, "all");
  rules.check("hand", "table", "later");
  EXPECT_EQ(rules.decisive("hand", "table")->reason, "later");
  EXPECT_EQ(rules.find(CollisionRules::Kind::Allow, "hand", "table")->reason, "both are named");
}

TEST(CollisionRules, AWeakerLayerCountsWhereTheStrongerIsSilent) {
  const CollisionRules scene = CollisionRules()
                                   .check("hand", "table", "the scene")
                                   .pad("hand", 0.03)
                                   .margin("hand", "cup", 0.2)
                                   .scale("cup", 2.0);
  const CollisionRules srdf = CollisionRules().allow("arm", "base", "the SRDF");
  CollisionRules rules = CollisionRules().allow("h*", "*", "the program").pad("*", 0.01);
  rules = rules.over(scene.over(srdf));
  // A pattern above wins from two names below.
  EXPECT_EQ(rules.decisive("hand", "table")->reason, "the program");
  EXPECT_EQ(rules.padding("hand"), 0.01);
  // What is allowed above says nothing about margins.
  EXPECT_EQ(rules.find(CollisionRules::Kind::Margin, "cup", "hand")->value, 0.2);
  EXPECT_EQ(rules.scale("cup"), 2.0);
  EXPECT_EQ(rules.decisive("base", "arm")->reason, "the SRDF");
  EXPECT_EQ(rules.decisive("base", "arm")->layer, 2);
  // What is added later is above all, and it does not matter how the layers were put together.
  EXPECT_EQ(CollisionRules(rules).check("*", "*", "now").decisive("base", "arm")->reason, "now");
  const CollisionRules again =
      CollisionRules().allow("h*", "*").pad("*", 0.01).over(scene).over(srdf);
  EXPECT_EQ(again.decisive("base", "arm")->layer, 2);
  EXPECT_EQ(CollisionRules().over(srdf).decisive("base", "arm")->layer, 0);
  EXPECT_EQ(rules.without("arm").decisive("base", "arm"), nullptr);
  EXPECT_EQ(rules.without("arm").decisive("hand", "table")->reason, "the program");
}

/// By what is written in the documentation, and by nothing else.
class Oracle {
 public:
  using Kind = CollisionRules::Kind;
  struct Said {
    Kind kind;
    std::string a, b;  ///< `b` empty: about a body
    double value;
  };
  std::vector<std::vector<Said>> layers;  ///< the strongest first

  /// The last of those that name the most, in the first layer that has one.
  const Said* find(const std::vector<Kind>& kinds, const std::string& a,
                   const std::string& b) const {
    for (const std::vector<Said>& layer : layers)
      for (int named = 2; named >= 0; --named)
        for (std::size_t i = layer.size(); i-- > 0;)
          if (namesOf(layer[i]) == named && layer[i].b.empty() == b.empty() &&
              std::ranges::find(kinds, layer[i].kind) != kinds.end() && isAbout(layer[i], a, b))
            return &layer[i];
    return nullptr;
  }

 private:
  static int namesOf(const Said& said) {
    int names = 0;
    for (const std::string* name : {&said.a, &said.b})
      names += !name->empty() && name->find('*') == std::string::npos ? 1 : 0;
    return names;
  }
  static bool fits(const std::string& pattern, const std::string& name) {
    if (pattern.empty()) return name.empty();
    if (pattern[0] == '*')
      return fits(pattern.substr(1), name) || (!name.empty() && fits(pattern, name.substr(1)));
    return !name.empty() && name[0] == pattern[0] && fits(pattern.substr(1), name.substr(1));
  }
  static bool isAbout(const Said& said, const std::string& a, const std::string& b) {
    return (fits(said.a, a) && fits(said.b, b)) || (fits(said.a, b) && fits(said.b, a));
  }
};

TEST(CollisionRules, TheRuleThatCountsIsTheOracles) {
  using Kind = CollisionRules::Kind;
  std::mt19937 random(7);
  const auto upTo = [&](std::size_t count) { return random() % count; };
  const std::vector<std::string> names{"a", "b", "ab", "ba"};
  const std::vector<std::string> patterns{"a", "b", "ab", "ba", "*", "a*", "*b", "*a*"};
  int found = 0, missed = 0, weaker = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Oracle oracle;
    std::vector<CollisionRules> layers;
    for (std::size_t layer = 0, count = 1 + upTo(4); layer < count; ++layer) {
      layers.emplace_back();
      oracle.layers.emplace_back();
      for (std::size_t i = 0, rules = upTo(4); i < rules; ++i) {
        const std::string a = patterns[upTo(patterns.size())];
        const std::string b = patterns[upTo(patterns.size())];
        const double value = 1.0 + 0.001 * static_cast<double>(upTo(1000000));
        const auto kind = static_cast<Kind>(upTo(5));
        const bool pair = kind == Kind::Allow || kind == Kind::Check || kind == Kind::Margin;
        oracle.layers.back().push_back({kind, a, pair ? b : "", value});
        const std::string reason = std::to_string(value);
        if (kind == Kind::Allow) layers.back().allow(a, b, reason);
        if (kind == Kind::Check) layers.back().check(a, b, reason);
        if (kind == Kind::Margin) layers.back().margin(a, b, value, reason);
        if (kind == Kind::Padding) layers.back().pad(a, value, reason);
        if (kind == Kind::Scale) layers.back().scale(a, value, reason);
      }
    }
    // From the top or from the bottom: it is the same.
    CollisionRules rules = trial % 2 == 0 ? layers.front() : layers.back();
    for (std::size_t i = 1; i < layers.size(); ++i)
      rules = trial % 2 == 0 ? rules.over(layers[i]) : layers[layers.size() - 1 - i].over(rules);
    const auto expectSame = [&](const CollisionRules::Rule* rule, const Oracle::Said* said) {
      ASSERT_EQ(rule == nullptr, said == nullptr) << trial;
      ++(rule == nullptr ? missed : found);
      if (rule == nullptr) return;
      EXPECT_EQ(rule->reason, std::to_string(said->value)) << trial;
      EXPECT_EQ(rule->kind, said->kind) << trial;
      weaker += rule->layer > 0 ? 1 : 0;
    };
    const std::string a = names[upTo(names.size())];
    const std::string b = names[upTo(names.size())];
    expectSame(rules.decisive(a, b), oracle.find({Kind::Allow, Kind::Check}, a, b));
    expectSame(rules.find(Kind::Margin, a, b), oracle.find({Kind::Margin}, a, b));
    expectSame(rules.find(Kind::Padding, a), oracle.find({Kind::Padding}, a, ""));
    expectSame(rules.find(Kind::Scale, a), oracle.find({Kind::Scale}, a, ""));
  }
  EXPECT_GT(found, 2000);
  EXPECT_GT(missed, 2000);
  EXPECT_GT(weaker, 500);
}

TEST(CollisionRules, APatternMatchesWhatItSays) {
  const auto matches = [](const std::string& pattern, const std::string& name) {
    return CollisionRules().pad(pattern, 1.0).padding(name) == 1.0;
  };
  for (const char* pattern : {"*", "**", "a*", "*c", "a*c", "*b*", "abc", "*a*b*c*", "a**c"})
    EXPECT_TRUE(matches(pattern, "abc")) << pattern;
  for (const char* pattern : {"b*", "*b", "ab", "abcd", "a*d", "*ac*", "ABC", "abc?"})
    EXPECT_FALSE(matches(pattern, "abc")) << pattern;
  EXPECT_TRUE(matches("a*b*c", "a_b_b_c_c"));
  EXPECT_FALSE(matches("a*b*c", "a_b_b_c_d"));
  EXPECT_TRUE(matches("*", ""));
}

TEST(CollisionRules, PaddingsAndScalesAreOfOneBody) {
  CollisionRules rules;
  rules.pad("*", 0.01).pad("hand", 0.02).scale("fore*", 1.5);
  EXPECT_EQ(rules.padding("hand"), 0.02);
  EXPECT_EQ(rules.padding("table"), 0.01);
  EXPECT_EQ(rules.scale("forearm"), 1.5);
  EXPECT_EQ(rules.scale("hand"), 1.0);
  // A rule about a body says nothing about pairs, nor the other way round.
  EXPECT_FALSE(rules.allowed("hand", "table").has_value());
  EXPECT_EQ(CollisionRules().margin("hand", "*", 0.3).padding("hand"), 0.0);
  EXPECT_TRUE(CollisionRules().empty());
  EXPECT_FALSE(rules.empty());
}

TEST(CollisionRules, WithoutABodyItsOwnRulesAreGone) {
  CollisionRules rules;
  rules.allow("hand", "cup").pad("cup", 0.01).pad("c*", 0.02).allow("*", "table");
  const CollisionRules left = rules.without("cup");
  ASSERT_EQ(left.rules().size(), 2U);
  EXPECT_EQ(left.padding("cup"), 0.02);
  EXPECT_FALSE(left.allowed("hand", "cup").has_value());
  EXPECT_EQ(rules.rules().size(), 4U);
}

/// The paddings of all bodies were gone with one whose name was that of a pattern.
TEST(CollisionRules, APatternIsNoBodysOwn) {
  CollisionRules rules;
  rules.pad("*", 0.01).pad("c*", 0.02);
  EXPECT_EQ(rules.without("*").padding("hand"), 0.01);
  EXPECT_EQ(rules.without("c*").padding("cup"), 0.02);
}

TEST(CollisionRules, ImpossibleValuesAreErrors) {
  CollisionRules rules;
  EXPECT_EQ(messageOf([&] { rules.pad("hand", -1e-9); }),
            "CollisionRules: the padding of 'hand', -1e-09 m, must be a finite number that is not "
            "negative");
  EXPECT_EQ(messageOf([&] { rules.margin("a", "b", std::nan("")); }),
            "CollisionRules: the margin of 'a' and 'b', nan m, must be a finite number that is not "
            "negative");
  EXPECT_EQ(messageOf([&] { rules.scale("hand", 0.0); }),
            "CollisionRules: the scale of 'hand', 0, must be a finite number above zero");
  EXPECT_EQ(messageOf([&] { rules.scale("hand", HUGE_VAL); }),
            "CollisionRules: the scale of 'hand', inf, must be a finite number above zero");
  EXPECT_EQ(messageOf([&] { rules.allow("hand", ""); }),
            "CollisionRules: a body's name must not be empty");
  EXPECT_TRUE(rules.empty());
}

TEST(CollisionRules, ARuleAboutABodyThatIsNotThereIsAnError) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared(test::clutter(1));
  const auto make = [&](const CollisionRules& rules) {
    return messageOf([&] { Checker(robot, "all", world, {.rules = rules}); });
  };
  EXPECT_EQ(make(CollisionRules().pad("hnad", 0.01)),
            "Checker: a rule names 'hnad', which is no link, attached body or body of the world");
  EXPECT_EQ(make(CollisionRules().allow("hand", "cup")),
            "Checker: a rule names 'cup', which is no link, attached body or body of the world");
  EXPECT_EQ(make(CollisionRules().allow("hand", "body1").pad("c*", 0.1)), "");
}

TEST(CollisionRules, AllowIsWhatAnSrdfDisables) {
  const std::string urdf = armUrdf({});
  const auto world = shared({});
  const auto plain = parseArm(urdf);
  const auto disabling = parseArm(urdf, armSrdf({{"base", "hand"}, {"base", "fore"}}));
  const Checker bySrdf(disabling, "all", world);
  const Checker same(plain, "all", world, {.rules = CollisionRules().allow("base", "*")});
  const test::Agreement agreement = agreementOf(same, bySrdf, 400, 1);
  EXPECT_EQ(agreement.differing, 0);
  EXPECT_GT(agreement.free, 600);
  // The rule takes away contacts that there are.
  const Checker all(plain, "all", world);
  EXPECT_GT(agreementOf(all, same, 400, 1).differing, 50);
}

TEST(CollisionRules, CheckOverridesTheSrdf) {
  const std::string urdf = armUrdf({});
  const auto world = shared({});
  const Checker all(parseArm(urdf), "all", world);
  const Checker again(parseArm(urdf, armSrdf({{"base", "hand"}, {"base", "fore"}})), "all", world,
                      {.rules = CollisionRules().check("base", "hand").check("fore", "base")});
  agreementOf(all, again, 1000, 2).expectRepresentative(100);
}

TEST(CollisionRules, AnAllowedWorldBodyIsAsGoodAsGone) {
  const auto robot = parseArm(armUrdf({}));
  const World full = test::clutter(12);
  World less = full;
  CollisionRules rules = CollisionRules().allow("body4", "*", "a curtain");
  EXPECT_TRUE(less.remove("body4"));
  EXPECT_FALSE(less.remove("body4"));
  for (const char* name : {"body0", "body1", "body2", "body5", "body7"}) {
    rules.allow("*", name);
    EXPECT_TRUE(less.remove(name));
  }
  const Checker allowing(robot, "all", shared(full), {.rules = rules});
  const Checker without(robot, "all", shared(less));
  agreementOf(allowing, without, 600, 3).expectRepresentative(100);
  EXPECT_GT(agreementOf(Checker(robot, "all", shared(full)), without, 600, 3).differing, 20);
}

}  // namespace
}  // namespace swept
