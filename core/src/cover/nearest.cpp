// SPDX-License-Identifier: BSD-3-Clause
#include "cover/nearest.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "bvh/near_boxes.hpp"
#include "bvh/pending_boxes.hpp"
#include "cover/rounded.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

void consider(const Vector3d& p, const Vector3d& candidate, int primitive, Nearest::Found& best) {
  const double squared = (p - candidate).squaredNorm();
  if (!(squared < best.squared)) return;
  best = {squared, candidate, primitive};
}

double inverseOf(double value) {
  const double inverse = 1.0 / value;
  return std::isfinite(inverse) ? inverse : 0.0;
}

void considerSide(const Vector3d& p, const Vector3d& from, const Vector3d& side, double squared,
                  int primitive, Nearest::Found& best) {
  const double along = std::clamp((p - from).dot(side) * inverseOf(squared), 0.0, 1.0);
  consider(p, from + along * side, primitive, best);
}

void considerTriangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c,
                      int primitive, Nearest::Found& best) {
  constexpr double kSliver = 1e-12;  // square of the sine of the angle at the first corner
  const Vector3d ab = b - a;
  const Vector3d ac = c - a;
  const Vector3d ap = p - a;
  const double abab = ab.squaredNorm();
  const double abac = ab.dot(ac);
  const double acac = ac.squaredNorm();
  const double determinant = abab * acac - abac * abac;
  const double inverse = inverseOf(determinant);
  // For a sliver the sides decide, whatever the inner coordinates say.
  const bool sliver = !(determinant > kSliver * abab * acac) || inverse == 0.0;
  const double height = ap.dot(ab.cross(ac));  // times the length of the normal
  if (!sliver && height * height > best.squared * determinant) return;
  const double onAb = ap.dot(ab);
  const double onAc = ap.dot(ac);
  const double s = (acac * onAb - abac * onAc) * inverse;
  const double t = (abab * onAc - abac * onAb) * inverse;
  if (s >= 0.0 && t >= 0.0 && s + t <= 1.0) {
    consider(p, a + s * ab + t * ac, primitive, best);
    if (!sliver) return;
  }
  considerSide(p, a, ab, abab, primitive, best);
  considerSide(p, a, ac, acac, primitive, best);
  const Vector3d bc = c - b;
  considerSide(p, b, bc, bc.squaredNorm(), primitive, best);
}

}  // namespace

Nearest::Nearest(std::span<const Vector3d> vertices, std::span<const Eigen::Vector3i> triangles,
                 const WideBvh& bvh)
    : vertices_(vertices), triangles_(triangles), bvh_(bvh) {}

Nearest::Nearest(std::span<const Vector3d> points, const WideBvh& bvh)
    : vertices_(points), bvh_(bvh) {}

double Nearest::error(const Vector3d& p) const {
  constexpr double kRelative = 4e-6;
  constexpr double kOffset = 1e-15;
  const Aabb& bounds = bvh_.bounds();
  const double extent = (bounds.upper - bounds.lower).lpNorm<1>();
  const double away = (p - 0.5 * (bounds.lower + bounds.upper)).lpNorm<1>();
  return kRelative * (extent + away) + kOffset * (bvh_.reach() + p.lpNorm<1>());
}

Vector3d Nearest::unitNormal(int primitive) const {
  if (triangles_.empty()) return Vector3d::Zero();
  const Eigen::Vector3i& corners = triangles_[primitive];
  const Vector3d& a = vertices_[corners[0]];
  const Vector3d normal = (vertices_[corners[1]] - a).cross(vertices_[corners[2]] - a);
  const double length = normal.norm();
  if (length > 0.0 && std::isfinite(length)) return normal / length;
  return Vector3d::Zero();
}

void Nearest::test(int primitive, const Vector3d& p, Found& best) const {
  if (triangles_.empty()) return consider(p, vertices_[primitive], primitive, best);
  const Eigen::Vector3i& corners = triangles_[primitive];
  considerTriangle(p, vertices_[corners[0]], vertices_[corners[1]], vertices_[corners[2]],
                   primitive, best);
}

Nearest::Found Nearest::find(const Vector3d& p, double bound) const {
  Found best;
  best.squared = bound * bound;
  PendingBoxes pending;
  WideNode room;
  while (!pending.isEmpty()) {
    const PendingBoxes::Box top = pending.pop();
    if (top.squared > best.squared + kNormalSquare) continue;
    if (top.child < 0) {
      test(~top.child, p, best);
      continue;
    }
    const WideNode& node = bvh_.node(top.child, room);
    alignas(32) std::array<float, WideNode::kLanes> squared;
    for (std::uint32_t near = pointBoxes(node, p, roundedUp(best.squared + kNormalSquare), squared);
         near != 0; near &= near - 1) {
      const int lane = std::countr_zero(near);
      pending.push({squared[lane], node.child[lane]});
    }
  }
  return best;
}

}  // namespace swept::detail
