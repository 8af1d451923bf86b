// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/convex_hull.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "geometry/convex_combination.hpp"
#include "geometry/error_model.hpp"
#include "geometry/point_text.hpp"
#include "geometry/quickhull.hpp"
#include "geometry/small_ball.hpp"
#include "geometry/support_points.hpp"
#include "geometry/weld.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {
namespace {

using Points = std::span<const Eigen::Vector3d>;

/// Selects the points to keep, and measures how far the others may lie outside their hull.
/// Coordinates are scaled to at most 1 in magnitude.
struct Selection {
  std::vector<bool> kept;
  std::vector<std::array<int, 3>> faces;
  double error = 0.0;

  explicit Selection(std::size_t count) : kept(count, false) {}

  /// Drops a point that is at most this far from some combination of kept ones, or keeps it if that
  /// is too far.
  void consider(std::size_t point, double distance) {
    if (distance <= tolerance::kHull)
      error = std::max(error, distance + detail::kHullRounding);
    else
      kept[point] = true;
  }

  static Selection all(std::size_t count) {
    Selection selection(count);
    selection.kept.assign(count, true);
    return selection;
  }
};

/// Index of the point with the largest key.
template <typename Key>
int argMax(Points points, const Key& key) {
  int best = 0;
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = key(points[i]);
    if (value > largest) {
      largest = value;
      best = static_cast<int>(i);
    }
  }
  return best;
}

/// Four points with a large spread, by a quick search.
struct Spread {
  std::array<int, 4> corners;
  Eigen::Vector3d axis;  ///< from the first to the second
  /// Unit, of the first three; zero when these are on a line.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double width = 0.0;      ///< distance of the third from the line of the first two
  double thickness = 0.0;  ///< distance of the fourth from the plane of the first three

  explicit Spread(Points points) {
    double longest = -1.0;
    for (int i = 0; i < 3; ++i) {
      const int low = argMax(points, [&](const Eigen::Vector3d& p) { return -p[i]; });
      const int high = argMax(points, [&](const Eigen::Vector3d& p) { return p[i]; });
      const double length = (points[high] - points[low]).squaredNorm();
      if (length <= longest) continue;
      longest = length;
      corners = {low, high, 0, 0};
    }
    const Eigen::Vector3d& origin = points[corners[0]];
    axis = points[corners[1]] - origin;
    corners[2] = argMax(
        points, [&](const Eigen::Vector3d& p) { return axis.cross(p - origin).squaredNorm(); });
    const Eigen::Vector3d across = axis.cross(points[corners[2]] - origin);
    const double area = across.norm();
    if (area == 0.0) return;  // one point, or points on a line
    width = area / axis.norm();
    normal = across / area;
    corners[3] =
        argMax(points, [&](const Eigen::Vector3d& p) { return std::abs(normal.dot(p - origin)); });
    thickness = std::abs(normal.dot(points[corners[3]] - origin));
  }
};

/// Points along a line: its two ends are kept.
Selection selectOnLine(Points points, const Spread& spread) {
  Selection selection(points.size());
  const int first = argMax(points, [&](const Eigen::Vector3d& p) { return -spread.axis.dot(p); });
  const int last = argMax(points, [&](const Eigen::Vector3d& p) { return spread.axis.dot(p); });
  const Eigen::Vector3d along = points[last] - points[first];
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d offset = points[i] - points[first];
    const double weight = std::clamp(offset.dot(along) / along.squaredNorm(), 0.0, 1.0);
    selection.consider(i, (offset - weight * along).norm());
  }
  selection.kept[first] = selection.kept[last] = true;
  return selection;
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Counter-clockwise hull of the points (Andrew 1979, monotone chain); `order` is lexicographic.
std::vector<int> polygonAround(std::span<const Eigen::Vector2d> points, std::vector<int>& order) {
  std::vector<int> polygon;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = polygon.size();
    for (int point : order) {
      while (polygon.size() >= start + 2 && turn(points[polygon[polygon.size() - 2]],
                                                 points[polygon.back()], points[point]) <= 0) {
        polygon.pop_back();
      }
      polygon.push_back(point);
    }
    polygon.pop_back();
    std::reverse(order.begin(), order.end());
  }
  return polygon;
}

/// Points in a plane: the corners of their polygon are kept. Each other point is measured against
/// the triangle of the fan, from the polygon's first corner, in whose sector it lies.
Selection selectInPlane(Points points, const Spread& spread) {
  int dropped = 0;
  spread.normal.cwiseAbs().maxCoeff(&dropped);
  std::vector<Eigen::Vector2d> flat;
  std::vector<int> order;
  for (const Eigen::Vector3d& p : points) {
    order.push_back(static_cast<int>(order.size()));
    flat.emplace_back(p[(dropped + 1) % 3], p[(dropped + 2) % 3]);
  }
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    return flat[i].x() < flat[j].x() || (flat[i].x() == flat[j].x() && flat[i].y() < flat[j].y());
  });
  const std::vector<int> polygon = polygonAround(flat, order);
  if (polygon.size() < 3) return Selection::all(points.size());

  Selection selection(points.size());
  // The tetrahedra need an apex off the plane, which is not a point of the hull.
  const Eigen::Vector3d apex = points[polygon[0]] + spread.normal;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto beyond = std::partition_point(
        polygon.begin() + 2, polygon.end() - 1,
        [&](int corner) { return turn(flat[polygon[0]], flat[corner], flat[i]) > 0.0; });
    const detail::Cone cone{points[polygon[0]] - apex, points[*(beyond - 1)] - apex,
                            points[*beyond] - apex};
    selection.consider(i, cone.distanceBound(points[i] - apex, detail::Cone::Part::Base));
  }
  for (int corner : polygon) selection.kept[corner] = true;
  return selection;
}

