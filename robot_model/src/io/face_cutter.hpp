// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "io/input_source.hpp"

namespace swept::detail {

/// Cuts the faces of one file into triangles: n - 2 of a face of n corners.
///
/// A face with 4 corners is divided from its first corner, or from the one where it is concave. A
/// larger one is seen along the coordinate axis nearest to its normal. If all triangles from its
/// first corner turn the way of the face, it is divided from there. Otherwise ears are cut off:
/// corners that turn that way, with no other corner in their triangle.
///
/// Lemma: seen along that axis and up to the rounding of a double, the triangles of a larger face
/// cover exactly the region that it winds around. For a flat face that is the whole face. Proof:
/// the winding number of a face is the sum of those of its triangles, however it is cut. Each of
/// these is 0 or 1, since all triangles turn the same way. A face without such triangles, for
/// example one that crosses itself, is refused.
///
/// If a face is not flat, other triangles would be another surface. A proof is about these
/// triangles.
class FaceCutter {
 public:
  /// `source` outlives it.
  explicit FaceCutter(const InputSource& source) : source_(source) {}

  /// Appends the triangles of a face whose `corners`, 3 or more, index `vertices`. Throws
  /// InputError for a face that cannot be cut. The message names the `line`, counted from 1; 0
  /// stands for a file without lines. It names `face`, counted from 0, where that is not negative.
  void cut(std::span<const int> corners, std::span<const Eigen::Vector3d> vertices,
           std::vector<Eigen::Vector3i>& triangles, int line, std::int64_t face = -1);

 private:
  /// The largest face so far, flattened. It is kept to reuse its memory.
  struct Outline {
    std::vector<Eigen::Vector2d> points;
    std::vector<int> next, previous;
    std::vector<char> turnsBack;  ///< no ear, and may be in the triangle of one
  };

  bool flatten(std::span<const int> corners, std::span<const Eigen::Vector3d> vertices);
  bool isFan() const;
  double turn(int a, int b, int c) const;
  bool isEar(int corner);
  bool isWithoutArea(int corner) const;
  void lookAt(int corner);
  void take(int corner, std::span<const int> corners, std::vector<Eigen::Vector3i>& triangles);
  bool cutEars(std::span<const int> corners, std::vector<Eigen::Vector3i>& triangles);

  const InputSource& source_;
  Outline outline_;
  std::uint64_t looks_ = 0;  ///< at corners, of all faces that are no fans
};

}  // namespace swept::detail
