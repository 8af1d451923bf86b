// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/enclosing_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <utility>

#include "bvh/box_fit.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr std::size_t kMostParts = WideNode::kLanes;
/// Between the planes that are compared along an axis.
constexpr std::size_t kSlabs = 8;
/// Relative to the volume of what is divided: a division that takes off less is not worth a part.
constexpr double kLeastGain = 1e-3;
/// Relative to the radius of the mesh: a hull that reaches beyond it by less is good enough, of the
/// whole mesh and of its parts.
constexpr double kLeastConcavity = 0.01;
constexpr double kLeastConcavityOfPart = 2e-3;
constexpr int kMostLevels = 2;

/// Directions spread over the sphere, and the triangles between them: an octahedron whose faces are
/// divided.
class Sphere38 {
 public:
  static constexpr std::size_t kCount = 38;

  static const Sphere38& get() {
    static const Sphere38 sphere;
    return sphere;
  }

  std::array<float, kCount> x{}, y{}, z{};
  std::vector<std::array<int, 3>> faces;

 private:
  static constexpr int kParts = 3;  // of an edge of the octahedron

  Sphere38() {
    for (int octant = 0; octant < 8; ++octant)
      for (int i = 0; i < kParts; ++i)
        for (int j = 0; i + j < kParts; ++j) {
          addFace(octant, {{{i, j}, {i + 1, j}, {i, j + 1}}});
          if (i + j + 1 < kParts) addFace(octant, {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
  }

  void addFace(int octant, const std::array<std::array<int, 2>, 3>& corners) {
    std::array<int, 3> face{};
    for (std::size_t k = 0; k < 3; ++k) face[k] = indexOf(octant, corners[k][0], corners[k][1]);
    // A mirrored octant turns its faces around.
    const bool mirrored = (octant & 1) != ((octant >> 1 & 1) ^ (octant >> 2));
    if (mirrored) std::swap(face[1], face[2]);
    faces.push_back(face);
  }

  int indexOf(int octant, int i, int j) {
    const std::array<int, 3> at{(octant & 1) != 0 ? -i : i, (octant & 2) != 0 ? -j : j,
                                (octant & 4) != 0 ? i + j - kParts : kParts - i - j};
    const auto [found, isNew] = known_.try_emplace(at, static_cast<int>(known_.size()));
    if (isNew) {
      const Vector3d direction = Vector3d(at[0], at[1], at[2]).normalized();
      x[found->second] = static_cast<float>(direction.x());
      y[found->second] = static_cast<float>(direction.y());
      z[found->second] = static_cast<float>(direction.z());
    }
    return found->second;
  }

  std::map<std::array<int, 3>, int> known_;
};

/// The points that are farthest along a set of directions, in single precision: what choices need.
class Farthest {
 public:
  Farthest() { height_.fill(-std::numeric_limits<float>::infinity()); }

  void add(const Vector3d& point) {
    const Sphere38& sphere = Sphere38::get();
    const std::array<float, 3> p{static_cast<float>(point.x()), static_cast<float>(point.y()),
                                 static_cast<float>(point.z())};
    // Without branches: few points are farther than all before.
    std::array<float, Sphere38::kCount> height;
    for (std::size_t k = 0; k < Sphere38::kCount; ++k)
      height[k] = sphere.x[k] * p[0] + sphere.y[k] * p[1] + sphere.z[k] * p[2];
    int farther = 0;
    for (std::size_t k = 0; k < Sphere38::kCount; ++k) farther |= height[k] > height_[k] ? 1 : 0;
    if (farther == 0) return;
    for (std::size_t k = 0; k < Sphere38::kCount; ++k) take(k, height[k], p);
  }

  void add(const Farthest& other) {
    for (std::size_t k = 0; k < Sphere38::kCount; ++k)
      take(k, other.height_[k], {other.point_[0][k], other.point_[1][k], other.point_[2][k]});
  }

  /// m^3, near the volume of their hull; not negative. 0 without points.
  double volume() const {
    if (std::isinf(height_[0])) return 0.0;
    const auto at = [this](int k) {
      return Vector3d(point_[0][k] - point_[0][0], point_[1][k] - point_[1][0],
                      point_[2][k] - point_[2][0]);
    };
    double sum = 0.0;
    for (const auto& [a, b, c] : Sphere38::get().faces) sum += at(a).dot(at(b).cross(at(c)));
    // The directions are few: of points near a plane the sum may be negative.
    return std::max(sum / 6.0, 0.0);
  }

 private:
  void take(std::size_t k, float height, const std::array<float, 3>& p) {
    if (!(height > height_[k])) return;
    height_[k] = height;
    for (std::size_t i = 0; i < 3; ++i) point_[i][k] = p[i];
  }

  std::array<float, Sphere38::kCount> height_;
  std::array<std::array<float, Sphere38::kCount>, 3> point_{};
};

struct Division {
  double gain = 0.0;  ///< m^3, less in the parts
  int axis = 0;
  double at = 0.0;  ///< m
};

/// What is in a box.
struct Region {
  Vector3d lower;
  Vector3d upper;
  std::vector<Vector3d> points;    ///< corners of clipped triangles
  std::vector<int> corners;        ///< of these, one triangle after the other,
  std::vector<std::size_t> ends;   ///< and where each ends
  std::vector<Vector3d> enclosed;  ///< corners of the box in the mesh
  Division division;

  template <typename Use>
  void forEachPolygon(const Use& use) const {
    std::size_t first = 0;
    for (const std::size_t end : ends) {
      use(std::span(corners).subspan(first, end - first));
      first = end;
    }
  }
};

/// Where the edge between two points crosses a plane across an axis.
Vector3d crossing(const Vector3d& p, const Vector3d& q, int axis, double at) {
  // The same end first on both sides.
  const Vector3d& low = p[axis] < q[axis] ? p : q;
  const Vector3d& high = p[axis] < q[axis] ? q : p;
  Vector3d point = low + (at - low[axis]) / (high[axis] - low[axis]) * (high - low);
  point[axis] = at;
  return point;
}

/// One side of a plane in a region.
class Half {
 public:
  /// Below the plane (side 1) or above it (-1).
  Half(const Region& region, int axis, double at, double side, Region& half)
      : region_(region),
        axis_(axis),
        at_(at),
        side_(side),
        half_(half),
        kept_(region.points.size(), -1) {}

  void addPolygon(std::span<const int> polygon) {
    const std::size_t before = half_.corners.size();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const int p = polygon[i];
      const int q = polygon[i + 1 < polygon.size() ? i + 1 : 0];
      if (keeps(p)) half_.corners.push_back(indexOf(p));
      if (keeps(p) != keeps(q)) half_.corners.push_back(crossingOf(p, q));
    }
    if (half_.corners.size() > before) half_.ends.push_back(half_.corners.size());
  }

 private:
  const Vector3d& point(int index) const { return region_.points[static_cast<std::size_t>(index)]; }
  bool keeps(int index) const { return side_ * (point(index)[axis_] - at_) <= 0.0; }
  int add(const Vector3d& point) {
    half_.points.push_back(point);
    return static_cast<int>(half_.points.size()) - 1;
  }
  int indexOf(int index) {
    int& own = kept_[static_cast<std::size_t>(index)];
    if (own < 0) own = add(point(index));
    return own;
  }
  int crossingOf(int p, int q) {
    const auto [found, isNew] = crossings_.try_emplace(std::minmax(p, q), 0);
    if (isNew) found->second = add(crossing(point(p), point(q), axis_, at_));
    return found->second;
  }

  const Region& region_;
  const int axis_;
  const double at_;
  const double side_;
  Region& half_;
  std::vector<int> kept_;  ///< per point of the region, its index here; -1: none yet
  std::map<std::pair<int, int>, int> crossings_;
};

class Divider {
 public:
  explicit Divider(const TriangleMesh& mesh) : mesh_(mesh), margin_(1e-12 * mesh.hull().extent()) {}

  Region whole() const {
    Region whole;
    whole.points = mesh_.vertices();
    whole.lower = whole.upper = whole.points.front();
    for (const Vector3d& point : whole.points) {
      whole.lower = whole.lower.cwiseMin(point);
      whole.upper = whole.upper.cwiseMax(point);
    }
    for (const Eigen::Vector3i& triangle : mesh_.triangles()) {
      whole.corners.insert(whole.corners.end(), triangle.begin(), triangle.end());
      whole.ends.push_back(whole.corners.size());
    }
    for (int i = 0; i < 8; ++i)
      takeEnclosed(Vector3d((i & 1) != 0 ? whole.upper.x() : whole.lower.x(),
                            (i & 2) != 0 ? whole.upper.y() : whole.lower.y(),
                            (i & 4) != 0 ? whole.upper.z() : whole.lower.z()),
                   whole.enclosed);
    return whole;
  }

  /// Those that it is divided into; itself if no division is worth it.
  std::vector<Region> divided(Region region) const {
    const double least = kLeastGain * choose(region);
    // Halves of a ring fill their hulls as badly as the ring does, but quarters do not.
    const bool blind = !(region.division.gain > least);
    if (blind) region.division = middleOf(region);
    std::vector<Region> regions;
    regions.push_back(region);
    divide(0, regions);
    if (blind && !(worthiest(regions)->division.gain > least)) return {std::move(region)};
    while (regions.size() < kMostParts) {
      const auto next = worthiest(regions);
      if (!(next->division.gain > least)) break;
      divide(static_cast<std::size_t>(next - regions.begin()), regions);
    }
    return regions;
  }

 private:
  static std::vector<Region>::iterator worthiest(std::vector<Region>& regions) {
    return std::ranges::max_element(regions, {},
                                    [](const Region& part) { return part.division.gain; });
  }

  /// m. Something is in the region at both ends.
  struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();
  };
  static Extent extentOf(const Region& region, int axis) {
    Extent extent;
    for (const std::vector<Vector3d>* points : {&region.points, &region.enclosed})
      for (const Vector3d& point : *points) {
        extent.low = std::min(extent.low, point[axis]);
        extent.high = std::max(extent.high, point[axis]);
      }
    return extent;
  }

  /// Across the longest extent.
  static Division middleOf(const Region& region) {
    Division middle;
    double longest = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = extentOf(region, axis);
      if (!(high - low > longest)) continue;
      longest = high - low;
      middle = {0.0, axis, 0.5 * low + 0.5 * high};
    }
    return middle;
  }

