// SPDX-License-Identifier: BSD-3-Clause
#include "enclosed.hpp"

#include "inside.hpp"

namespace swept::verify {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

Vector3d pointOf(const Element& element) {
  if (!element.points.empty()) return element.points.front();
  return element.discs.empty() ? element.ellipsoid->center : element.discs.front().center;
}

void requireOutside(const Body& solid, const Body& other, const Isometry3d& solid_from_other,
                    const std::string& place) {
  for (const Surface& surface : solid.solids()) {
    const Enclosure enclosure(surface);
    for (const Element& element : other.elements()) {
      const Side side = enclosure.sideOf(solid_from_other * pointOf(element));
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
  const bool onePlane = proof.contains("intervals") && proof["intervals"][0][2].is_array();
  if (onePlane) return;
  const PairMotion start(model, motion, pair, 0.0, 0.0);
  const Isometry3d a_from_b =
      start.placedA().reference_from_link.inverse() * start.placedB().reference_from_link;
  requireOutside(a, b, a_from_b, place);
  requireOutside(b, a, a_from_b.inverse(), place);
}

}  // namespace swept::verify