Selection selectInSpace(Points points, const Spread& spread) {
  const detail::Quickhull quickhull(points, spread.corners);
  if (!quickhull.consistent()) return Selection::all(points.size());
  Selection selection(points.size());
  selection.faces = quickhull.surface();
  for (const std::array<int, 3>& face : selection.faces) {
    for (int corner : face) selection.kept[corner] = true;
  }
  Eigen::Vector3d inside = Eigen::Vector3d::Zero();
  for (int corner : spread.corners) inside += 0.25 * points[corner];
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (selection.kept[i]) continue;
    const Eigen::Vector3d offset = points[i] - inside;
    const std::array<int, 3> face = quickhull.exitOf(inside, offset).corners;
    const detail::Cone cone{points[face[0]] - inside, points[face[1]] - inside,
                            points[face[2]] - inside};
    selection.consider(i, cone.distanceBound(offset, detail::Cone::Part::Tetrahedron));
  }
  return selection;
}

Selection select(Points points) {
  if (points.size() <= 3) return Selection::all(points.size());
  const Spread spread(points);
  // Differences of huge or tiny coordinates may not be finite.
  if (!(spread.width > tolerance::kHull)) {
    return spread.axis.norm() > tolerance::kHull ? selectOnLine(points, spread)
                                                 : Selection::all(points.size());
  }
  if (!(spread.thickness > tolerance::kHull)) return selectInPlane(points, spread);
  return selectInSpace(points, spread);
}

std::vector<Eigen::Vector3d> distinct(Points points) {
  const std::vector<int> first = detail::firstEqual(points);
  std::vector<Eigen::Vector3d> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (first[i] == static_cast<int>(i)) out.push_back(points[i]);
  }
  return out;
}

void requireUsable(Points points) {
  constexpr std::size_t kMaxCount = std::size_t{1} << 29;
  if (points.empty()) throw std::invalid_argument("convex hull has no points; allowed: at least 1");
  std::ostringstream message;
  if (points.size() > kMaxCount) {
    message << "convex hull has " << points.size() << " points; allowed: at most " << kMaxCount;
    throw std::invalid_argument(message.str());
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    message << "convex hull point " << i << " is " << detail::pointText(points[i])
            << "; allowed: finite coordinates";
    throw std::invalid_argument(message.str());
  }
}

/// Power of two that brings the largest coordinate into [0.5, 1) (below it when all are subnormal),
/// so that scaling does not round.
double normalizingScale(Points points) {
  double largest = 0.0;
  for (const Eigen::Vector3d& p : points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(1.0, std::min(-exponent, 1000));
}

}  // namespace

ConvexHull ConvexHull::of(std::span<const Eigen::Vector3d> points) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points] { return of(points); });
  }
  requireUsable(points);
  const std::vector<Eigen::Vector3d> candidates = distinct(points);
  const double scale = normalizingScale(candidates);
  std::vector<Eigen::Vector3d> scaled;
  scaled.reserve(candidates.size());
  for (const Eigen::Vector3d& p : candidates) scaled.push_back(scale * p);
  const Selection selection = select(scaled);

  auto data = std::make_shared<Data>();
  std::vector<int> vertexOf(candidates.size(), -1);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (!selection.kept[i]) continue;
    vertexOf[i] = static_cast<int>(data->vertices.size());
    data->vertices.push_back(candidates[i]);
    data->extent = std::max(data->extent, candidates[i].stableNorm());
  }
  for (const std::array<int, 3>& face : selection.faces) {
    data->faces.emplace_back(vertexOf[face[0]], vertexOf[face[1]], vertexOf[face[2]]);
  }
  data->supportPoints = std::make_shared<detail::SupportPoints>(data->vertices, scale);
  data->ball = detail::smallBall(data->vertices);
  data->error = selection.error / scale;
  data->extent = data->extent * detail::kLengthUp + std::numeric_limits<double>::min();
  return ConvexHull(std::move(data));
}

ConvexHull ConvexHull::scaled(const ConvexHull& hull, double factor,
                              const Eigen::Vector3d& middle) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, factor] { return scaled(hull, factor, middle); });
  }
  std::vector<Eigen::Vector3d> points;
  points.reserve(hull.vertices().size());
  for (const Eigen::Vector3d& vertex : hull.vertices())
    points.push_back(middle + factor * (vertex - middle));
  const ConvexHull kept = of(points);
  auto data = std::make_shared<Data>(*kept.data_);
  data->error += factor * hull.error() * (1.0 + std::numeric_limits<double>::epsilon());
  return ConvexHull(std::move(data));
}

}  // namespace swept