  void divide(std::size_t index, std::vector<Region>& regions) const {
    Region above = halfOf(regions[index], -1.0);
    regions[index] = halfOf(regions[index], 1.0);
    choose(regions[index]);
    choose(above);
    regions.push_back(std::move(above));
  }

  void takeEnclosed(const Vector3d& point, std::vector<Vector3d>& enclosed) const {
    if (mesh_.encloses(point)) enclosed.push_back(point);
  }

  /// Those of the four corners of a box's section that the mesh encloses.
  std::vector<Vector3d> sectionOf(const Region& region, int axis, double at) const {
    std::vector<Vector3d> enclosed;
    for (int i = 0; i < 4; ++i) {
      Vector3d corner;
      corner[axis] = at;
      for (int k = 0; k < 2; ++k) {
        const int other = (axis + 1 + k) % 3;
        corner[other] = (i >> k & 1) != 0 ? region.upper[other] : region.lower[other];
      }
      takeEnclosed(corner, enclosed);
    }
    return enclosed;
  }

  /// The part below the division (side 1) or above it (-1).
  Region halfOf(const Region& region, double side) const {
    const auto& [gain, axis, at] = region.division;
    Region half;
    half.lower = region.lower;
    half.upper = region.upper;
    (side > 0.0 ? half.upper : half.lower)[axis] = at;
    Half into(region, axis, at + side * margin_, side, half);
    region.forEachPolygon([&into](std::span<const int> polygon) { into.addPolygon(polygon); });
    half.enclosed = sectionOf(region, axis, at);
    for (const Vector3d& corner : region.enclosed)
      if (side * (corner[axis] - at) < 0.0) half.enclosed.push_back(corner);
    return half;
  }

