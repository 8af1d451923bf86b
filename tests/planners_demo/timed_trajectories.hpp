// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

/// What files of trajectories say, read without swept's code.
namespace swept::test {

/// A line of a file `time,slide,lift,slide_velocity,lift_velocity`.
struct GantryPoint {
  double time = 0.0;
  std::vector<double> position, velocity;  ///< of slide and lift
};
std::vector<GantryPoint> gantryPoints(const std::string& csv);

/// The cubic between two points that a controller makes, at `time`.
std::vector<double> cubicAt(const GantryPoint& from, const GantryPoint& to, double time);

/// The number behind `duration` in what the program printed, in s; -1: there is none.
double durationIn(const std::string& text);

}  // namespace swept::test
