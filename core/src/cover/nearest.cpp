// SPDX-License-Identifier: BSD-3-Clause
#include "cover/nearest.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swept::detail {
namespace {

using Eigen::Vector3d;

/// Squared distances of a point from the eight boxes of a node.
std::array<float, WideNode::kLanes> boxDistances(const WideNode& node, const Vector3d& p) {
  std::array<WideNode::Row, 3> offset;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<float>(p[i] - node.origin[i]);
    for (int lane = 0; lane < WideNode::kLanes; ++lane) offset[i][lane] = at - node.center[i][lane];
  }
  std::array<float, WideNode::kLanes> squared{};
  for (int j = 0; j < 3; ++j) {
    const std::array<WideNode::Row, 3>& axis = node.axes[j];
    for (int lane = 0; lane < WideNode::kLanes; ++lane) {
      const float along = axis[0][lane] * offset[0][lane] + axis[1][lane] * offset[1][lane] +
                          axis[2][lane] * offset[2][lane];
      const float beyond = std::abs(along) - node.half[j][lane];
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

double inverseOf(double value) {
  const double inverse = 1.0 / value;
  return std::isfinite(inverse) ? inverse : 0.0;
}

}  // namespace

Nearest::Nearest(std::span<const Vector3d> vertices, std::span<const Eigen::Vector3i> triangles,
                 const WideBvh& bvh)
    : bvh_(bvh) {
  facets_.reserve(triangles.size());
  for (const Eigen::Vector3i& corners : triangles) {
    facets_.push_back(facetOf(vertices[corners[0]], vertices[corners[1]], vertices[corners[2]]));
  }
}

Nearest::Facet Nearest::facetOf(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  constexpr double kSliver = 1e-12;  // square of the sine of the angle at the first corner
  const auto side = [](const Vector3d& from, const Vector3d& to) {
    const Vector3d along = to - from;
    return Facet::Side{from, along, inverseOf(along.squaredNorm())};
  };
  Facet facet{{side(a, b), side(a, c), side(b, c)}, Vector3d::Zero(), 0.0, 0.0, 0.0, 0.0, true};
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  facet.abab = ab.squaredNorm();
  facet.abac = ab.dot(ac);
  facet.acac = ac.squaredNorm();
  const double determinant = facet.abab * facet.acac - facet.abac * facet.abac;
  facet.inverse = inverseOf(determinant);
  facet.sliver = !(determinant > kSliver * facet.abab * facet.acac) || facet.inverse == 0.0;
  const Vector3d normal = ab.cross(ac);
  const double length = normal.norm();
  if (length > 0.0 && std::isfinite(length)) facet.normal = normal / length;
  return facet;
}

Nearest::Nearest(std::span<const Vector3d> points, const WideBvh& bvh)
    : points_(points), bvh_(bvh) {}

double Nearest::error(const Vector3d& p) const {
  constexpr double kRelative = 4e-6;
  constexpr double kOffset = 1e-15;
  const Aabb& bounds = bvh_.bounds();
  const double extent = (bounds.upper - bounds.lower).lpNorm<1>();
  const double away = (p - 0.5 * (bounds.lower + bounds.upper)).lpNorm<1>();
  return kRelative * (extent + away) + kOffset * (bvh_.reach() + p.lpNorm<1>());
}

Vector3d Nearest::unitNormal(int primitive) const {
  return facets_.empty() ? Vector3d(Vector3d::Zero()) : facets_[primitive].normal;
}

void Nearest::test(int primitive, const Vector3d& p, Found& best) const {
  if (facets_.empty()) return consider(p, points_[primitive], primitive, best);
  const Facet& facet = facets_[primitive];
  const Facet::Side& ab = facet.sides[0];
  const Facet::Side& ac = facet.sides[1];
  const Vector3d ap = p - ab.from;
  const double height = ap.dot(facet.normal);
  if (!facet.sliver && height * height > best.squared) return;
  const double onAb = ap.dot(ab.along);
  const double onAc = ap.dot(ac.along);
  const double s = (facet.acac * onAb - facet.abac * onAc) * facet.inverse;
  const double t = (facet.abab * onAc - facet.abac * onAb) * facet.inverse;
  if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) {
    consider(p, ab.from + s * ab.along + t * ac.along, primitive, best);
    if (!facet.sliver) return;
  }
  for (const Facet::Side& side : facet.sides) {
    const double along = std::clamp((p - side.from).dot(side.along) * side.inverse, 0.0, 1.0);
    consider(p, side.from + along * side.along, primitive, best);
  }
}

Nearest::Found Nearest::find(const Vector3d& p, double bound) const {
  Found best;
  best.squared = bound * bound;
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
    const auto squared = boxDistances(node, p);
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
