// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/sphere_cover.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "cover/cover_builder.hpp"

namespace swept {
namespace {

/// Squares of larger sizes leave single precision.
constexpr double kLargestRadius = 1e15;

void requireOption(const char* name, double value, double least) {
  if (value >= least) return;
  std::ostringstream message;
  message << "sphere cover option " << name << " is " << value << "; allowed: at least " << least;
  throw std::invalid_argument(message.str());
}

SphereCover everywhere() {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  SphereCover cover;
  cover.nodes.push_back({{Eigen::Vector3f::Zero(), kInfinity}, kInfinity, kInfinity, 0, 0, 0});
  cover.levels.push_back({kInfinity, 1, kInfinity});
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
  requireOption("finestOverhang", options.finestOverhang, 0.0);
  requireOption("finestRelative", options.finestRelative, 0.0);
  requireOption("mostBalls", options.mostBalls, 1.0);
  requireOption("mostInnerBalls", options.mostInnerBalls, 0.0);
  const BoundingSphere ball = boundingSphere(shape);
  const bool bounded =
      !std::holds_alternative<Plane>(shape) && !std::holds_alternative<HalfSpace>(shape);
  if (bounded && !(ball.center.norm() + ball.radius < kLargestRadius)) return everywhere();
  return detail::CoverBuilder(shape, options).build();
}

}  // namespace swept
