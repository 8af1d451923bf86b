// SPDX-License-Identifier: BSD-3-Clause
#include "cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "container.hpp"
#include "environment.hpp"
#include "inside.hpp"

namespace swept::verify {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Points = std::vector<Vector3d>;

constexpr std::size_t kMostCells = 10'000'000;
/// Relative to the coordinates: a point goes through a pose (at most 6 roundings of 1.1e-16), as
/// many clippings as a cell is deep (kDepth, of 4 each, as a clipped corner may be clipped again),
/// and a distance (10; from a face of a hull, times the product of two of its sides, 20).
constexpr double kCoverRounding = 1e-13;

std::string placeText(const Vector3d& point) {
  char text[96];
  std::snprintf(text, sizeof text, "[%.6g, %.6g, %.6g]", point.x(), point.y(), point.z());
  return text;
}

/// One link.
class Containment {
 public:
  Containment(std::vector<Container> containers, std::string where)
      : containers_(std::move(containers)), where_(std::move(where)) {}

  std::size_t cells() const { return cells_; }

  /// `radius`: m, around the points.
  bool isIn(const Points& points, double radius) {
    ++cells_;
    if (cells_ > kMostCells) refuse(points.front());
    double size = 0.0;
    for (const Vector3d& point : points) size = std::max(size, point.lpNorm<1>());
    return std::ranges::any_of(containers_, [&](const Container& container) {
      const double rounding =
          kCoverRounding *
              (size + container.shape_from_link.translation().lpNorm<1>() + container.reach) +
          radius;
      return std::ranges::all_of(
          points, [&](const Vector3d& point) { return container.contains(point, rounding); });
    });
  }

  void triangle(const std::array<Vector3d, 3>& t, int depth = 0) {
    if (isIn({t.begin(), t.end()}, 0.0)) return;
    std::size_t longest = 0;
    const auto length = [&](std::size_t i) { return (t[i] - t[(i + 1) % 3]).norm(); };
    for (std::size_t i = 1; i < 3; ++i)
      if (length(i) > length(longest)) longest = i;
    const Vector3d middle = 0.5 * (t[longest] + t[(longest + 1) % 3]);
    if (depth > kDepth) refuse(middle);
    std::array<Vector3d, 3> first = t;
    std::array<Vector3d, 3> second = t;
    first[longest] = middle;
    second[(longest + 1) % 3] = middle;
    triangle(first, depth + 1);
    triangle(second, depth + 1);
  }

  /// Boxes of three coordinates, halved along the one in which a part is longest. `around`: points
  /// whose hull contains a part; none: it is empty.
  using Around = std::function<Points(const Vector3d& lower, const Vector3d& upper)>;
  void parts(const Vector3d& lower, const Vector3d& upper, const Vector3d& scale,
             const Around& around, int depth = 0) {
    const Points points = around(lower, upper);
    if (points.empty() || isIn(points, 0.0)) return;
    if (depth > kDepth) refuse(points.front());
    int axis = 0;
    Vector3d((upper - lower).cwiseProduct(scale)).maxCoeff(&axis);
    const double middle = 0.5 * (lower[axis] + upper[axis]);
    Vector3d end = upper;
    Vector3d begin = lower;
    end[axis] = begin[axis] = middle;
    parts(lower, end, scale, around, depth + 1);
    parts(begin, upper, scale, around, depth + 1);
  }

  void solid(const Surface& surface) {
    Cell root;
    for (const auto& t : surface.triangles) {
      Points corners;
      for (const int corner : t) {
        corners.push_back(surface.vertices[static_cast<std::size_t>(corner)]);
        root.box.extend(corners.back());
      }
      root.polygons.push_back(std::move(corners));
    }
    // No side of the first box is one of the solid.
    const Vector3d more = 0.0137 * root.box.sizes() + Vector3d::Constant(1e-6);
    root.box = {root.box.min() - more, root.box.max() + 1.3 * more};
    margin_ = 1e-13 * (root.box.min().cwiseAbs() + root.box.max().cwiseAbs()).maxCoeff();
    const Enclosure enclosure(surface);
    sides_.clear();
    divide(root, enclosure, 0);
  }

