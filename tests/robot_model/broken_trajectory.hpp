// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ostream>
#include <string>

namespace swept::test {

/// A file that is refused for the group `whole` of pathRobot().
struct BrokenTrajectory {
  const char* name;
  std::string text;
  std::string message;
};

inline void PrintTo(const BrokenTrajectory& broken, std::ostream* out) {
  *out << broken.text;
}

/// What a message about an unknown joint ends with.
inline const std::string kHas = "; group 'whole' has vj/x, vj/y, vj/theta, turn, wheel, slide";

}  // namespace swept::test
