// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>

#include "kinematics/joint_path.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"

namespace swept::detail {

/// Consecutive pieces of a curve that lead along a straight motion, from the first one's begin to
/// the last one's end, at any speed but never back. The robot stops nowhere in between, so pieces
/// from one stop of a path to the next are proven as that motion is, whatever comes after it.
struct Chord {
  std::size_t first = 0;
  std::size_t last = 0;    ///< one past the last piece; `first`: there is no such piece
  int leading = 0;         ///< the value that changes most
  double deviation = 0.0;  ///< rad or m, of each value from the straight motion
};

/// The longest chord from a piece on, of at most `most` pieces of degree 2 and more.
///
/// The Bernstein coefficients c of all pieces are a + s (b - a), a and b those at the ends, up to
/// the deviation, and each s is in [0, 1] and no less than the one before. The curve is a convex
/// combination of them, so it has the same form (Farin, section 5.2). s is read off the value that
/// changes most. The deviation is at most 1e-9. Sliding joints are within their limits, too.
/// Cyclic values turn by less than half a turn, orientations of floating joints stay, and there are
/// no moving obstacles.
Chord chordFrom(const KinematicModel& model, const PiecewisePolynomial& curve, std::size_t first,
                std::size_t most);

/// The time (s) at which a chord's curve comes to a share of its straight motion: not later, and
/// earlier by no more than rounding makes of it.
double timeOnChord(const PiecewisePolynomial& curve, const Chord& chord, double share);

/// The straight motion of a chord, t in [0, 1] the share of its length. What the curve deviates is
/// an error of its values (L17 of ERROR_MODEL.md).
class ChordPath final : public JointPath {
 public:
  /// `from` and `to`: the ends. All must outlive this.
  ChordPath(const KinematicModel& model, std::span<const double> from, std::span<const double> to,
            double deviation)
      : model_(model), straight_(model, from, to), deviation_(deviation) {}

  bool linearize(double t, double half, std::span<JointMotion> joints) const override;
  void interpolate(double t, std::span<double> q) const override { straight_.interpolate(t, q); }

 private:
  const KinematicModel& model_;
  const StraightPath straight_;
  const double deviation_;
};

}  // namespace swept::detail
