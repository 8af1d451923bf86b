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

Eigen::Vector4d unitQuaternion(const Eigen::Vector4d& typed, const std::string& what) {
  constexpr double kRounding = 1e-2;  // of the norm
  const double norm = typed.norm();
  if (!(std::abs(norm - 1.0) <= kRounding))
    throw UsageError(what + " has norm " + shortNumber(norm) + ", allowed is 1");
  return typed / norm;
}

Eigen::Isometry3d readPose(const std::string& text, const std::string& label) {
  const std::array<std::string, 7> names{"x", "y", "z", "qx", "qy", "qz", "qw"};
  const std::vector<double> v = readValues(text, names, label);
  const Eigen::Quaterniond turn(
      unitQuaternion({v[3], v[4], v[5], v[6]}, label + ": the quaternion"));
  return Eigen::Translation3d(v[0], v[1], v[2]) * turn;
}

Eigen::Isometry3d readPlace(const std::string& text, const std::string& label) {
  if (std::ranges::count(text, ',') != 2) return readPose(text, label);
  const std::array<std::string, 3> names{"x", "y", "z"};
  const std::vector<double> v = readValues(text, names, label);
  return Eigen::Isometry3d(Eigen::Translation3d(v[0], v[1], v[2]));
}

}  // namespace swept
