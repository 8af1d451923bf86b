// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>

/// What arithmetic may take from a proof: every constant of this component that stands for
/// roundings, with the chain of operations that it bounds and the count of these. ERROR_MODEL.md
/// proves the lemmas (L1, L2, ...) and has the factors by which the constants are larger than the
/// largest errors that tests/robot_model/error_model_test.cpp finds in 50 digits. Those of poses
/// and supports in double precision, which core shares, are in swept/core/tolerances.hpp.
///
/// Counts are of kSingle, or of kDouble where that is said. Names that end in Outward multiply a
/// bound.
namespace swept::detail {

/// Unit roundoff of single precision: fl(a op b) = (a op b)(1 + d), |d| <= kSingle.
inline constexpr double kSingle = 0x1p-24;
/// Of double precision.
inline constexpr double kDouble = 0x1p-53;

///@{
/// Frames in single precision: L6 and L7.

/// rad. Sines and cosines are computed for angles up to this, and off by at most kSineError.
inline constexpr double kLargestTurn = 100.0;
/// 4 kSingle: the angle less whole quarter turns is off by 1, the series by 1, their evaluation by
/// 2.
inline constexpr double kSineError = 0x1p-22;

/// Per joint, relative to the reach. L6 counts at most 24.4 for a place: 16.7 for the rotation
/// (1.8 for the entries of the fixed rotation, 5.9 for the product with it, 5.7 for sine and
/// cosine, 3.4 for the products with these) and 7.7 for the origin (4.7 for the offset, 3 for the
/// sums). L7 counts 29.0 for a velocity, per rad of all spins.
inline constexpr double kFrameRoundings = 32.0;
/// So many joints more, 128 kSingle. Less than 10 of these are for the ball's own centre, 8 for
/// the third product of a floating joint, 22 for the sums of a velocity. At least 88 are left for
/// what the walks compute of a place: L9 needs 22 and L11 20.
inline constexpr double kFrameSpare = 4.0;
/// rad. An angle of so much rounds as one joint does: by 4 kSingle per rad, where three roundings
/// of it count (its begin, its rate, their sum).
inline constexpr double kAngleOfFrame = 8.0;
/// Per m that is slid: 7 for a value (its begin 1; its way, up to twice as long, 4; the sums 2),
/// and kObstacleRoundings, as points are so much farther from the obstacles' frames.
inline constexpr double kSlideRoundings = 64.0;

/// Relative to the reach, of a robot with so many joints on its longest path.
inline double frameRounding(std::size_t joints) {
  return kFrameRoundings * kSingle * (static_cast<double>(joints) + kFrameSpare);
}

/// What the errors of one motion depend on.
struct MotionExtent {
  double reach = 0.0;         ///< m, with what is slid
  double largestAngle = 0.0;  ///< rad
  double spins = 0.0;         ///< rad per unit t, of all joints
  double speeds = 0.0;        ///< m per unit t, of all joints
  double slid = 0.0;          ///< m, of all joints
  double slideError = 0.0;    ///< m, of values that are much smaller than what they are made of
};

/// m. L7: where a ball's centre is, and half the way that it goes in a sub-interval, are together
/// off by no more. Half a sub-interval is at most 1/2. `relative`: frameRounding().
inline double motionRounding(double relative, const MotionExtent& extent) {
  return relative * (1.0 + extent.largestAngle / kAngleOfFrame) *
             (extent.reach * (1.0 + 0.5 * extent.spins) + 0.5 * extent.speeds) +
         kSlideRoundings * kSingle * extent.slid + extent.slideError;
}
///@}

///@{
/// Distances in single precision: L8 to L11.

/// Of |x| + |d|, for a coordinate a . x + d in a frame of an obstacle, or what a kernel makes of
/// such. L8 counts 7 for a coordinate and at most 28, for the side of a cone.
inline constexpr double kObstacleRoundings = 32.0;
/// Of a plane's offset besides: its rounding to single precision, and that of the difference.
inline constexpr double kOffsetRoundings = 2.0;
/// Of the reach, the grid and its largest value: L10 counts 14 for the middle of a cell, its
/// distance and value, and the distance from the box around the set.
inline constexpr double kFieldRoundings = 64.0;

/// m. Obstacles are made larger by this.
inline double obstacleRounding(double reach, double magnitude) {
  return kObstacleRoundings * kSingle * (reach + magnitude);
}
/// m. What is taken off a distance that is read from a field: a point is off by less than twice
/// its coordinates. `coordinates`: obstacleRounding(); `size`: m, reach, grid and largest value.
inline double fieldRounding(double coordinates, double size) {
  return 2.0 * coordinates + kFieldRoundings * kSingle * size;
}

/// Radii of balls against obstacles; 33 kSingle. Squares, their sum and roots take 5 kSingle of a
/// distance, and the square of the radius 2.
inline constexpr float kBallOutward = 1.0F + 2e-6F;
/// Sums of two radii and what has to be kept; 67 kSingle, of which 12 are used.
inline constexpr float kPairOutward = 1.0F + 4e-6F;
/// Sums of margins; 16 kSingle, of which 5 are used.
inline constexpr float kMarginOutward = 1.0F + 1e-6F;
/// What one pair keeps more than others, and radii of hulls; 167 kSingle. For less than 10: these
/// are lengths that nothing is gained from knowing better.
inline constexpr float kExtraOutward = 1.0F + 1e-5F;
/// Lengths of segments and parts of such; 16 kSingle, of which 6 are used.
inline constexpr float kLengthOutward = 1.0F + 1e-6F;
/// Radius of a ball around others, computed in double precision; 16 kSingle for one rounding.
inline constexpr float kRootOutward = 1.000001F;
/// The robot's reach; 167 kSingle for two roundings.
inline constexpr float kReachOutward = 1.00001F;
/// Of an obstacle's numbers, for its support (L11): 10 kSingle for boxes, where this is 16; 21 for
/// round ones, where twice this is.
inline constexpr float kSupportShare = 1e-6F;

/// Of the square of a distance within which balls meet: beyond, its roundings may count. No proof
/// rests on it, for exact geometry has the last word on contacts.
inline constexpr float kMeeting = 1.0F - 1e-5F;
///@}

///@{
/// Bounds on motions in single precision: L5.

/// Makes a double no smaller when it is rounded to single precision.
inline constexpr double kSingleOutward = 1.0 + 2.0 * kSingle;
/// Each step of a bound on spins and accelerations; 67 kSingle, of which 5 are used.
inline constexpr float kBoundOutward = 1.0F + 4e-6F;
/// And per term of a sum, 4 kSingle: a term adds at most 2 roundings to those before it.
inline constexpr float kBoundPerTerm = 0x1p-22F;
/// Arms and shares of them, from double to single precision; 16 kSingle, of which 1 is used.
inline constexpr double kArmOutward = 1.0 + 1e-6;
/// Cosines of angles between axes, likewise.
inline constexpr double kCosineError = 1e-6;
/// h^2 A / 2 as h h (A kHalfOutward): 33 kSingle, of which 3 are used.
inline constexpr float kHalfOutward = 0.5F + 1e-6F;
///@}

///@{
/// Joint tables: L12.

/// rad. A value in single precision and the part of a cell that it is found in. For values and
/// ways of up to 32 rad there are 3.6e-5: 1.1e-5 for the value, 0.8e-5 for half the way, 0.2e-5
/// for what a tube adds, 1.1e-5 for the index, 0.4e-5 for the ends of the range.
inline constexpr double kTableValueError = 4e-5;
/// rad. The widest range of a table.
inline constexpr double kTableWidest = 32.0;
/// Of the reach: centres of balls, rounded to single precision, of both bodies; 168 kSingle, of
/// which 4 are used, and the poses in double precision.
inline constexpr double kTableShare = 1e-5;
/// Of the coordinates of a ball that is found inside a link, and of its depth; 16 kSingle, of which
/// 2 are used.
inline constexpr double kInnerBallShare = 1e-6;
///@}

///@{
/// Kinematics in double precision: L5, L13, L15. What a place rounds by per joint is
/// tolerance::kRoundingPerJoint.

/// A joint's value, its way to another one and the sum of both: 4 kDouble of what they are made of.
inline constexpr double kValueRounding = 8.0 * kDouble;
/// rad. Angles up to this are part of what kRoundingPerJoint allows for, larger ones round by
/// kValueRounding besides; and what slides, up to so many times what it is off zero.
inline constexpr double kOrdinary = 10.0;
/// Bounds that are sums and products of a few positive numbers per joint, such as arms, spins and
/// accelerations: 9000 kDouble, for some 10 in each of as many joints as there are.
inline constexpr double kArithmeticOutward = 1.0 + 1e-12;
/// The same of sums over all joints of a path, in which differences are bounded by
/// kNestedRoundings per joint: 8 kDouble, of which 5 are used.
inline constexpr double kNestedOutward = 1.0 + 1e-11;
inline constexpr double kNestedRoundings = 8.0 * kDouble;
/// Relative, of bounds on travel: 9000 kDouble, of which 10 are used.
inline constexpr double kVelocityRounding = 1e-12;
/// Velocities at the middle of an interval, relative to these bounds: per transform as much as a
/// place, which L13 counts to 0.9e-14.
inline double velocityRounding(double transforms) {
  return std::max(kVelocityRounding, 1e-14 * (transforms + 2.0));
}
/// Of directions: what is left across an axis of a direction along it, 10 kDouble.
inline constexpr double kParallelShare = 1e-14;
/// Of t in [0, 1] on a part of a path: its begin, its width and their sum, 8 kDouble.
inline constexpr double kTimeRounding = 8.0 * kDouble;
/// Of a polynomial's largest coefficient, for each degree and times 3^degree: L17 counts at most
/// (6 degree + 4) 2^degree kDouble for a value.
inline constexpr double kCurveRoundings = 8.0 * kDouble;
/// Bounds on what a box of joint values does to a chain (chain_bounds.hpp): up to a million
/// roundings.
inline constexpr double kChainOutward = 1.0 + 1e-9;
/// What rounding takes of a polynomial's Taylor coefficients, together, over the whole piece.
struct CurveRounding {
  double value = 0.0;         ///< rad or m
  double rate = 0.0;          ///< by the share of the piece's duration
  double acceleration = 0.0;  ///< likewise
};
/// L17. `largest`: of the coefficients.
inline CurveRounding curveRounding(std::size_t degree, double largest) {
  const auto d = static_cast<double>(degree);
  double power = 1.0;  // 3^d
  for (std::size_t k = 0; k < degree; ++k) power *= 3.0;
  const double value = kCurveRoundings * d * power * largest;
  return {value, value * d, value * d * (d - 1.0)};
}
/// Times on a common clock that differ by less are one: of the largest. Each is a product and a sum,
/// 3 kDouble (L19).
inline constexpr double kSameTime = 64.0 * kDouble;
/// Of a value, and of what it moves by in all of the clock's time: L19 counts 105 and 131 kDouble.
inline constexpr double kCombinedRoundings = 256.0 * kDouble;
/// rad or m. What a curve on a common clock may be off by. `value`, `rate` (per s): its largest;
/// `end`: s, of the clock.
inline double combinedRounding(double value, double rate, double end) {
  return kCombinedRoundings * (value + rate * end);
}
/// Half the width of a range, from its middle: 3 kDouble.
inline constexpr double kHalfRangeOutward = 1.0 + 1e-15;
/// Boxes around pieces of the world, of the largest coordinate: a product with a rotation and a
/// sum, 5 kDouble.
inline constexpr double kWorldBoxShare = 1e-12;
/// Points that stand for cubes of a map, of their coordinates: 2 kDouble.
inline constexpr double kPointShare = 1e-15;
///@}

///@{
/// Coordinates that came in single precision.

/// Of the linear part of a node's transform in a mesh file, of its Frobenius norm: a unit quaternion
/// and a scale as one matrix, in some 30 roundings of each entry, of the length of its column.
inline constexpr double kNodeRoundings = 64.0;
/// Of a number of such a file: a node's offset, or a linear part that is the identity.
inline constexpr double kNumberRoundings = 4.0;
///@}

}  // namespace swept::detail
