// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/corner_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Weights = std::array<double, 4>;

/// m^2. Shorter vectors are not usable as directions: their squares, and so their lengths,
/// underflow.
constexpr double kLeastSquare = 1e-280;

/// `normal` of any length and either sign, NaN or zero if the caller knows none.
Nearness nearness(const Corners& corners, const Weights& weights, const Vector3d& point,
                  const Vector3d& normal) {
  Nearness result;
  result.weights = weights;
  result.distance = point.norm();
  const double squared = normal.squaredNorm();
  const double side = normal.dot(point) < 0.0 ? -1.0 : 1.0;
  if (squared > kLeastSquare) result.normal = normal * (side / std::sqrt(squared));
  result.heights = corners.heights(result.normal);
  return result;
}

/// The features of a set by the numbers of its corners.
struct Face {
  int origin, first, second;                  ///< the face goes from origin along both edges
  std::span<const std::array<int, 2>> edges;  ///< its sides
  bool parallelogram;                         ///< or a triangle
};

/// The component of y orthogonal to x. x must be the longer one. The second subtraction removes
/// what rounding left along x in the first.
Vector3d across(const Vector3d& y, const Vector3d& x) {
  const double length = x.squaredNorm();
  if (!(length > 0.0)) return y;
  const Vector3d once = y - (y.dot(x) / length) * x;
  return once - (once.dot(x) / length) * x;
}

/// Keeps the nearest point, and separately the direction with the highest lowest corner, among
/// those it receives.
class Best {
 public:
  explicit Best(const Corners& corners) : corners_(corners) {
    result_.distance = std::numeric_limits<double>::infinity();
    lowest_ = -std::numeric_limits<double>::infinity();
  }

  void offerPoint(const Weights& weights) {
    const double distance = corners_.combination(weights).norm();
    if (!(distance < result_.distance)) return;
    result_.distance = distance;
    result_.weights = weights;
  }
  void offerNormal(const Vector3d& direction) {
    const double squared = direction.squaredNorm();
    if (!(squared > kLeastSquare)) return;
    const Vector3d normal = direction * (1.0 / std::sqrt(squared));
    const Weights heights = corners_.heights(normal);
    if (!(lowest(heights) > lowest_)) return;
    lowest_ = lowest(heights);
    result_.normal = normal;
    result_.heights = heights;
  }
  const Nearness& result() const { return result_; }

 private:
  const Corners& corners_;
  Nearness result_;
  double lowest_;
};

void offerEdge(const Corners& corners, int from, int to, Best& best) {
  const Vector3d start = corners.corner(from);
  const Vector3d edge = corners.corner(to) - start;
  const double length = edge.squaredNorm();
  const double along = length > 0.0 ? std::clamp(-start.dot(edge) / length, 0.0, 1.0) : 0.0;
  Weights weights{};
  weights[from] = 1.0 - along;
  weights[to] = along;
  best.offerPoint(weights);
  const Vector3d point = corners.combination(weights);
  best.offerNormal(point);
  best.offerNormal(across(point, edge));
}

/// Built on the longest edge and the height over it, so that a thin face costs no accuracy: the
/// error of `top` is that of the coordinates over the height.
void offerFace(const Corners& corners, const Face& face, Best& best) {
  Vector3d start = corners.corner(face.origin);
  int base = face.first;
  int side = face.second;
  if ((corners.corner(side) - start).squaredNorm() > (corners.corner(base) - start).squaredNorm()) {
    std::swap(base, side);
  }
  const Vector3d along = corners.corner(base) - start;
  const Vector3d rise = across(corners.corner(side) - start, along);
  const Vector3d normal = along.cross(rise);
  best.offerNormal(normal);
  best.offerNormal(-normal);

  const double height = rise.squaredNorm();
  const double length = along.squaredNorm();
  if (!(height > 0.0 && length > 0.0)) return;
  const double top = std::clamp(-start.dot(rise) / height, 0.0, 1.0);
  const Vector3d level = start + top * (corners.corner(side) - start);
  const double most = face.parallelogram ? 1.0 : 1.0 - top;
  const double part = std::clamp(-level.dot(along) / length, 0.0, most);
  Weights weights{};
  weights[face.origin] = 1.0 - top - part;
  weights[side] = top;
  weights[base] = part;
  if (face.parallelogram) {
    // The fourth corner is the sum of the two edges.
    weights = {(1.0 - top) * (1.0 - part), 0.0, 0.0, top * part};
    weights[side] = top * (1.0 - part);
    weights[base] = (1.0 - top) * part;
  }
  best.offerPoint(weights);
}

