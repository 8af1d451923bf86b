// SPDX-License-Identifier: BSD-3-Clause
#include "inside.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace swept::verify {
namespace {

using Eigen::Vector3d;

/// Relative to the lengths in a product: nearer to zero, its sign is not trusted.
constexpr double kDoubt = 1e-10;
/// m^3. Signs of products that have underflowed, or could have, are not trusted either.
constexpr double kLeastVolume = 1e-290;
constexpr int kRays = 32;

/// Sets of triangles that are joined one edge at a time.
class Joined {
 public:
  explicit Joined(std::size_t triangles) : above_(triangles) {
    std::iota(above_.begin(), above_.end(), 0);
  }
  int find(int triangle) {
    while (above(triangle) != triangle) triangle = above(triangle) = above(above(triangle));
    return triangle;
  }
  void join(int a, int b) { above(find(a)) = find(b); }

 private:
  int& above(int triangle) { return above_[static_cast<std::size_t>(triangle)]; }
  std::vector<int> above_;
};

struct Edge {
  std::vector<int> triangles;
  std::size_t left = 0;  ///< number of these without loose ones
  int net = 0;           ///< passes one way minus passes the other way, without loose ones
};
using Edges = std::map<std::pair<int, int>, Edge>;

std::pair<int, int> endsOf(const std::array<int, 3>& triangle, std::size_t k) {
  return std::minmax(int{triangle[k]}, int{triangle[(k + 1) % 3]});
}

Edges edgesOf(const Surface& surface) {
  Edges edges;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      edges[endsOf(surface.triangles[i], k)].triangles.push_back(static_cast<int>(i));
  for (auto& [ends, edge] : edges) edge.left = edge.triangles.size();
  return edges;
}

/// Triangles with an edge that no other has, and then those that have one without them. They are
/// part of nothing closed, like a sheet that touches a solid.
std::vector<bool> looseTriangles(const Surface& surface, Edges& edges) {
  std::vector<bool> loose(surface.triangles.size(), false);
  std::vector<const Edge*> pending;
  for (const auto& [ends, edge] : edges)
    if (edge.left == 1) pending.push_back(&edge);
  while (!pending.empty()) {
    const Edge& alone = *pending.back();
    pending.pop_back();
    for (const int triangle : alone.triangles) {
      const auto i = static_cast<std::size_t>(triangle);
      if (loose[i]) continue;
      loose[i] = true;
      for (std::size_t k = 0; k < 3; ++k) {
        Edge& edge = edges.at(endsOf(surface.triangles[i], k));
        if (--edge.left == 1) pending.push_back(&edge);
      }
    }
  }
  return loose;
}

enum class Crossing { None, Out, In, Doubtful };

/// Sign of a . (b x c); zero: too near to tell.
int orientation(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double product = a.dot(b.cross(c));
  const double doubt = kDoubt * a.norm() * b.norm() * c.norm() + kLeastVolume;
  return product > doubt ? 1 : product < -doubt ? -1 : 0;
}

Crossing crossing(const Vector3d& ray, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const int ab = orientation(ray, a, b), bc = orientation(ray, b, c), ca = orientation(ray, c, a);
  if ((ab > 0 || bc > 0 || ca > 0) && (ab < 0 || bc < 0 || ca < 0)) return Crossing::None;
  // The line passes inside the triangle or too near to an edge; in the other direction it does not
  // count.
  if (std::max({ray.dot(a), ray.dot(b), ray.dot(c)}) < 0.0) return Crossing::None;
  const int volume = orientation(a, b, c);
  if (ab == 0 || bc == 0 || ca == 0 || volume == 0) return Crossing::Doubtful;
  if (volume != ab) return Crossing::None;  // behind the point
  return ab > 0 ? Crossing::Out : Crossing::In;
}

/// Directions spread over the sphere in golden-angle steps, none along an axis.
Vector3d rayNumber(int i) {
  const double z = 1.0 - (2.0 * i + 1.0) / kRays;
  const double angle = 2.399963229728653 * i + 0.1;
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

}  // namespace

Enclosure::Enclosure(const Surface& surface)
    : surface_(surface), lower_(surface.vertices.front()), upper_(lower_) {
  for (const Vector3d& vertex : surface.vertices) {
    lower_ = lower_.cwiseMin(vertex);
    upper_ = upper_.cwiseMax(vertex);
  }
  Edges edges = edgesOf(surface);
  const std::vector<bool> loose = looseTriangles(surface, edges);
  Joined joined(surface.triangles.size());
  for (auto& [ends, edge] : edges) {
    std::erase_if(edge.triangles, [&](int i) { return loose[static_cast<std::size_t>(i)]; });
    for (const int triangle : edge.triangles) joined.join(triangle, edge.triangles.front());
  }
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    componentOf_.push_back(joined.find(static_cast<int>(i)));
    if (loose[i]) {
      components_[componentOf_.back()].closed = false;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const auto ends = endsOf(surface.triangles[i], k);
      edges.at(ends).net += surface.triangles[i][k] == ends.first ? 1 : -1;
    }
  }
  for (const auto& [ends, edge] : edges) {
    if (edge.triangles.empty()) continue;
    Component& component = components_[joined.find(edge.triangles.front())];
    component.closed = component.closed && edge.triangles.size() % 2 == 0;
    component.oriented = component.oriented && edge.net == 0;
  }
}

Side Enclosure::sideAlong(const Vector3d& ray, const Vector3d& point) const {
  std::map<int, std::pair<int, int>>
      crossed;  // per component: number of crossings, and outward minus inward
  for (std::size_t i = 0; i < surface_.triangles.size(); ++i) {
    const std::array<int, 3>& triangle = surface_.triangles[i];
    const auto corner = [&](std::size_t k) -> Vector3d {
      return surface_.vertices[static_cast<std::size_t>(triangle[k])] - point;
    };
    const Crossing found = crossing(ray, corner(0), corner(1), corner(2));
    if (found == Crossing::None) continue;
    const int component = componentOf_[i];
    if (!components_.at(component).closed) continue;
    if (found == Crossing::Doubtful) return Side::Unknown;
    auto& [number, net] = crossed[component];
    ++number;
    net += found == Crossing::Out ? 1 : -1;
  }
  for (const auto& [component, counts] : crossed) {
    const bool oriented = components_.at(component).oriented;
    if (oriented ? counts.second != 0 : counts.first % 2 != 0) return Side::Inside;
  }
  return Side::Outside;
}

Side Enclosure::sideOf(const Vector3d& point) const {
  if ((point.array() < lower_.array()).any() || (point.array() > upper_.array()).any())
    return Side::Outside;
  for (int i = 0; i < kRays; ++i) {
    const Side side = sideAlong(rayNumber(i), point);
    if (side != Side::Unknown) return side;
  }
  return Side::Unknown;
}

}  // namespace swept::verify
