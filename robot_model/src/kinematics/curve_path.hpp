// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "kinematics/joint_path.hpp"
#include "rounding/error_model.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"

namespace swept::detail {

/// Consecutive pieces of a curve.
struct CurveRun {
  std::size_t first = 0;
  std::size_t last = 0;  ///< one past the last piece
  /// One piece, along which all joints move as StraightPath has them.
  bool straight = false;
};

/// One value of a piece: its Taylor coefficients about the piece's middle, by the share of its
/// duration since then, and bounds over all of it.
struct CurveValue {
  std::array<double, PiecewisePolynomial::kMaxDegree + 1> terms;
  CurveRounding rounding;
  double low = 0.0;
  double high = 0.0;
  double speed = 0.0;         ///< per s
  double acceleration = 0.0;  ///< per s^2
};

/// Room for the data of one run.
struct CurveScratch {
  std::vector<double> joins;       ///< rad or m, per value: see runFrom()
  std::vector<CurveValue> values;  ///< of the first piece, then of the next one
};

/// The longest run from a piece on, at most `most` pieces: their values and rates join at the
/// knots, up to rounding, and no chord (chordFrom()) begins after the first piece. `joins` becomes
/// how far each value is off a curve that is continuously differentiable.
CurveRun runFrom(const KinematicModel& model, const PiecewisePolynomial& curve, std::size_t first,
                 std::size_t most, CurveScratch& scratch);

/// A run of a curve's pieces, t in [0, 1] from its first knot to its last. The time of moving
/// obstacles goes with it.
///
/// On a part [m - w, m + w] of a piece, with the Taylor coefficients T_k at m, a value is within
/// the sum of |T_k| w^k, k > 0, of T_0; its rate and acceleration are bounded in the same way. Over
/// several pieces the bounds are those of the parts together. The bound on the acceleration has
/// what the rate at m is off: it holds for the interval that linearize() was asked about, not for a
/// shorter one. L17 of ERROR_MODEL.md has the roundings.
class CurvePath final : public JointPath {
 public:
  /// `clock`: s, the obstacles' time at the curve's time 0. `scratch` has the `joins` of the run.
  /// All must outlive this.
  CurvePath(const KinematicModel& model, const PiecewisePolynomial& curve, const CurveRun& run,
            double clock, CurveScratch& scratch);

  bool linearize(double t, double half, std::span<JointMotion> joints) const override;
  void interpolate(double t, std::span<double> q) const override;

 private:
  /// An interval of time, and the pieces that it meets.
  struct Window {
    double middle = 0.0;  ///< s
    double half = 0.0;    ///< s
    std::size_t first = 0;
    std::size_t last = 0;  ///< the last one itself
    std::size_t center = 0;
  };
  /// One value over a window.
  struct ValueMotion {
    double value = 0.0;  ///< at the middle
    double rate = 0.0;   ///< per s, likewise
    double low = 0.0;    ///< over the window, as all that follows
    double high = 0.0;
    double speed = 0.0;         ///< per s
    double acceleration = 0.0;  ///< per s^2
    double error = 0.0;         ///< what rounding takes of the values
  };

  const CurveValue& valueOf(std::size_t piece, int variable) const {
    return scratch_.values[(piece - run_.first) * static_cast<std::size_t>(curve_.dimension()) +
                           static_cast<std::size_t>(variable)];
  }
  /// One piece of degree 1: orientations follow slerp.
  bool isLine() const { return run_.last - run_.first == 1 && curve_.degree(run_.first) == 1; }
  std::span<const double> endOfLine(Eigen::Index end) const {
    return {curve_.coefficients(run_.first).col(end).data(),
            static_cast<std::size_t>(curve_.dimension())};
  }
  void compileValues(CurveScratch& scratch) const;
  Window windowOf(double t, double half) const;
  ValueMotion around(int variable, const Window& window) const;
  void turn(const ValueMotion& own, double multiplier, double offset, const Eigen::Vector3d& axis,
            JointMotion& joint) const;
  void slide(const MovingBody& body, const ValueMotion& own, JointMotion& joint) const;
  void slideFreely(const MovingBody& body, const Window& window, JointMotion& joint) const;
  bool staysWithin(const MovingBody& body) const;

  const KinematicModel& model_;
  const PiecewisePolynomial& curve_;
  const CurveRun run_;
  const double begin_;      ///< s
  const double width_;      ///< s
  const double clock_;      ///< s
  const double timeError_;  ///< s
  const CurveScratch& scratch_;
  bool slidesWithin_ = true;
};

}  // namespace swept::detail