Nearness nearestOfAll(const Corners& corners, std::span<const Face> faces) {
  Best best(corners);
  for (const Face& face : faces) {
    offerFace(corners, face, best);
    for (const auto& edge : face.edges) offerEdge(corners, edge[0], edge[1], best);
  }
  return best.result();
}

}  // namespace

Nearness VertexFace::nearest(const Corners& corners) {
  const Vector3d a = corners.corner(0);
  const Vector3d b = corners.corner(1);
  const Vector3d c = corners.corner(2);
  const Vector3d e = b - a;
  const Vector3d f = c - a;
  const double d1 = -e.dot(a);
  const double d2 = -f.dot(a);
  if (d1 <= 0.0 && d2 <= 0.0) return nearness(corners, {1.0, 0.0, 0.0, 0.0}, a, a);
  const double d3 = -e.dot(b);
  const double d4 = -f.dot(b);
  if (d3 >= 0.0 && d4 <= d3) return nearness(corners, {0.0, 1.0, 0.0, 0.0}, b, b);
  const double d5 = -e.dot(c);
  const double d6 = -f.dot(c);
  if (d6 >= 0.0 && d5 <= d6) return nearness(corners, {0.0, 0.0, 1.0, 0.0}, c, c);
  const double areaC = d1 * d4 - d3 * d2;
  if (areaC <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    const Vector3d p = a + t * e;
    return nearness(corners, {1.0 - t, t, 0.0, 0.0}, p, p);
  }
  const double areaB = d5 * d2 - d1 * d6;
  if (areaB <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    const Vector3d p = a + t * f;
    return nearness(corners, {1.0 - t, 0.0, t, 0.0}, p, p);
  }
  const double areaA = d3 * d6 - d5 * d4;
  if (areaA <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    const Vector3d p = b + t * (c - b);
    return nearness(corners, {0.0, 1.0 - t, t, 0.0}, p, p);
  }
  const double part = 1.0 / (areaA + areaB + areaC);
  // Rounding may lead here with an area that is not positive: the point must belong to the face.
  const double v = std::clamp(areaB * part, 0.0, 1.0);
  const double w = std::clamp(areaC * part, 0.0, 1.0 - v);
  return nearness(corners, {1.0 - v - w, v, w, 0.0}, a + v * e + w * f, e.cross(f));
}

Nearness EdgeEdge::nearest(const Corners& corners) {
  const Vector3d start = corners.corner(0);
  const Vector3d e = corners.corner(1) - start;
  const Vector3d f = corners.corner(2) - start;
  const double ee = e.squaredNorm();
  const double ef = e.dot(f);
  const double ff = f.squaredNorm();
  const double es = e.dot(start);
  const double fs = f.dot(start);
  // Minimise |start + u e + v f| over both parameters, then clamp one after the other.
  double u = (ef * fs - ff * es) / (ee * ff - ef * ef);
  bool inside = u > 0.0 && u < 1.0;
  u = inside ? u : (u >= 1.0 ? 1.0 : 0.0);
  double v = (-fs - ef * u) / ff;
  if (!(v > 0.0 && v < 1.0)) {
    inside = false;
    v = v >= 1.0 ? 1.0 : 0.0;
    u = (-es - ef * v) / ee;
    u = u > 0.0 ? std::min(u, 1.0) : 0.0;
  }
  const Vector3d p = start + u * e + v * f;
  const Weights weights{(1.0 - u) * (1.0 - v), u * (1.0 - v), (1.0 - u) * v, u * v};
  return nearness(corners, weights, p, inside ? Vector3d(e.cross(f)) : p);
}

Nearness VertexFace::nearestOfAnyShape(const Corners& corners) {
  static constexpr std::array<std::array<int, 2>, 3> kEdges{{{0, 1}, {1, 2}, {2, 0}}};
  // Each corner in turn, one of which is where the shortest edges do not meet.
  const std::array<Face, 3> faces{
      {{0, 1, 2, kEdges, false}, {1, 2, 0, {}, false}, {2, 0, 1, {}, false}}};
  return nearestOfAll(corners, faces);
}

Nearness EdgeEdge::nearestOfAnyShape(const Corners& corners) {
  static constexpr std::array<std::array<int, 2>, 4> kEdges{{{0, 1}, {0, 2}, {1, 3}, {2, 3}}};
  const std::array<Face, 1> faces{{{0, 1, 2, kEdges, true}}};
  return nearestOfAll(corners, faces);
}

}  // namespace swept::detail
