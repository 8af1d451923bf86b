// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "bvh/any_near.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/sensed_space.hpp"

namespace swept {

namespace {

using Eigen::Vector3d;

/// Squares of the k least distances from one point, the largest on top.
class Nearest {
 public:
  explicit Nearest(std::size_t k) : k_(k) { heap_.reserve(k + 1); }

  void clear() { heap_.clear(); }
  void consider(double squared) {
    if (heap_.size() == k_ && squared >= heap_.front()) return;
    heap_.push_back(squared);
    std::ranges::push_heap(heap_);
    if (heap_.size() <= k_) return;
    std::ranges::pop_heap(heap_);
    heap_.pop_back();
  }
  double farthest() const {
    return heap_.size() < k_ ? std::numeric_limits<double>::infinity() : std::sqrt(heap_.front());
  }

 private:
  std::size_t k_;
  std::vector<double> heap_;
};

}  // namespace

/// Points that are near in the order of the hierarchy are near in space: the k before and after
/// give an upper bound on the distance of the k-th nearest.
std::vector<double> neighborDistances(const PointCloud& cloud, int k) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, k] { return neighborDistances(cloud, k); });
  }
  if (k < 1) {
    throw std::invalid_argument("neighborDistances: k is " + std::to_string(k) +
                                "; allowed: at least 1");
  }
  const std::vector<Vector3d>& points = cloud.points();
  const auto wanted = static_cast<std::size_t>(k);
  std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
  if (points.size() <= wanted) return distances;
  Nearest nearest(wanted);
  for (std::size_t i = 0; i < points.size(); ++i) {
    nearest.clear();
    for (std::size_t j = i < wanted ? 0 : i - wanted; j <= std::min(i + wanted, points.size() - 1);
         ++j) {
      if (j != i) nearest.consider((points[j] - points[i]).squaredNorm());
    }
    const double within = nearest.farthest();
    nearest.clear();
    detail::anyNear(cloud.bvh(), {points[i]}, within, [&](int j) {
      const auto other = static_cast<std::size_t>(j);
      if (other != i) nearest.consider((points[other] - points[i]).squaredNorm());
      return false;
    });
    distances[i] = nearest.farthest();
  }
  return distances;
}

}  // namespace swept