 private:
  struct Cell {
    Eigen::AlignedBox3d box;
    std::vector<Points> polygons;
  };

  [[noreturn]] void refuse(const Vector3d& point) const {
    throw Refusal(where_ + ": it is not shown to be contained at " + placeText(point));
  }

  bool isInside(const Vector3d& point, const Enclosure& enclosure) {
    const std::array<double, 3> key{point.x(), point.y(), point.z()};
    const auto [entry, isNew] = sides_.try_emplace(key, false);
    if (isNew) entry->second = enclosure.sideOf(point) != Side::Outside;
    return entry->second;
  }

  Points contentOf(const Cell& cell, const Enclosure& enclosure) {
    Points points;
    for (const Points& polygon : cell.polygons)
      points.insert(points.end(), polygon.begin(), polygon.end());
    if (points.empty() && !isInside(cell.box.center(), enclosure)) return points;
    const bool all = points.empty();
    for (int k = 0; k < 8; ++k) {
      const Vector3d corner = cell.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(k));
      if (all || isInside(corner, enclosure)) points.push_back(corner);
    }
    return points;
  }

  void divide(const Cell& cell, const Enclosure& enclosure, int depth) {
    const Points points = contentOf(cell, enclosure);
    if (points.empty() || isIn(points, 0.0)) return;
    if (depth > kDepth) refuse(points.front());
    int axis = 0;
    cell.box.sizes().maxCoeff(&axis);
    const double middle = cell.box.center()[axis];
    for (const double sign : {1.0, -1.0}) {
      Cell half;
      half.box = cell.box;
      (sign > 0.0 ? half.box.max() : half.box.min())[axis] = middle;
      for (const Points& polygon : cell.polygons) {
        Points part = clipped(polygon, axis, sign, sign * middle + margin_);
        if (!part.empty()) half.polygons.push_back(std::move(part));
      }
      divide(half, enclosure, depth + 1);
    }
  }

  /// Where sign * coordinate is at most `most`.
  static Points clipped(const Points& polygon, int axis, double sign, double most) {
    Points part;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector3d& a = polygon[i];
      const Vector3d& b = polygon[(i + 1) % polygon.size()];
      const double atA = sign * a[axis] - most;
      const double atB = sign * b[axis] - most;
      if (atA <= 0.0) part.push_back(a);
      if ((atA <= 0.0) == (atB <= 0.0)) continue;
      part.emplace_back(a + atA / (atA - atB) * (b - a));
    }
    return part;
  }

  static constexpr int kDepth = 150;
  std::vector<Container> containers_;
  std::string where_;
  std::size_t cells_ = 0;
  double margin_ = 0.0;  ///< m: triangles are cut this far beyond a box
  std::map<std::array<double, 3>, bool> sides_;
};

Points cornersOf(const Vector3d& lower, const Vector3d& upper, const Isometry3d& frame) {
  Points points;
  for (int k = 0; k < 8; ++k)
    points.push_back(frame * Vector3d((k & 1) != 0 ? upper.x() : lower.x(),
                                      (k & 2) != 0 ? upper.y() : lower.y(),
                                      (k & 4) != 0 ? upper.z() : lower.z()));
  return points;
}

/// A ball that was stretched along the axes by `semi` (m), and moved by `frame`.
void checkBall(const Vector3d& semi, const Isometry3d& frame, Containment& link) {
  const auto around = [&](const Vector3d& lower, const Vector3d& upper) {
    const Vector3d nearest = Vector3d::Zero().cwiseMax(lower).cwiseMin(upper);
    if (nearest.norm() > 1.0 + 1e-12) return Points();
    return cornersOf(lower.cwiseProduct(semi), upper.cwiseProduct(semi), frame);
  };
  link.parts(Vector3d::Constant(-1.0), Vector3d::Constant(1.0), semi, around);
}

