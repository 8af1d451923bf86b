// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "kinematics/motion_model.hpp"
#include "model/pair_model.hpp"

namespace swept::detail {

/// An axis-aligned box of the model frame, in single precision, rounded outward.
struct SingleBox {
  std::array<float, 6> sides;  ///< m: lower x, y, z, upper x, y, z

  float lower(std::size_t k) const { return sides[k]; }
  float upper(std::size_t k) const { return sides[k + 3]; }
  void extend(const SingleBox& other);
};

/// A box that many others are compared with.
class BoxProbe {
 public:
  explicit BoxProbe(const SingleBox& box)
      : upper_(box.upper(0), box.upper(1), box.upper(2), std::numeric_limits<float>::infinity()),
        lower_(-std::numeric_limits<float>::infinity(), box.lower(0), box.lower(1), box.lower(2)) {}

  /// Whether they share a point. No side is NaN.
  bool overlaps(const SingleBox& box) const {
    using Four = Eigen::Map<const Eigen::Array4f>;
    return (Four(box.sides.data()) <= upper_).all() && (Four(box.sides.data() + 2) >= lower_).all();
  }

 private:
  Eigen::Array4f upper_, lower_;  ///< with a number that changes nothing
};

/// Holds everything.
SingleBox unboundedBox();
/// Holds nothing.
SingleBox emptyBox();
/// No smaller; unbounded if a number is none, or so large that nothing is proven about it.
SingleBox singleBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper);

/// Boxes of what a robot sweeps in its motions: of each piece of its geometry that the group moves,
/// in each part of a motion. Whatever they do not touch is proven to stay apart from the robot,
/// with the rounding of poses and what the tube of Checker's options allows.
///
/// Lemma. In [m - h, m + h] a point p of a piece stays within h^2 A / 2 of p(m) + s v_p(m), |s| <=
/// h (L3, L4), with v_p = v_c + w x (p - c). p is in a box around c with half sides e along the
/// model frame's axes, and in a ball around b with radius r. So along axis k it leaves p(m) by at
/// most h (|v_c|_k + |w|_i e_j + |w|_j e_i) + h^2 A / 2, and by at most h (|v_b|_k + r |w x n_k|) +
/// h^2 A / 2 where v_b is the ball's.
class MotionBoxes {
 public:
  /// Every motion is divided into so many parts.
  static constexpr std::size_t kParts = 16;
  /// For this checker's robot, group, reference, attached bodies, scales and tube, in any world.
  explicit MotionBoxes(const Checker& checker);

  std::size_t pieces() const { return moving_.size(); }
  /// Of the checker's robot, attached bodies behind: index into PairModel::robotGeometry.
  std::size_t geometryOf(std::size_t piece) const {
    return static_cast<std::size_t>(moving_[piece].geometry);
  }
  /// Multiplied to place a point of any of them, at most.
  double transforms() const { return transforms_; }

  /// Scratch memory.
  struct Scratch {
    std::vector<JointMotion> motion;
    std::vector<CarriedRounding> carried;
    std::vector<BodyState> states;
    std::vector<double> arms;
    std::vector<PointMotionBound> bounds;
  };
  /// Of each piece in each part.
  std::size_t boxes() const { return kParts * pieces(); }
  /// Boxes of a motion, by part, then by piece.
  void find(std::span<const double> from, std::span<const double> to, std::span<SingleBox> boxes,
            Scratch& scratch) const;

 private:
  struct Moving {
    int geometry = 0;
    Eigen::Vector3d boxCenter;  ///< m, shape's frame
    Eigen::Vector3d halfExtents;
    double tube = 0.0;  ///< m
  };
  SingleBox partBox(const Moving& moving, double half, const PointMotionBound& bound,
                    const Scratch& scratch) const;

  PairModel model_;
  std::vector<Moving> moving_;
  double transforms_ = 0.0;
};

}  // namespace swept::detail
