// SPDX-License-Identifier: BSD-3-Clause
#include "cover/nearest.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swept::detail {
namespace {

using Eigen::Vector3d;

/// Squared distances of a point from the eight boxes of a node.
std::array<float, WideNode::kLanes> boxDistances(const WideNode& node,
                                                 const std::array<float, 3>& p) {
  std::array<float, WideNode::kLanes> squared{};
  for (int axis = 0; axis < 3; ++axis) {
    for (int lane = 0; lane < WideNode::kLanes; ++lane) {
      const float beyond = std::abs(p[axis] - node.center[axis][lane]) - node.half[axis][lane];
      const float gap = beyond > 0.0F ? beyond : 0.0F;
      squared[lane] += gap * gap;
    }
  }
  return squared;
}

void consider(const Vector3d& p, const Vector3d& candidate, int primitive, Nearest::Found& best) {
  const double squared = (p - candidate).squaredNorm();
  if (!(squared < best.squared)) return;
  best = {squared, candidate, primitive};
}

Vector3d onSegment(const Vector3d& from, const Vector3d& along, const Vector3d& p) {
  const double length = along.squaredNorm();
  const double t = length > 0.0 ? std::clamp((p - from).dot(along) / length, 0.0, 1.0) : 0.0;
  return from + t * along;
}

}  // namespace

Nearest::Nearest(std::span<const Vector3d> vertices, std::span<const Eigen::Vector3i> triangles,
                 const WideBvh& bvh)
    : bvh_(bvh) {
  constexpr double kSliver = 1e-12;  // square of sin of the angle at the first corner
  facets_.reserve(triangles.size());
  for (const Eigen::Vector3i& corners : triangles) {
    const Vector3d& a = vertices[corners[0]];
    const Vector3d ab = vertices[corners[1]] - a;
    const Vector3d ac = vertices[corners[2]] - a;
    Facet facet{a,   ab,  ac, Vector3d::Zero(), ab.squaredNorm(), ab.dot(ac), ac.squaredNorm(),
                0.0, true};
    const double determinant = facet.abab * facet.acac - facet.abac * facet.abac;
    facet.inverse = 1.0 / determinant;
    facet.sliver =
        !(determinant > kSliver * facet.abab * facet.acac) || !std::isfinite(facet.inverse);
    if (!std::isfinite(facet.inverse)) facet.inverse = 0.0;
    const Vector3d normal = ab.cross(ac);
    const double length = normal.norm();
    if (length > 0.0 && std::isfinite(length)) facet.normal = normal / length;
    facets_.push_back(facet);
  }
}

Nearest::Nearest(std::span<const Vector3d> points, const WideBvh& bvh)
    : points_(points), bvh_(bvh) {}

double Nearest::error(const Vector3d& p) const {
  constexpr double kRelative = 4e-6;
  return kRelative * (bvh_.reach() + (p - bvh_.origin()).lpNorm<1>());
}

Vector3d Nearest::unitNormal(int primitive) const {
  return facets_.empty() ? Vector3d(Vector3d::Zero()) : facets_[primitive].normal;
}

void Nearest::test(int primitive, const Vector3d& p, Found& best) const {
  if (facets_.empty()) return consider(p, points_[primitive], primitive, best);
  const Facet& facet = facets_[primitive];
  const Vector3d ap = p - facet.a;
  const double height = ap.dot(facet.normal);
  if (!facet.sliver && height * height > best.squared) return;
  const double onAb = ap.dot(facet.ab);
  const double onAc = ap.dot(facet.ac);
  const double s = (facet.acac * onAb - facet.abac * onAc) * facet.inverse;
  const double t = (facet.abab * onAc - facet.abac * onAb) * facet.inverse;
  if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) {
    consider(p, facet.a + s * facet.ab + t * facet.ac, primitive, best);
    if (!facet.sliver) return;
  }
  consider(p, onSegment(facet.a, facet.ab, p), primitive, best);
  consider(p, onSegment(facet.a, facet.ac, p), primitive, best);
  consider(p, onSegment(facet.a + facet.ab, facet.ac - facet.ab, p), primitive, best);
}

Nearest::Found Nearest::find(const Vector3d& p, double bound) const {
  Found best;
  best.squared = bound * bound;
  const Vector3d relative = p - bvh_.origin();
  const std::array<float, 3> single{static_cast<float>(relative.x()),
                                    static_cast<float>(relative.y()),
                                    static_cast<float>(relative.z())};
  struct Pending {
    float squared;
    int node;
  };
  // Each level leaves at most seven siblings behind.
  std::array<Pending, (WideNode::kLanes - 1) * WideBvh::kMaxDepth + 1> stack;
  int pending = 0;
  stack[pending++] = {0.0F, 0};
  while (pending > 0) {
    const Pending top = stack[--pending];
    if (top.squared > best.squared) continue;
    const WideNode& node = bvh_.nodes()[top.node];
    const auto squared = boxDistances(node, single);
    const int first = pending;
    for (int lane = 0; lane < node.count; ++lane) {
      if (squared[lane] > best.squared) continue;
      if (node.child[lane] < 0) {
        test(~node.child[lane], p, best);
        continue;
      }
      // Nearest on top.
      int at = pending++;
      for (; at > first && stack[at - 1].squared < squared[lane]; --at) stack[at] = stack[at - 1];
      stack[at] = {squared[lane], node.child[lane]};
    }
  }
  return best;
}

}  // namespace swept::detail
