// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/sphere_cover.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "cover/cover_builder.hpp"
#include "cover/rounded.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

/// Between these, the fourth powers of a thousandth of a size, and the squares in single precision,
/// are normal numbers.
constexpr double kSmallestRadius = 1e-15;
constexpr double kLargestRadius = 1e15;

void requireOption(const char* name, double value, double least) {
  if (value >= least) return;
  std::ostringstream message;
  message << "sphere cover option " << name << " is " << value << "; allowed: at least " << least;
  throw std::invalid_argument(message.str());
}

/// For a shape that contains a point: no point of the ball is farther from it than the diameter.
SphereCover oneBall(const BoundingSphere& ball) {
  SphereCover::Node node{};
  node.ball.center = ball.center.cast<float>();
  if (!node.ball.center.allFinite()) node.ball.center.setZero();
  const double moved = (node.ball.center.cast<double>() - ball.center).stableNorm();
  node.ball.radius = detail::roundedUp((ball.radius + moved) * (1.0 + 1e-12));
  node.overhang = detail::roundedUp(2.0 * node.ball.radius);
  node.beyond = node.overhang;
  node.inside = -1.0F;
  node.level = 0;
  node.firstChild = 0;
  node.childCount = 0;
  SphereCover cover;
  cover.nodes.push_back(node);
  cover.levels.push_back({node.overhang, 1, node.overhang});
  return cover;
}

}  // namespace

std::vector<int> SphereCover::cut(int level) const {
  std::vector<int> out;
  std::vector<int> pending{0};
  while (!pending.empty()) {
    const int index = pending.back();
    pending.pop_back();
    const Node& node = nodes[index];
    if (node.childCount == 0 || nodes[node.firstChild].level > level) {
      out.push_back(index);
      continue;
    }
    for (int i = node.childCount; i-- > 0;) pending.push_back(node.firstChild + i);
  }
  return out;
}

SphereCover sphereCover(const Shape& shape, const SphereCoverOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return sphereCover(shape, options); });
  }
  requireOption("finestOverhang", options.finestOverhang, 0.0);
  requireOption("finestRelative", options.finestRelative, 0.0);
  requireOption("mostBalls", options.mostBalls, 1.0);
  requireOption("mostInnerBalls", options.mostInnerBalls, 0.0);
  const BoundingSphere ball = boundingSphere(shape);
  const bool bounded =
      !std::holds_alternative<Plane>(shape) && !std::holds_alternative<HalfSpace>(shape);
  const bool isTiny = ball.radius < kSmallestRadius && ball.radius > 0.0;
  const bool isHuge = !(ball.center.stableNorm() + ball.radius < kLargestRadius);
  if (bounded && (isTiny || isHuge)) return oneBall(ball);
  return detail::CoverBuilder(shape, options).build();
}

}  // namespace swept
