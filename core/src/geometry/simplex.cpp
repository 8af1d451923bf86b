// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/simplex.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// A face of the simplex (indices of its vertices) with the weights of its point nearest the
/// origin.
struct Nearest {
  std::array<int, 4> index{};
  std::array<double, 4> weight{};
  int size = 0;
  Vector3d point = Vector3d::Zero();
};

Nearest onVertex(int i, const Vector3d& p) {
  return {{i}, {1.0}, 1, p};
}

/// Corrects the foot by its remainder along the edge: near contact the first foot has lost digits
/// to cancellation.
Nearest onSegment(int i, int j, const Vector3d& p, const Vector3d& q) {
  const Vector3d edge = q - p;
  const double length = edge.squaredNorm();
  double t = 0.0;
  Vector3d point = p;
  for (int correction = 0; correction < 2; ++correction) {
    t -= point.dot(edge) / length;
    if (!(t > 0.0)) return onVertex(i, p);
    if (!(t < 1.0)) return onVertex(j, q);
    point = (1.0 - t) * p + t * q;
  }
  return {{i, j}, {1.0 - t, t}, 2, point};
}

Nearest nearer(const Nearest& a, const Nearest& b) {
  return b.point.squaredNorm() < a.point.squaredNorm() ? b : a;
}

/// Two edges of a triangle from a corner opposite to the longest: their cross product has more
/// digits than any other where two corners are near each other and the third is far away.
struct Corner {
  int at = 0;  ///< 0 to 2
  Vector3d e;  ///< m, to the next corner
  Vector3d f;  ///< m, to the one after
};

Corner cornerOf(const std::array<Vector3d, 3>& p) {
  std::array<double, 3> opposite;
  for (int i = 0; i < 3; ++i) opposite[i] = (p[(i + 1) % 3] - p[(i + 2) % 3]).squaredNorm();
  Corner corner;
  for (int i = 1; i < 3; ++i) {
    if (opposite[i] > opposite[corner.at]) corner.at = i;
  }
  corner.e = p[(corner.at + 1) % 3] - p[corner.at];
  corner.f = p[(corner.at + 2) % 3] - p[corner.at];
  return corner;
}

/// The foot on the plane if it is inside, corrected like that of a segment; of size 0 otherwise and
/// where the corners span no plane.
Nearest inTriangle(const std::array<int, 3>& index, const std::array<Vector3d, 3>& p) {
  const Corner corner = cornerOf(p);
  const int i = corner.at;
  const int j = (i + 1) % 3;
  const int k = (i + 2) % 3;
  const Vector3d normal = corner.e.cross(corner.f);
  const double squared = normal.squaredNorm();
  if (!(squared > 0.0)) return {};
  const Vector3d alongE = corner.f.cross(normal) / squared;
  const Vector3d alongF = normal.cross(corner.e) / squared;
  double s = -p[i].dot(alongE);
  double t = -p[i].dot(alongF);
  Vector3d point = p[i] + s * corner.e + t * corner.f;
  s -= point.dot(alongE);
  t -= point.dot(alongF);
  const double r = 1.0 - s - t;
  if (!(r > 0.0 && s > 0.0 && t > 0.0)) return {};
  point = r * p[i] + s * p[j] + t * p[k];
  return {{index[i], index[j], index[k]}, {r, s, t}, 3, point};
}

Nearest onTriangle(const std::array<int, 3>& index, const Vector3d& a, const Vector3d& b,
                   const Vector3d& c) {
  Nearest best = onSegment(index[0], index[1], a, b);
  best = nearer(best, onSegment(index[1], index[2], b, c));
  best = nearer(best, onSegment(index[2], index[0], c, a));
  const Nearest inside = inTriangle(index, {a, b, c});
  return inside.size == 3 ? nearer(best, inside) : best;
}

Vector3d sumOf(const std::array<Vector3d, 4>& p, const std::array<double, 4>& weight) {
  return (weight[0] * p[0] + weight[1] * p[1]) + (weight[2] * p[2] + weight[3] * p[3]);
}

