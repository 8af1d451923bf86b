// SPDX-License-Identifier: BSD-3-Clause
#include "input/poses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "command_line/exit_code.hpp"
#include "input/states.hpp"
#include "output/text_output.hpp"

namespace swept {

Eigen::Isometry3d readPose(const std::string& text, const std::string& label) {
  constexpr double kQuaternionNorm = 1e-2;  // how far from 1 one typed with a few digits may be
  const std::array<std::string, 7> names{"x", "y", "z", "qx", "qy", "qz", "qw"};
  const std::vector<double> v = readValues(text, names, label);
  const Eigen::Quaterniond turn(v[6], v[3], v[4], v[5]);
  if (!(std::abs(turn.norm() - 1.0) <= kQuaternionNorm))
    throw UsageError(label + ": the quaternion has norm " + shortNumber(turn.norm()) +
                     ", allowed is 1");
  return Eigen::Translation3d(v[0], v[1], v[2]) * turn.normalized();
}

Eigen::Isometry3d readPlace(const std::string& text, const std::string& label) {
  if (std::ranges::count(text, ',') != 2) return readPose(text, label);
  const std::array<std::string, 3> names{"x", "y", "z"};
  const std::vector<double> v = readValues(text, names, label);
  return Eigen::Isometry3d(Eigen::Translation3d(v[0], v[1], v[2]));
}

}  // namespace swept
