// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "../../core/motion_oracle.hpp"
#include "random.hpp"

namespace sweeps {

using motion_oracle::Placement;
using motion_oracle::Real;

enum class PathKind : std::uint8_t {
  Still,
  Translation,
  Interpolation,
  Screw,
  Turning,
  Bezier,
  Cubic
};
inline constexpr std::array<std::string_view, 7> kPathNames{
    "still", "translation", "interpolation", "screw", "turning", "bezier", "cubic"};
inline constexpr int kPathKinds = static_cast<int>(kPathNames.size());

/// A motion of the library, and by formulas of the tests' own.
struct Path {
  PathKind kind = PathKind::Still;
  Isometry3d start = Isometry3d::Identity(), end = Isometry3d::Identity();
  Vector3d turn = Vector3d::Zero();       ///< rad
  Vector3d move = Vector3d::Zero();       ///< m
  Vector3d reference = Vector3d::Zero();  ///< m
  std::vector<swept::ControlPose> control;

  motion_oracle::Curve curve;  ///< after finish()

  bool uniform() const { return kind < PathKind::Bezier; }
  bool turns() const { return kind > PathKind::Translation; }
  /// Whether a constant velocity can be added without making it of another kind.
  bool drifts() const { return kind != PathKind::Still && kind != PathKind::Screw; }
  /// Shifts and turns all of it so that the body is at `pose` at t.
  void place(const Isometry3d& pose, double t);
  /// Adds a constant velocity (m per unit of t); where the body is at t stays.
  void drift(const Vector3d& velocity, double t);
  /// Fills in what follows from the rest. Nothing may be changed after.
  void finish();

  Isometry3d at(double t) const;
  /// m per unit of t, of a point of the body.
  Vector3d velocity(const Vector3d& local, double t) const;
  std::unique_ptr<swept::Motion> motion() const;
  Path reversed() const;
  Path moved(const Isometry3d& by) const;
  /// m, of the coordinates that meet in it, for points within `reach` of the body's origin.
  double magnitude(double reach) const;
  /// C++ that makes the motion.
  std::string code() const;
};

/// Going about `length` (m); placed nowhere in particular.
Path makePath(PathKind kind, double length, double size, Random& random);

}  // namespace sweeps