  /// Sets the region's best division; returns about its hull's volume, m^3.
  double choose(Region& region) const {
    Farthest all;
    for (const Vector3d& point : region.points) all.add(point);
    for (const Vector3d& corner : region.enclosed) all.add(corner);
    const double volume = all.volume();
    region.division = {};
    for (int axis = 0; axis < 3; ++axis) choose(region, volume, axis);
    return volume;
  }

  void choose(Region& region, double volume, int axis) const {
    const auto [low, high] = extentOf(region, axis);
    if (!(high > low)) return;
    const auto plane = [low = low, high = high](std::size_t i) {
      return low + (high - low) * static_cast<double>(i) / static_cast<double>(kSlabs);
    };
    std::array<Farthest, kSlabs> before;
    addSlabs(region, axis, plane, before);
    std::array<Farthest, kSlabs> behind = before;
    for (std::size_t i = 1; i < kSlabs; ++i) {
      before[i].add(before[i - 1]);
      behind[kSlabs - 1 - i].add(behind[kSlabs - i]);
    }
    for (std::size_t i = 1; i < kSlabs; ++i) {
      Farthest& below = before[i - 1];
      Farthest& above = behind[i];
      for (const Vector3d& corner : sectionOf(region, axis, plane(i))) {
        below.add(corner);
        above.add(corner);
      }
      const double gain = volume - below.volume() - above.volume();
      if (gain > region.division.gain) region.division = {gain, axis, plane(i)};
    }
  }

