// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <string>

namespace swept::detail {

/// The first face of a file that crosses itself, or else the first that touches itself, for a
/// message to name: assimp may make fewer triangles of one than it has, and says nothing. No proof
/// rests on it.
class CrossingFace {
 public:
  /// Looks at a face, if it has more than 4 corners and none was found yet. `line` counts from 1;
  /// 0: it is `face`, counted from 0, of a file without lines. `face` is said in either case where
  /// it is not negative.
  void look(std::span<const Eigen::Vector3d> corners, int line, std::int64_t face = -1);
  /// `its line 6: a face of 5 corners`; empty: none was found.
  const std::string& name() const { return crossing_.empty() ? touching_ : crossing_; }

 private:
  std::string crossing_, touching_;
  std::uint64_t looks_ = 0;  ///< at two edges
};

}  // namespace swept::detail
