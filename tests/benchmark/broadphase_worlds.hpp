// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "swept/core/bv/aabb.hpp"

/// Boxes that move, one step at a time.
namespace swept::benchmark {

class BoxWorld {
 public:
  virtual ~BoxWorld() = default;
  virtual void step() = 0;

  const std::vector<Aabb>& boxes() const { return boxes_; }
  /// The same ones in every step, in ascending order.
  const std::vector<std::uint32_t>& moving() const { return moving_; }
  double side() const { return side_; }  ///< m

 protected:
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> moving_;
  double side_ = 0.0;  ///< m
};

enum class BoxMotion { Coherent, Teleporting, Folding };

/// At one box per cubic metre however many there are.
class MovingBoxes : public BoxWorld {
 public:
  /// m. Centres are multiples of this and half extents lie a quarter above such, so that the sums
  /// and single-precision copies that the libraries make of them are exact, and no boxes touch
  /// without overlapping: FCL's sweep does not always count these.
  static constexpr double kQuantum = 0x1p-12;
  static constexpr double kLongestStep = 0.01;  ///< m, along an axis; boxes measure 0.25 to 1 m

  MovingBoxes(std::size_t count, double movingShare, BoxMotion motion, std::uint64_t seed)
      : motion_(motion), random_(seed) {
    side_ = std::cbrt(static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i) {
      half_.push_back(vector(0.125, 0.5).array() + 0.25 * kQuantum);
      center_.push_back(vector(0.0, side_));
      boxes_.push_back(box(i));
    }
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::shuffle(order.begin(), order.end(), random_);
    order.resize(static_cast<std::size_t>(std::lround(movingShare * static_cast<double>(count))));
    std::sort(order.begin(), order.end());
    moving_ = std::move(order);
    for (std::size_t i = 0; i < moving_.size(); ++i)
      velocity_.push_back(vector(-kLongestStep, kLongestStep));
  }

  void step() override {
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      Eigen::Vector3d& center = center_[moving_[i]];
      if (motion_ == BoxMotion::Teleporting)
        center = vector(0.0, side_);
      else
        center += velocity_[i];
      for (int k = 0; k < 3; ++k)
        if (center[k] < 0.0 || center[k] > side_) velocity_[i][k] = -velocity_[i][k];
      boxes_[moving_[i]] = box(moving_[i]);
    }
  }

 private:
  Eigen::Vector3d vector(double low, double high) {
    std::uniform_real_distribution<double> uniform(low, high);
    Eigen::Vector3d v;
    for (int k = 0; k < 3; ++k) v[k] = kQuantum * std::round(uniform(random_) / kQuantum);
    return v;
  }
  Aabb box(std::size_t i) const { return {center_[i] - half_[i], center_[i] + half_[i]}; }

  BoxMotion motion_;
  std::mt19937_64 random_;
  std::vector<Eigen::Vector3d> half_, center_, velocity_;
};

/// One library's way to follow the boxes and to enumerate all pairs that overlap.
class BroadphasePeer {
 public:
  virtual ~BroadphasePeer() = default;
  /// Not timed: what a library wants of its own objects before it is told that they moved.
  virtual void prepare(const BoxWorld&) {}
  /// Timed: follow the boxes that moved, then visit every pair. Returns how many there are.
  virtual std::size_t step(const BoxWorld& boxes) = 0;
};

}  // namespace swept::benchmark
