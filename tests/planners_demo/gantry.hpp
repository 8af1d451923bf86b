// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "program.hpp"

/// A robot whose every distance can be computed by hand: a 0.2 m cube that slides along x
/// (`slide`, -0.5 to 2.5 m) and along z (`lift`, 0 to 1 m), and a post, a 0.2 m cube at x = 1 m,
/// z = 0. At (slide, lift) the cube's centre is there.
namespace swept::test {

class Gantry {
  TemporaryFolder folder_;  // first: the files are written into it

 public:
  Gantry();
  /// `command`, the URDF, `more`, and the scene.
  std::vector<std::string> arguments(const std::string& command,
                                     const std::vector<std::string>& more) const;
  Outcome run(const std::string& command, const std::vector<std::string>& more) const;
  /// `plan` in 0.2 s, or else in 2 s or 20 s: a planner that optimizes uses up whatever it is
  /// given, and a slow machine needs more.
  Outcome plan(const std::vector<std::string>& more) const;
  const TemporaryFolder& folder() const { return folder_; }

  /// m, between the cube and the post; 0 when they touch.
  static double distance(double slide, double lift);
  /// m, the least on the segment, found by sampling.
  static double leastDistance(std::span<const double> from, std::span<const double> to);

  std::string urdf, srdf, scene, problems;  ///< files
};

}  // namespace swept::test