/// The origin's shares, corrected by the error of their sum as long as that helps.
Nearest corrected(Nearest whole, const std::array<Vector3d, 4>& p) {
  constexpr int kCorrections = 3;
  const Vector3d e0 = p[0] - p[3];
  const Vector3d e1 = p[1] - p[3];
  const Vector3d e2 = p[2] - p[3];
  const double volume = e0.dot(e1.cross(e2));
  for (int i = 0; i < kCorrections; ++i) {
    const Vector3d left = whole.point / volume;
    const double d0 = left.dot(e1.cross(e2));
    const double d1 = left.dot(e2.cross(e0));
    const double d2 = left.dot(e0.cross(e1));
    Nearest next = whole;
    next.weight = {whole.weight[0] - d0, whole.weight[1] - d1, whole.weight[2] - d2,
                   whole.weight[3] + (d0 + d1 + d2)};
    next.point = sumOf(p, next.weight);
    const bool shares = std::all_of(next.weight.begin(), next.weight.end(),
                                    [](double weight) { return weight >= 0.0; });
    if (!shares || !(next.point.squaredNorm() < whole.point.squaredNorm())) break;
    whole = next;
  }
  return whole;
}

/// The origin's shares, of size 0 unless it is on the same side of each face as the opposite
/// vertex.
Nearest inTetrahedron(const std::array<Vector3d, 4>& p) {
  static constexpr std::array<std::array<int, 4>, 4> kFaces{
      {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}}};
  Nearest whole{{0, 1, 2, 3}, {}, 4, Vector3d::Zero()};
  double sum = 0.0;
  for (const auto& [i, j, k, opposite] : kFaces) {
    const Corner corner = cornerOf({p[i], p[j], p[k]});
    const Vector3d normal = corner.e.cross(corner.f);
    const double origin = -normal.dot(p[i]);
    const double other = normal.dot(p[opposite] - p[i]);
    if (!((origin > 0.0 && other > 0.0) || (origin < 0.0 && other < 0.0))) return {};
    whole.weight[opposite] = std::abs(origin);
    sum += std::abs(origin);
  }
  for (double& weight : whole.weight) weight /= sum;
  whole.point = sumOf(p, whole.weight);
  return corrected(whole, p);
}

/// Compares the distances of weighted sums, not signs: for a flat tetrahedron the signs are noise.
Nearest onTetrahedron(const std::array<Vector3d, 4>& p) {
  Nearest best = onTriangle({0, 1, 2}, p[0], p[1], p[2]);
  best = nearer(best, onTriangle({0, 1, 3}, p[0], p[1], p[3]));
  best = nearer(best, onTriangle({0, 2, 3}, p[0], p[2], p[3]));
  best = nearer(best, onTriangle({1, 2, 3}, p[1], p[2], p[3]));
  const Nearest whole = inTetrahedron(p);
  return whole.size == 4 ? nearer(best, whole) : best;
}

}  // namespace

void Simplex::add(const Vector3d& a, const Vector3d& b) {
  vertices[size++] = {b - a, a, b, 0.0};
}

bool Simplex::contains(const Vector3d& difference) const {
  return std::any_of(vertices.begin(), vertices.begin() + size,
                     [&](const Vertex& v) { return v.difference == difference; });
}

bool Simplex::hasShares() const {
  return std::all_of(vertices.begin(), vertices.begin() + size,
                     [](const Vertex& v) { return v.weight >= 0.0; });
}

Vector3d Simplex::reduceToNearest() {
  const auto p = [this](int i) -> const Vector3d& { return vertices[i].difference; };
  Nearest nearest;
  switch (size) {
    case 1:
      nearest = onVertex(0, p(0));
      break;
    case 2:
      nearest = onSegment(0, 1, p(0), p(1));
      break;
    case 3:
      nearest = onTriangle({0, 1, 2}, p(0), p(1), p(2));
      break;
    default:
      nearest = onTetrahedron({p(0), p(1), p(2), p(3)});
      break;
  }
  std::array<Vertex, 4> kept;
  for (int i = 0; i < nearest.size; ++i) {
    kept[i] = vertices[nearest.index[i]];
    kept[i].weight = nearest.weight[i];
  }
  vertices = kept;
  size = nearest.size;
  return nearest.point;
}

Vector3d Simplex::nearest() const {
  Vector3d point = Vector3d::Zero();
  for (int i = 0; i < size; ++i) point += vertices[i].weight * vertices[i].difference;
  return point;
}

Vector3d Simplex::pointA() const {
  Vector3d point = Vector3d::Zero();
  for (int i = 0; i < size; ++i) point += vertices[i].weight * vertices[i].a;
  return point;
}

Vector3d Simplex::pointB() const {
  Vector3d point = Vector3d::Zero();
  for (int i = 0; i < size; ++i) point += vertices[i].weight * vertices[i].b;
  return point;
}

}  // namespace swept::detail
