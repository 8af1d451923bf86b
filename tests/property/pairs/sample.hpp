// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "../../core/error_table_arithmetic.hpp"
#include "../sweeps/body.hpp"

/// Pairs of shapes of all kinds and scales, and what is known about them in 50 digits without
/// asking the library.
namespace pairs {

using error_table::ExactTurn;
using error_table::Point;
using error_table::Real;
using sweeps::Body;
using sweeps::Isometry3d;
using sweeps::Kind;
using sweeps::kKinds;
using sweeps::Matrix3d;
using sweeps::Random;
using sweeps::Vector3d;

/// A point of a body, to 50 digits, and perhaps a direction in which no other point is farther.
struct Spot {
  Point point{};  ///< m
  Vector3d normal = Vector3d::UnitZ();
  bool extreme = false;  ///< up to rounding
};

/// One placement of b beside a.
struct Placing {
  Isometry3d a_from_b = Isometry3d::Identity();
  Spot onA;       ///< in a's frame
  Spot onB;       ///< in b's frame
  Point apart{};  ///< m, from the spot of a to that of b, in a's frame
  Real atMost;    ///< m, the distance of these; so that of the bodies is no larger
  /// m, along the normal of two extreme spots; so the signed distance is no smaller but for
  /// rounding. Else -infinity.
  double atLeast = 0.0;
};

struct Pair {
  Body a, b;
  double sizeA = 0.0, sizeB = 0.0;  ///< m
  /// m. No coordinate of the pair is larger, but for the translation of a placement.
  double magnitude() const { return a.reach + b.reach; }
};

/// The same of an index on every computer, whatever else is drawn. Two of these indices have all
/// pairs of kinds among `kKinds` squared that follow each other.
Pair makePair(std::uint64_t seed, std::uint64_t index, Random& random);
/// Apart by 1e-18 to 10 times the size, or touching, at spots of either body.
Placing place(const Pair& pair, Random& random);

}  // namespace pairs
