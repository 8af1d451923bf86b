// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "bvh/box_bounds.hpp"
#include "bvh/wide_bvh.hpp"
#include "mesh/closed_component.hpp"
#include "mesh/ray_crossing.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {

namespace {

/// Well spread directions for any number of rays: Roberts 2018 ("The unreasonable effectiveness of
/// quasirandom sequences"), mapped to the sphere with equal areas.
constexpr int kDirections = 32;
std::array<Eigen::Vector3d, kDirections> spreadDirections() {
  constexpr double kFirstRatio = 0.7548776662466927;  // 1 / g and 1 / g^2, g^3 = g + 1
  constexpr double kSecondRatio = 0.5698402909980532;
  std::array<Eigen::Vector3d, kDirections> directions;
  for (int i = 0; i < kDirections; ++i) {
    double whole = 0.0;
    const double z = 2.0 * std::modf(0.37 + i * kFirstRatio, &whole) - 1.0;
    const double angle = 2.0 * std::numbers::pi * std::modf(0.21 + i * kSecondRatio, &whole);
    const double radial = std::sqrt(1.0 - z * z);
    directions[i] = {radial * std::cos(angle), radial * std::sin(angle), z};
  }
  return directions;
}

/// Signed crossings of one ray with each closed component whose box contains the ray's origin.
/// Their parity is that of the number of crossings.
class CrossingCounts {
 public:
  void add(int component) {
    if (size_ < kInline)
      inline_[size_] = {component, 0};
    else
      more_.push_back({component, 0});
    ++size_;
  }
  bool empty() const { return size_ == 0; }
  void reset() {
    for (Count& count : inlined()) count.crossings = 0;
    for (Count& count : more_) count.crossings = 0;
  }
  /// Null for a component that cannot contain the origin.
  int* find(int component) {
    for (Count& count : inlined()) {
      if (count.component == component) return &count.crossings;
    }
    for (Count& count : more_) {
      if (count.component == component) return &count.crossings;
    }
    return nullptr;
  }
  template <typename Predicate>
  bool any(const Predicate& predicate) const {
    for (int i = 0; i < std::min(size_, kInline); ++i) {
      if (predicate(inline_[i].component, inline_[i].crossings)) return true;
    }
    for (const Count& count : more_) {
      if (predicate(count.component, count.crossings)) return true;
    }
    return false;
  }

 private:
  struct Count {
    int component;
    int crossings;
  };
  static constexpr int kInline = 64;
  std::span<Count> inlined() {
    return std::span(inline_).first(static_cast<std::size_t>(std::min(size_, kInline)));
  }
  std::array<Count, kInline> inline_;
  std::vector<Count> more_;
  int size_ = 0;
};

/// A ray against triangles.
class RayCount {
 public:
  /// `componentOf`: per triangle; empty: all belong to component 0. `scale` is a power of two.
  RayCount(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> triangles,
           const detail::WideBvh& bvh, std::span<const int> componentOf,
           const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, double scale,
           CrossingCounts& counts)
      : vertices_(vertices),
        triangles_(triangles),
        bvh_(bvh),
        componentOf_(componentOf),
        origin_(origin),
        direction_(direction),
        scale_(scale),
        counts_(counts) {}

