// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "body.hpp"
#include "path.hpp"
#include "swept/core/continuous/continuous_collide.hpp"

namespace sweeps {

/// How a sweep was made.
enum class Scene : std::uint8_t {
  Grazing,   ///< at t the bodies touch where no other points are farther, and slide
  Crossing,  ///< they do, and go on into each other
  Through,   ///< at t a point of one is at one of the other, anywhere on or in them
  NearMiss,  ///< as Grazing, but they keep a little more than the margin at t
  Apart,     ///< they keep more than margin + tolerance
  Swaying,   ///< they do at 0, 1/2 and 1, and turn and move to and fro between
  Anywhere
};
inline constexpr std::array<std::string_view, 7> kSceneNames{
    "grazing", "crossing", "through", "near miss", "apart", "swaying", "anywhere"};

struct Sweep {
  Scene scene = Scene::Anywhere;
  double size = 1.0;  ///< m, what all of it is in proportion to
  Body a, b;
  Path pathA, pathB;
  swept::ContinuousOptions options;
  double t = 0.0;        ///< when something happens
  double depth = 0.0;    ///< m, how far within the margin at t; negative: outside
  double closing = 0.0;  ///< m per unit of t, along the normal at t
  /// m per unit of t, of straight ways that close at t and are apart before; else 0.
  double speed = 0.0;
  bool mustBeFree = false;

  /// m, of the coordinates that meet: what rounding is relative to.
  double magnitude() const;
  /// A C++ function that asks the query.
  std::string code() const;
};

/// All ordered pairs of kinds in turn.
Sweep makeSweep(std::uint64_t seed, std::uint64_t index);

}  // namespace sweeps