  /// Of what is between each plane and the next.
  template <typename Plane>
  static void addSlabs(const Region& region, int axis, const Plane& plane,
                       std::array<Farthest, kSlabs>& slabs) {
    const auto slabOf = [&](double at) {
      std::size_t slab = 0;
      while (slab + 1 < kSlabs && at > plane(slab + 1)) ++slab;
      return slab;
    };
    std::vector<std::size_t> slabOfPoint;
    for (const Vector3d& point : region.points) {
      slabOfPoint.push_back(slabOf(point[axis]));
      slabs[slabOfPoint.back()].add(point);
    }
    region.forEachPolygon([&](std::span<const int> polygon) {
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto p = static_cast<std::size_t>(polygon[i]);
        const auto q = static_cast<std::size_t>(polygon[i + 1 < polygon.size() ? i + 1 : 0]);
        const auto [first, last] = std::minmax(slabOfPoint[p], slabOfPoint[q]);
        for (std::size_t slab = first; slab < last; ++slab) {
          const Vector3d at = crossing(region.points[p], region.points[q], axis, plane(slab + 1));
          slabs[slab].add(at);
          slabs[slab + 1].add(at);
        }
      }
    });
    for (const Vector3d& corner : region.enclosed) slabs[slabOf(corner[axis])].add(corner);
  }

  const TriangleMesh& mesh_;
  /// m. Triangles are cut this much beyond the sides of the boxes. So where rounding decides
  /// whether a corner of a box is enclosed, there is surface beside it.
  const double margin_;
};

/// m: the largest distance from the middle of a face of the hull to the mesh, over some faces.
double concavityOf(const ConvexHull& hull, const TriangleMesh& mesh) {
  constexpr std::size_t kSamples = 8;
  const std::size_t stride = hull.faces().size() / kSamples + 1;
  DistanceOptions options;
  options.tolerance = 1e-3 * hull.extent();
  double most = 0.0;
  for (std::size_t i = 0; i < hull.faces().size(); i += stride) {
    const Eigen::Vector3i& face = hull.faces()[i];
    const Vector3d middle =
        (hull.vertices()[face[0]] + hull.vertices()[face[1]] + hull.vertices()[face[2]]) / 3.0;
    const Isometry3d mesh_from_point(Eigen::Translation3d{middle});
    most = std::max(most, distance(mesh, Sphere{0.0}, mesh_from_point, options).lower);
  }
  return most;
}

EnclosingParts::Part partOf(const Region& region, const TriangleMesh& mesh) {
  std::vector<Vector3d> points = region.points;
  points.insert(points.end(), region.enclosed.begin(), region.enclosed.end());
  ConvexHull hull = ConvexHull::coarser(ConvexHull::of(points));
  // A clipped corner is off its edge by a few roundings, each time that it is clipped. A corner of
  // the box that rounding left out is as near to the surface that is taken in beside it.
  const double radius = hull.error() + 4.0 * tolerance::kSupportRounding * mesh.hull().extent();
  const double concavity = concavityOf(hull, mesh);
  return {std::move(hull), radius, concavity};
}

/// Of the points of a hull.
OrientedBox boxAround(const std::vector<Vector3d>& points, const Vector3d& origin) {
  Aabb bounds{points.front(), points.front()};
  Moments moments;
  for (const Vector3d& p : points) {
    bounds.lower = bounds.lower.cwiseMin(p);
    bounds.upper = bounds.upper.cwiseMax(p);
    const Vector3d d = p - origin;
    moments.add({1.0, d, d * d.transpose()});
  }
  return fitOrientedBox({points, 0.0, bounds}, moments.scatter(), origin);
}

WideNode boxesOf(const std::vector<EnclosingParts::Part>& parts, const Vector3d& origin) {
  WideNode boxes{};
  boxes.count = static_cast<std::int32_t>(parts.size());
  boxes.origin = origin;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    boxes.child[i] = ~static_cast<std::int32_t>(i);
    boxes.set(static_cast<int>(i), boxAround(parts[i].hull.vertices(), origin));
  }
  return boxes;
}

/// Adds the parts of a region, and theirs; returns its node, or -1 if it is not worth dividing.
int addNode(const TriangleMesh& mesh, const Divider& divider, Region region, int level,
            std::vector<EnclosingParts::Node>& nodes) {
  std::vector<Region> regions = divider.divided(std::move(region));
  if (regions.size() < 2) return -1;
  const auto index = static_cast<int>(nodes.size());
  nodes.emplace_back();
  EnclosingParts::Node node;
  for (const Region& part : regions) node.parts.push_back(partOf(part, mesh));
  node.boxes = boxesOf(node.parts, mesh.hull().ball().center);
  const double least = kLeastConcavityOfPart * mesh.hull().ball().radius;
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (level < kMostLevels && node.parts[i].concavity > least)
      node.parts[i].children = addNode(mesh, divider, std::move(regions[i]), level + 1, nodes);
  nodes[static_cast<std::size_t>(index)] = std::move(node);
  return index;
}

}  // namespace

EnclosingParts enclosingParts(const TriangleMesh& mesh) {
  EnclosingParts found;
  const double size = mesh.hull().ball().radius;
  if (mesh.concavity() > kLeastConcavity * size) {
    const Divider divider(mesh);
    addNode(mesh, divider, divider.whole(), 1, found.nodes);
  }
  return found;
}

}  // namespace swept::detail