  /// False when the ray passes within rounding of the border of a triangle that matters.
  bool run() {
    // Each level leaves at most seven siblings to visit.
    std::array<int, (detail::WideNode::kLanes - 1) * detail::WideBvh::kMaxDepth + 1> stack;
    int pending = 0;
    stack[pending++] = 0;
    while (pending > 0) {
      const detail::WideNode& node = bvh_.nodes()[stack[--pending]];
      for (std::uint32_t hits = detail::boxesHit(node, origin_, direction_); hits != 0;
           hits &= hits - 1) {
        const int lane = std::countr_zero(hits);
        if (node.child[lane] >= 0) {
          stack[pending++] = node.child[lane];
        } else if (!count(~node.child[lane])) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  bool count(int triangle) {
    int* const crossings = counts_.find(componentOf_.empty() ? 0 : componentOf_[triangle]);
    if (crossings == nullptr) return true;
    const Eigen::Vector3i& corners = triangles_[triangle];
    Eigen::Vector3d a = vertices_[corners[0]] - origin_;
    Eigen::Vector3d b = vertices_[corners[1]] - origin_;
    Eigen::Vector3d c = vertices_[corners[2]] - origin_;
    if (scale_ != 1.0) {
      a *= scale_;
      b *= scale_;
      c *= scale_;
    }
    switch (detail::rayCrossing(direction_, a, b, c)) {
      case detail::Crossing::Unsure:
        return false;
      case detail::Crossing::Miss:
        break;
      case detail::Crossing::Along:
        ++*crossings;
        break;
      case detail::Crossing::Against:
        --*crossings;
        break;
    }
    return true;
  }

  std::span<const Eigen::Vector3d> vertices_;
  std::span<const Eigen::Vector3i> triangles_;
  const detail::WideBvh& bvh_;
  std::span<const int> componentOf_;
  const Eigen::Vector3d& origin_;
  const Eigen::Vector3d& direction_;
  const double scale_;
  CrossingCounts& counts_;
};

/// Scale that keeps the products of three coordinates of a component of this size (m) within the
/// range of doubles. Without it, no ray is sure, and everything in the box would count as inside.
double scaleFor(double size) {
  if (size > 1e-60 && size < 1e60) return 1.0;
  return size > 0.0 && std::isfinite(size) ? std::ldexp(1.0, std::min(-std::ilogb(size), 1000))
                                           : 1.0;
}

/// Shoots rays until one is sure. `isInside` interprets the crossings of a component.
template <typename Shoot, typename IsInside>
bool anyRayInside(CrossingCounts& counts, const Shoot& shoot, const IsInside& isInside) {
  static const std::array<Eigen::Vector3d, kDirections> directions = spreadDirections();
  for (const Eigen::Vector3d& direction : directions) {
    counts.reset();
    if (shoot(direction)) return counts.any(isInside);
  }
  // Only a point within rounding of a triangle has no sure direction: it touches the solid.
  return true;
}

bool isWithin(int crossings, bool oriented) {
  return oriented ? crossings != 0 : crossings % 2 != 0;
}

}  // namespace

namespace detail {

bool encloses(const ClosedComponent& component, const Eigen::Vector3d& point) {
  if (!component.box.contains(point)) return false;
  CrossingCounts counts;
  counts.add(0);
  const double scale = scaleFor((component.box.upper - component.box.lower).maxCoeff());
  return anyRayInside(
      counts,
      [&](const Eigen::Vector3d& direction) {
        return RayCount(component.vertices, component.triangles, component.bvh, {}, point,
                        direction, scale, counts)
            .run();
      },
      [&](int, int crossings) { return isWithin(crossings, component.oriented); });
}

}  // namespace detail

bool TriangleMesh::encloses(const Eigen::Vector3d& point) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return encloses(point); });
  }
  if (data_->interior == MeshInterior::Surface) return false;
  CrossingCounts counts;
  double size = 0.0;
  for (std::size_t i = 0; i < data_->components.size(); ++i) {
    const Component& component = data_->components[i];
    if ((point.array() >= component.lower.array()).all() &&
        (point.array() <= component.upper.array()).all()) {
      counts.add(static_cast<int>(i));
      size = std::max(size, (component.upper - component.lower).maxCoeff());
    }
  }
  if (counts.empty()) return false;

  const double scale = scaleFor(size);
  return anyRayInside(
      counts,
      [&](const Eigen::Vector3d& direction) {
        return RayCount(vertices(), triangles(), bvh(), data_->componentOf, point, direction, scale,
                        counts)
            .run();
      },
      [&](int component, int crossings) {
        return isWithin(crossings, data_->components[component].oriented);
      });
}

}  // namespace swept
