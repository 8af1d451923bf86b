// SPDX-License-Identifier: BSD-3-Clause
#include "enclosed.hpp"

#include <array>
#include <map>
#include <numeric>
#include <vector>

#include "inside.hpp"

namespace swept::verify {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d pointOf(const Element& element) {
  if (!element.points.empty()) return element.points.front();
  return element.discs.empty() ? element.ellipsoid->center : element.discs.front().center;
}

/// A point of each connected part of a body: elements with a common point are connected, and all of
/// them are on the same side of a surface that none of them meets.
std::vector<Vector3d> pointsOf(const Body& body) {
  std::vector<std::size_t> above(body.elements().size());
  std::iota(above.begin(), above.end(), std::size_t{0});
  const auto first = [&](std::size_t element) {
    while (above[element] != element) element = above[element] = above[above[element]];
    return element;
  };
  std::map<std::array<double, 3>, std::size_t> seen;
  for (std::size_t i = 0; i < above.size(); ++i)
    for (const Vector3d& point : body.elements()[i].points) {
      const auto [entry, isNew] = seen.try_emplace({point.x(), point.y(), point.z()}, i);
      if (!isNew) above[first(i)] = first(entry->second);
    }
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < above.size(); ++i)
    if (above[i] == i) points.push_back(pointOf(body.elements()[i]));
  return points;
}

void requireOutside(const Body& solid, const Body& other, const Isometry3d& solid_from_other,
                    const std::string& place) {
  if (solid.solids().empty()) return;
  const std::vector<Vector3d> points = pointsOf(other);
  for (const Surface& surface : solid.solids()) {
    const Enclosure enclosure(surface);
    for (const Vector3d& point : points) {
      const Side side = enclosure.sideOf(solid_from_other * point);
      if (side == Side::Outside) continue;
      throw Refusal(place + ": at the beginning, " + other.name() +
                    (side == Side::Inside ? " is inside " : " cannot be told to be outside ") +
                    solid.name());
    }
  }
}

}  // namespace

void requireNotEnclosed(const Model& model, const Motion& motion, PairToProve pair,
                        const Json& proof, const std::string& place) {
  const Body& a = model.bodies[static_cast<std::size_t>(pair.a)];
  const Body& b = model.bodies[static_cast<std::size_t>(pair.b)];
  if (a.solids().empty() && b.solids().empty()) return;
  // The intervals of a body without nodes were not checked.
  const bool onePlane = !b.nodes().empty() && proof["intervals"][0][2].is_array();
  if (onePlane) return;
  const PairMotion start(model, motion, pair, 0.0, 0.0);
  const Isometry3d a_from_b =
      start.placedA().reference_from_link.inverse() * start.placedB().reference_from_link;
  requireOutside(a, b, a_from_b, place);
  requireOutside(b, a, a_from_b.inverse(), place);
}

}  // namespace swept::verify
