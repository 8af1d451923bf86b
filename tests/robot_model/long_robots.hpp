// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "swept/robot_model/robot.hpp"
#include "urdf_text.hpp"

/// Robots of so many links that what is done for each pair of them has to be little.
namespace swept::test {

inline std::string smallLink(int i, const std::string& geometry) {
  return "<link name='l" + std::to_string(i) + "'><collision><origin xyz='0 0 0.05'/><geometry><" +
         geometry + "/></geometry></collision></link>\n";
}

inline std::string smallJoint(int parent, int child, const std::string& origin, double limit) {
  return joint("j" + std::to_string(child), "revolute", "l" + std::to_string(parent),
               "l" + std::to_string(child),
               "<origin xyz='" + origin + "'/>" +
                   limited(child % 2 != 0 ? "1 0 0" : "0 1 0", -limit, limit));
}

/// Links of 0.1 m one after the other, each a ball of `radius` (m), about axes that alternate.
inline std::shared_ptr<const Robot> ballChain(int links, double limit, double radius = 0.02) {
  std::string urdf = "<robot name='chain'><link name='l0'/>\n";
  for (int i = 1; i <= links; ++i)
    urdf += smallLink(i, "sphere radius='" + std::to_string(radius) + "'") +
            smallJoint(i - 1, i, "0 0 0.1", limit);
  return Robot::parse(urdf + "</robot>", "chain.urdf");
}

/// The same, of which every other joint slides by up to 0.1 m instead.
inline std::shared_ptr<const Robot> telescope(int links) {
  std::string urdf = "<robot name='telescope'><link name='l0'/>\n";
  for (int i = 1; i <= links; ++i) {
    urdf += smallLink(i, "sphere radius='0.02'");
    urdf += i % 2 != 0 ? smallJoint(i - 1, i, "0 0 0.1", 3.0)
                       : joint("j" + std::to_string(i), "prismatic", "l" + std::to_string(i - 1),
                               "l" + std::to_string(i),
                               "<origin xyz='0 0 0.1'/>" + limited("0 0 1", 0.0, 0.1));
  }
  return Robot::parse(urdf + "</robot>", "telescope.urdf");
}

/// Arms of one link each, 6 m long and turning about their middle, 0.1 m apart in a row: any two of
/// the nearer ones can meet.
inline std::shared_ptr<const Robot> combOfArms(int arms) {
  std::string urdf = "<robot name='comb'><link name='l0'/>\n";
  for (int i = 1; i <= arms; ++i)
    urdf += smallLink(i, "box size='0.02 0.02 6'") +
            smallJoint(0, i, "0 " + std::to_string(0.1 * i) + " 0", 3.0);
  return Robot::parse(urdf + "</robot>", "comb.urdf");
}

/// Fingers of so many links each on one palm.
inline std::shared_ptr<const Robot> handOf(int fingers, int links, double limit) {
  std::string urdf = "<robot name='hand'><link name='l0'/>\n";
  int link = 0;
  for (int finger = 0; finger < fingers; ++finger) {
    for (int i = 0; i < links; ++i) {
      const int parent = i == 0 ? 0 : link;
      ++link;
      urdf += smallLink(link, "sphere radius='0.02'") +
              smallJoint(parent, link,
                         i == 0 ? std::to_string(0.1 * finger) + " 0 0" : std::string("0 0 0.1"),
                         limit);
    }
  }
  return Robot::parse(urdf + "</robot>", "hand.urdf");
}

}  // namespace swept::test
