// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/tolerances.hpp"

/// What arithmetic may take from a proof: the constants of this component that stand for roundings,
/// each with the chain of operations that it bounds and the count of these. Those that callers
/// meet, kSupportRounding and kRoundingPerJoint, are in tolerances.hpp. The lemmas that need more
/// than a count are proven in robot_model/src/rounding/ERROR_MODEL.md, or where the comment says.
namespace swept::detail {

/// Unit roundoff: fl(a op b) = (a op b)(1 + d), |d| <= kRoundoff. It is half an epsilon.
inline constexpr double kRoundoff = 0x1p-53;
/// Of single precision.
inline constexpr double kRoundoffSingle = 0x1p-24;

///@{
/// Gaps along a direction: a lower bound of the distance, whatever the direction (L14).

/// Gaps between bounding volumes, of the sum of the absolute values of all numbers in it. A
/// projection takes less than 20 roundings, 2.2e-15; axes or a rotation that are orthonormal up to
/// 1e-14 change it by as much again. 1.6 times what is needed.
inline constexpr double kVolumeRounding = 2.0 * tolerance::kSupportRounding;
/// What a slab may be narrower than the distance that it is to prove: a quarter of what a pair's
/// closed form is allowed.
inline constexpr double kSlab = 0.25 * tolerance::kSupportRounding;
/// Gaps between two boxes of a wide tree in single precision, per metre of sizes and distance: 55,
/// counted in box_frames.cpp. 1.7 times what is needed.
inline constexpr double kBoxRounding = 96.0 * kRoundoffSingle;
/// What stands in double precision before coordinates are relative to a node's origin: a product
/// with a rotation (3 products, 3 sums) and two differences, at both boxes: 16.
inline constexpr double kFrameDifference = 32.0 * kRoundoff;
/// Gaps of two triangles, of the largest coordinate, and of the gap itself: 14 and 5, counted at
/// separationAlong().
inline constexpr double kTriangleGap = 24.0 * kRoundoff;
inline constexpr double kTriangleGapShare = 8.0 * kRoundoff;
/// Gaps of moving triangles in single precision, of the largest coordinate M. Corners are off by 1,
/// and so are their boxes: with a sum 3 along an axis. For a vector n of norm up to 1.001, so
/// 1-norm up to 1.74, n . p is off by 1.74 for the corner and 5.4 for three roundings, the
/// difference of two by twice that and 3.5 more: 18 in all. Whatever n is: where it comes from
/// needs no proof. 1.7 times what is needed.
inline constexpr double kMeetingRounding = 32.0 * kRoundoffSingle;
/// A segment against a triangle or a ball, of the 1-norms of all coordinates: differences 1, dot
/// products with vectors of about unit length 4, sums and the root 4. 14 times what is needed.
inline constexpr double kSegmentRounding = 128.0 * kRoundoff;
/// Distances of boxes: differences 1, squares, sums and root 4. 3 times what is needed.
inline constexpr double kDistanceShrink = 1.0 - 16.0 * kRoundoff;
///@}

///@{
/// Sizes, rounded up.

/// Lengths of fewer than 16 rounded operations on terms that are not negative.
inline constexpr double kLengthUp = 1.0 + 16.0 * kRoundoff;
/// A box in the world, of its centre's terms and its half extents: 4 for the centre, a sum of four
/// products or terms; 10 for the half extents; 1 for the last sum. 2 times what is needed.
inline constexpr double kWorldBoxRounding = 32.0 * kRoundoff;
/// Boxes of a wide tree, of the farthest coordinate: along turned axes two sums of three products
/// and three differences, 14; along the axes of the frame the differences from the origin and from
/// the centre, 2; of the points of a bucket 2.
inline constexpr double kTurnedBoxRounding = 32.0 * kRoundoff;
inline constexpr double kStraightBoxRounding = 8.0 * kRoundoff;
inline constexpr double kBucketRounding = 4.0 * kRoundoff;
///@}

///@{
/// Grids of distances, and which side of a plane a point is on.

/// Of the largest number: L10. A coordinate from the origin is rounded once, W's corners twice, and
/// what follows by at most 12. 2 times what is needed.
inline constexpr double kGridRounding = 32.0 * kRoundoff;
/// A triple product of differences, of the largest differences: six products of three factors with
/// fewer than 8 roundings each, and no coordinate difference above 2: 96.
inline constexpr double kOrientationRounding = 128.0 * kRoundoff;
/// The same of a line past an edge, of its corners' largest coordinates: 48.
inline constexpr double kCrossingRounding = 64.0 * kRoundoff;
/// A point less a combination of three others, of coordinates up to 4: fewer than 20.
inline constexpr double kHullRounding = 128.0 * kRoundoff;
///@}

///@{
/// Curves and first contacts.

/// Control points after de Casteljau's steps, of the largest: 4 for each of at most 3 steps, twice.
/// 37 times what is needed.
inline constexpr double kCurveRounding = 1e-13;
/// Of the size of two moving features, counted in impact.cpp: 17 for a coefficient of their
/// separation, less than 64 for a distance.
inline constexpr double kImpactRounding = 32.0 * kRoundoff;
inline constexpr double kImpactContact = 64.0 * kRoundoff;
/// Relative: the division by a length, 8.
inline constexpr double kImpactShare = 16.0 * kRoundoff;
/// Coefficients of a triple product, of products of the sizes: 100 and the error of the lengths of
/// a cross product. Of these, which has 35.
inline constexpr double kImpactVolume = 256.0 * kRoundoff;
inline constexpr double kImpactArea = 64.0 * kRoundoff;
///@}

}  // namespace swept::detail
