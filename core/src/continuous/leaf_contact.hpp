// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "continuous/relative_motion.hpp"
#include "continuous/slice_descent.hpp"

namespace swept::detail {

/// The first contact of one pair of leaves by Newton's method on their distance: each step goes to
/// where they touch if they keep their present approach along their normal. A contact that is found
/// is real; proofs must show that it is the first.
class LeafContact {
 public:
  /// Refers to the sides and the motion. `margin`, `accuracy` (of distances): m.
  LeafContact(const Side& a, const Side& b, const RelativeMotion& motion, double margin,
              double accuracy)
      : a_(a), b_(b), motion_(motion), margin_(margin), accuracy_(accuracy) {}

  /// The interval to search, in units of t.
  struct Range {
    double from = 0.0;
    double to = 1.0;
    bool touching = false;    ///< they are known to touch at `to`
    double resolution = 0.0;  ///< how late a contact may be found
    double bend = 0.0;        ///< m per unit of t squared: half the acceleration, at most
  };
  struct Found {
    double t;
    Eigen::Isometry3d world_from_a;  ///< at t
    Eigen::Vector3d pointA;          ///< m, a's frame
    Eigen::Vector3d pointB;          ///< m, a's frame
  };
  /// No value if the leaves do not seem to meet there, or not in a few steps.
  std::optional<Found> find(const OpenPair& pair, const Range& range,
                            ContinuousEffort& effort) const;

 private:
  GjkResult measure(const OpenPair& pair, const RelativeState& state,
                    const Eigen::Vector3d& guess) const;

  const Side& a_;
  const Side& b_;
  const RelativeMotion& motion_;
  double margin_;
  double accuracy_;
};

}  // namespace swept::detail
