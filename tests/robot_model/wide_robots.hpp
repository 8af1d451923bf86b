// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "../urdf_text.hpp"

/// Robots whose limits can be as wide as one likes.
namespace swept::wide_test {

using test::joint;
using test::limited;

inline const std::string kNone = "<axis xyz='0 1 0'/>";

inline std::string link(const std::string& name, const std::string& geometry = "",
                        const std::string& origin = "0 0 0") {
  if (geometry.empty()) return "<link name='" + name + "'/>";
  return "<link name='" + name + "'><collision><origin xyz='" + origin + "'/><geometry>" +
         geometry + "</geometry></collision></link>";
}

inline std::string origin(const std::string& xyz) {
  return "<origin xyz='" + xyz + "' rpy='0.3 0 0'/>";
}

/// The text of a robot whose limited joints go from -limit to limit.
struct Family {
  std::string name;
  std::string (*text)(double limit);
  std::size_t dimension;
};

inline const std::string kBall = "<sphere radius='0.1'/>";
inline const std::string kBar = "<box size='0.3 0.08 0.06'/>";

/// Each joint alone, slides in front of what turns, behind it and on both sides, parallel to its
/// axis and across it, and fingers of which one follows the other.
inline std::vector<Family> families() {
  return {
      {"slide",
       [](double limit) {
         return link("l0") + link("l1", kBall) +
                joint("a", "prismatic", "l0", "l1", limited("1 0 0", -limit, limit));
       },
       1},
      {"turn",
       [](double limit) {
         return link("l0") + link("l1", kBar, "0.4 0 0") +
                joint("a", "revolute", "l0", "l1", limited("0 0 1", -limit, limit));
       },
       1},
      {"turn without limits",
       [](double limit) {
         return link("l0") + link("l1") + link("l2", kBar, "0.3 0 0") +
                joint("a", "continuous", "l0", "l1", kNone) +
                joint("b", "prismatic", "l1", "l2",
                      origin("0 0 0.2") + limited("1 0 0", -limit, limit));
       },
       2},
      {"slide on what turns",
       [](double limit) {
         return link("l0", kBall, "0 0 -0.5") + link("l1", kBar, "0.2 0 0") +
                link("l2", kBar, "0.2 0 0") +
                joint("a", "revolute", "l0", "l1", limited("0 0 1", -limit, limit)) +
                joint("b", "prismatic", "l1", "l2",
                      origin("0.3 0 0.2") + limited("1 1 0", -limit, limit));
       },
       2},
      {"selective compliance",
       [](double limit) {
         return link("l0") + link("l1", kBar, "0.2 0 0") + link("l2", kBar, "0.2 0 0.1") +
                link("l3", kBall) +
                joint("a", "revolute", "l0", "l1", limited("0 0 1", -limit, limit)) +
                joint("b", "revolute", "l1", "l2",
                      "<origin xyz='0.4 0 0.1'/>" + limited("0 0 1", -limit, limit)) +
                joint("c", "prismatic", "l2", "l3",
                      "<origin xyz='0.4 0 0'/>" + limited("0 0 1", -limit, limit));
       },
       3},
      {"arm between slides",
       [](double limit) {
         return link("l0", kBall, "-0.6 0 0") + link("l1") + link("l2", kBar, "0.2 0 0") +
                link("l3", kBall, "0.1 0 0") + link("l4", kBall, "0.2 0 0") +
                joint("a", "prismatic", "l0", "l1", limited("0 0 1", -limit, limit)) +
                joint("b", "revolute", "l1", "l2", limited("0 1 0", -limit, limit)) +
                joint("c", "prismatic", "l2", "l3",
                      origin("0.3 0 0") + limited("1 0 0", -limit, limit)) +
                joint("d", "revolute", "l3", "l4",
                      origin("0.2 0 0") + limited("0 1 1", -limit, limit));
       },
       4},
      {"fingers",
       [](double limit) {
         return link("l0") + link("l1", kBar, "0.2 0 0") + link("l2", kBall, "0.5 0.2 0") +
                link("l3", kBall, "0.5 -0.2 0") +
                joint("a", "revolute", "l0", "l1", limited("0 0 1", -limit, limit)) +
                joint("b", "prismatic", "l1", "l2", limited("0 1 0", -limit, limit)) +
                joint("c", "prismatic", "l1", "l3",
                      limited("0 -1 0", -limit, limit) +
                          "<mimic joint='b' multiplier='0.9' offset='0.01'/>");
       },
       2},
  };
}

}  // namespace swept::wide_test
