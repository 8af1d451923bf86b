// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <sstream>
#include <string>

namespace swept::detail {

/// For messages: `(1, 2.5, nan)`.
inline std::string pointText(const Eigen::Vector3d& p) {
  std::ostringstream out;
  out << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
  return out.str();
}

}  // namespace swept::detail
