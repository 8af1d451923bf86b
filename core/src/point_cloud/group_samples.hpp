// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "point_cloud/noisy_cloud_data.hpp"
#include "point_cloud/pair_groups.hpp"

namespace swept::detail {

/// Samples true positions of a group's points, and counts how often any of its pairs meets.
class GroupSamples {
 public:
  GroupSamples(const NoisyCloudData& a, const NoisyCloudData& b, const Eigen::Isometry3d& a_from_b,
               std::span<const NoisyPair> pairs, std::span<const std::size_t> group);

  void draw(int draws, std::mt19937_64& random);

  int draws() const { return draws_; }
  double probability() const { return draws_ > 0 ? static_cast<double>(met_) / draws_ : 0.0; }
  /// Standard error of probability(); not zero even if all samples agreed.
  double standardError() const;

 private:
  struct Point {
    Eigen::Vector3d mean;    ///< m, a's frame
    Eigen::Matrix3d factor;  ///< m
  };
  struct Meeting {
    std::array<std::size_t, 2> points;
    double radius;  ///< m, sum of both
  };

  std::vector<Point> points_;
  std::vector<Meeting> meetings_;
  std::vector<Eigen::Vector3d> positions_;  ///< m, of the last draw
  std::normal_distribution<double> normal_;
  int draws_ = 0;
  int met_ = 0;
};

}  // namespace swept::detail
