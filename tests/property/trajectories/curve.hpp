// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "stage.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "truth.hpp"

namespace trajectories {

/// How a curve was made.
enum class Kind : std::uint8_t {
  Linear,   ///< controllerCurve() of positions
  Cubic,    ///< and velocities
  Quintic,  ///< and accelerations
  Mixed,    ///< some points have these, some do not
  Pieces,   ///< of Bernstein coefficients, degrees 1 to 7
  Spline    ///< a B-spline, degrees 1 to 7
};
inline constexpr std::array<std::string_view, 6> kKindNames{"linear", "cubic",  "quintic",
                                                            "mixed",  "pieces", "spline"};

struct RandomCurve {
  Kind kind = Kind::Linear;
  swept::PiecewisePolynomial curve;
  Truth truth;
};

/// s. What the longest curve takes, and more.
inline constexpr double kLongest = 1e3;

/// 1 to 40 pieces of 1 ms to 10 s, at up to some 4 rad/s, shortened to take no more than `seconds`
/// together. Most pass a configuration that is near what the tube allows, or near contact. Values
/// that slide stay within their limits.
RandomCurve makeCurve(const Stage& stage, swept::Workspace& workspace,
                      swept::Workspace& plainWorkspace, Random& random, double seconds = kLongest);

}  // namespace trajectories
