// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/simplex.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

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

Nearest onSegment(int i, int j, const Vector3d& p, const Vector3d& q) {
  const Vector3d edge = q - p;
  const double along = -p.dot(edge);
  const double length = edge.squaredNorm();
  if (!(along > 0.0)) return onVertex(i, p);
  if (!(along < length)) return onVertex(j, q);
  const double t = along / length;
  return {{i, j}, {1.0 - t, t}, 2, p + t * edge};
}

Nearest nearer(const Nearest& a, const Nearest& b) {
  return b.point.squaredNorm() < a.point.squaredNorm() ? b : a;
}

/// Inside test by the signs of the three sub-areas along the face normal; a face with no usable
/// normal is as good as its edges.
Nearest onTriangle(const std::array<int, 3>& index, const Vector3d& a, const Vector3d& b,
                   const Vector3d& c) {
  const Vector3d normal = (b - a).cross(c - a);
  const double areaA = normal.dot(b.cross(c));
  const double areaB = normal.dot(c.cross(a));
  const double areaC = normal.dot(a.cross(b));
  const double sum = areaA + areaB + areaC;
  if (areaA > 0.0 && areaB > 0.0 && areaC > 0.0 && sum > 0.0) {
    const double wa = areaA / sum;
    const double wb = areaB / sum;
    const double wc = areaC / sum;
    return {{index[0], index[1], index[2]}, {wa, wb, wc}, 3, wa * a + wb * b + wc * c};
  }
  Nearest best = onSegment(index[0], index[1], a, b);
  best = nearer(best, onSegment(index[1], index[2], b, c));
  return nearer(best, onSegment(index[2], index[0], c, a));
}

/// The origin is inside when it is on the same side of each face as the opposite vertex.
Nearest onTetrahedron(const std::array<Vector3d, 4>& p) {
  static constexpr std::array<std::array<int, 4>, 4> kFaces{
      {{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}}};
  bool inside = true;
  Nearest best;
  double least = std::numeric_limits<double>::infinity();
  std::array<double, 4> volume{};
  for (const auto& [i, j, k, opposite] : kFaces) {
    const Vector3d normal = (p[j] - p[i]).cross(p[k] - p[i]);
    const double origin = -normal.dot(p[i]);
    const double other = normal.dot(p[opposite] - p[i]);
    const bool sameSide = (origin > 0.0 && other > 0.0) || (origin < 0.0 && other < 0.0);
    volume[opposite] = std::abs(origin);
    if (sameSide) continue;
    inside = false;
    const Nearest face = onTriangle({i, j, k}, p[i], p[j], p[k]);
    const double squared = face.point.squaredNorm();
    if (squared < least) {
      least = squared;
      best = face;
    }
  }
  if (!inside) return best;
  const double sum = volume[0] + volume[1] + volume[2] + volume[3];
  Nearest whole{{0, 1, 2, 3}, {}, 4, Vector3d::Zero()};
  for (int i = 0; i < 4; ++i) {
    whole.weight[i] = volume[i] / sum;
    whole.point += whole.weight[i] * p[i];
  }
  return whole;
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