/// Coordinates: the share of the radius, the angle, and z. `upper` and `lower`: m, radii at the
/// ends.
void checkColumn(double lower, double upper, double half, const Isometry3d& frame,
                 Containment& link) {
  const auto around = [&](const Vector3d& from, const Vector3d& to) {
    Points points;
    // A chord moved outward to where it touches the circle; of an angle above a right one there is
    // none near, and the corners contain nothing.
    const double angle = std::min(to.y() - from.y(), 0.5 * std::numbers::pi);
    const double outward = 1.0 / std::cos(0.5 * angle) * (1.0 + 1e-14);
    for (const double z : {from.z(), to.z()}) {
      const double radius = lower + (z + half) / (2.0 * half) * (upper - lower);
      for (const double share : {from.x(), to.x() * outward})
        for (const double turn : {from.y(), to.y()})
          points.push_back(frame * Vector3d(share * radius * std::cos(turn),
                                            share * radius * std::sin(turn), z));
    }
    return points;
  };
  const double most = std::max(lower, upper);
  constexpr int kParts = 8;
  for (int i = 0; i < kParts; ++i)
    link.parts(Vector3d(0.0, 2.0 * std::numbers::pi * i / kParts, -half),
               Vector3d(1.0, 2.0 * std::numbers::pi * (i + 1) / kParts, half),
               Vector3d(most, most, 1.0), around);
}

void checkShape(const Json& json, const std::string& where, Containment& link) {
  const Isometry3d frame = readPose(at(json, "pose", where), where + ", pose");
  const Json& named = at(json, "type", where);
  const std::string type = named.is_string() ? named.get<std::string>() : "";
  if (type == "sphere") {
    const double radius = sizeOf(json, "radius", where);
    if (!link.isIn({frame.translation()}, radius))
      checkBall(Vector3d::Constant(radius), frame, link);
  } else if (type == "ellipsoid") {
    checkBall(readVector(at(json, "semi_axes", where), where + ", semi_axes"), frame, link);
  } else if (type == "box") {
    const Vector3d half = readVector(at(json, "half_extents", where), where + ", half_extents");
    link.parts(-half, half, Vector3d::Ones(), [&](const Vector3d& lower, const Vector3d& upper) {
      return cornersOf(lower, upper, frame);
    });
  } else if (type == "cylinder" || type == "capsule" || type == "cone") {
    const double radius = sizeOf(json, "radius", where);
    const double half = sizeOf(json, "half_length", where);
    if (half > 0.0) checkColumn(radius, type == "cone" ? 0.0 : radius, half, frame, link);
    if (type != "capsule") return;
    for (const double end : {-half, half})
      checkBall(Vector3d::Constant(radius), frame * Eigen::Translation3d(0.0, 0.0, end), link);
  } else if (type == "mesh") {
    ShapeParts parts;
    readShape(json, frame, where, parts);
    for (const Element& element : parts.elements)
      link.triangle({element.points[0], element.points[1], element.points[2]});
    for (const Surface& surface : parts.solids) link.solid(surface);
  } else {
    throw Refusal(where + ": nothing is shown of a body of type '" + type + "'");
  }
}

}  // namespace

CoverSummary checkCover(const Json& cover, const Json& bodies) {
  CoverSummary summary;
  inDefaultEnvironment([&] {
    const bool ofScene = cover.contains("bodies");
    const std::string term = ofScene ? "body" : "link";
    std::map<std::string, const Json*> links;
    for (const Json& link : readList(cover, ofScene ? "bodies" : "links", "the model")) {
      const Json& name = at(link, term.c_str(), "the model");
      if (!name.is_string()) throw Refusal("the model: the name of a " + term + " is no text");
      if (!links.emplace(name.get<std::string>(), &link).second)
        throw Refusal("the model: " + term + " '" + name.get<std::string>() + "' is there twice");
    }
    for (const Json& body : bodies) {
      const auto name = body["name"].get<std::string>();
      std::string where = term;
      where += " '" + name + "'";
      const auto own = links.find(name);
      if (own == links.end()) throw Refusal(where + ": the model has nothing for it");
      std::vector<Container> containers = containersOf(*own->second, where);
      summary.shapes += containers.size();
      Containment link(std::move(containers), where);
      for (const Json& shape : body["shapes"]) checkShape(shape, where, link);
      summary.cells += link.cells();
      ++summary.links;
    }
  });
  return summary;
}

}  // namespace swept::verify
