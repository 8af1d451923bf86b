// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What double arithmetic may take from a proof; ROUNDING.md shows that it takes no more.
namespace swept::verify {

/// Relative to the lengths and angles that something is made of, per joint: what cancels rounds as
/// it did before. Rotations may be off by 1.5e-12 (kUnit); all else are some 100 roundings of
/// 1.1e-16. If it were smaller by half, a forged plane could be believed.
constexpr double kRounding = 1e-11;

/// The same of what one link sees of another, which is turned by one more rotation, and by one more
/// link's.
constexpr double kSeenRounding = 4.0 * kRounding;

/// m. More than all that underflows, where no length and no angle is above kLargest.
constexpr double kUnderflow = 1e-100;

/// m or rad. Of what is made of larger numbers nothing is shown: products of some of them stay
/// finite below.
constexpr double kLargest = 1e30;

/// m. Shapes farther away are refused: sums and squares of their coordinates stay finite below.
constexpr double kFarthest = 1e150;

/// How far from 1 lengths of axes and columns of rotations may be.
constexpr double kUnit = 1e-12;

}  // namespace swept::verify
