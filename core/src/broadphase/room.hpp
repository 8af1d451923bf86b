// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "broadphase/float_box.hpp"

namespace swept::detail {

/// How many steps like the last one a room reaches ahead. More means fewer boxes that leave their
/// rooms, and more near boxes to test.
inline constexpr double kStepsAhead = 20.0;
/// In parts of the steps ahead, to all sides: for turns.
inline constexpr double kStepsAside = 1.0 / 16.0;
/// In parts of the box's largest extent: no room grows by more.
inline constexpr double kMostRoom = 0.25;

/// The room of a box that just moved from `before`: it has space for some more such steps, or none
/// if a step is as long as the box is large. Contains the box.
/// `number` spreads the number of steps over half of the range: boxes that start together should
/// not all leave their rooms together.
inline FloatBox roomFor(const Aabb& before, const Aabb& box, std::uint32_t number) {
  double step = 0.0, sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double length = std::max(std::abs(box.lower[k] - before.lower[k]),
                                   std::abs(box.upper[k] - before.upper[k]));
    step = std::max(step, length);
    sum += length;
  }
  const double most = kMostRoom * (box.upper - box.lower).maxCoeff();
  if (!(sum > 0.0) || !(step < most) || !std::isfinite(most)) return floatBox(box);
  const double spread = 0.75 + 0.5 / 16.0 * static_cast<double>((number * 2654435761U) >> 28);
  const double steps = std::min(spread * kStepsAhead, most / step);
  const double aside = kStepsAside * steps * step;
  Aabb room = box;
  for (int k = 0; k < 3; ++k) {
    room.lower[k] -= std::max(steps * (before.lower[k] - box.lower[k]), aside);
    room.upper[k] += std::max(steps * (box.upper[k] - before.upper[k]), aside);
  }
  return floatBox(room);
}

}  // namespace swept::detail
