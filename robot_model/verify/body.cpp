// SPDX-License-Identifier: BSD-3-Clause
#include "body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace swept::verify {
namespace {

using Eigen::Vector3d;

/// A node with more than this share of a body's elements is one of the topmost.
constexpr std::size_t kTopmost = 16;

double supportOf(const Element& element, const Vector3d& direction) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector3d& point : element.points) most = std::max(most, direction.dot(point));
  for (const Element::Disc& disc : element.discs) {
    const Vector3d across = direction - direction.dot(disc.axis) * disc.axis;
    most = std::max(most, direction.dot(disc.center) + disc.radius * across.norm());
  }
  if (element.ellipsoid)
    most = std::max(most, direction.dot(element.ellipsoid->center) +
                              (element.ellipsoid->axes.transpose() * direction).norm());
  return most + element.radius * direction.norm();
}

Vector3d centerOf(const Element& element) {
  Vector3d sum = Vector3d::Zero();
  std::size_t count = 0;
  const auto add = [&](const Vector3d& point) {
    sum += point;
    ++count;
  };
  for (const Vector3d& point : element.points) add(point);
  for (const Element::Disc& disc : element.discs) add(disc.center);
  if (element.ellipsoid) add(element.ellipsoid->center);
  return sum / static_cast<double>(count);
}

double reachOf(const Element& element) {
  double most = 0.0;
  for (const Vector3d& point : element.points) most = std::max(most, point.norm());
  for (const Element::Disc& disc : element.discs)
    most = std::max(most, disc.center.norm() + disc.radius);
  if (element.ellipsoid)
    most = std::max(most, element.ellipsoid->center.norm() + element.ellipsoid->axes.norm());
  return most + element.radius;
}

}  // namespace

Body::Body(std::string name, std::vector<Element> elements, std::vector<Flat> flats,
           std::vector<Surface> solids)
    : name_(std::move(name)), flats_(std::move(flats)), solids_(std::move(solids)) {
  for (const Flat& flat : flats_) size_ = std::max({size_, flat.size, std::abs(flat.offset)});
  if (elements.empty()) return;
  std::vector<Vector3d> centers;
  for (const Element& element : elements) {
    centers.push_back(centerOf(element));
    reach_ = std::max(reach_, reachOf(element));
    size_ = std::max({size_, element.size, reach_});
  }
  std::vector<std::size_t> order(elements.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  build(0, elements.size(), centers, order);
  for (const std::size_t index : order) elements_.push_back(std::move(elements[index]));
  for (Node& node : nodes_)
    if (node.last - node.first > elements_.size() / kTopmost) gather(node);
}

int Body::build(std::size_t first, std::size_t last, std::vector<Vector3d>& centers,
                std::vector<std::size_t>& order) {
  const auto node = static_cast<int>(nodes_.size());
  nodes_.push_back({.first = first, .last = last});
  if (last - first < 2) return node;
  Vector3d lower = centers[order[first]], upper = lower;
  for (std::size_t i = first; i < last; ++i) {
    lower = lower.cwiseMin(centers[order[i]]);
    upper = upper.cwiseMax(centers[order[i]]);
  }
  Eigen::Index axis = 0;
  (upper - lower).maxCoeff(&axis);
  const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
  const std::size_t middle = first + (last - first) / 2;
  // By the index if centres are equal: every machine builds the same tree.
  std::nth_element(begin, order.begin() + static_cast<std::ptrdiff_t>(middle),
                   order.begin() + static_cast<std::ptrdiff_t>(last),
                   [&](std::size_t a, std::size_t b) {
                     return std::pair(centers[a][axis], a) < std::pair(centers[b][axis], b);
                   });
  const int left = build(first, middle, centers, order);
  const int right = build(middle, last, centers, order);
  nodes_[static_cast<std::size_t>(node)].left = left;
  nodes_[static_cast<std::size_t>(node)].right = right;
  return node;
}

void Body::gather(Node& node) const {
  for (std::size_t i = node.first; i < node.last; ++i) {
    const Element& element = elements_[i];
    if (!element.discs.empty() || element.ellipsoid) {
      node.round.push_back(element);
      continue;
    }
    for (const Vector3d& point : element.points) node.balls.push_back({point, element.radius});
  }
  const auto key = [](const Ball& ball) {
    return std::tuple(ball.center.x(), ball.center.y(), ball.center.z(), ball.radius);
  };
  std::ranges::sort(node.balls, {}, key);
  const auto isSame = [&key](const Ball& a, const Ball& b) { return key(a) == key(b); };
  node.balls.erase(std::unique(node.balls.begin(), node.balls.end(), isSame), node.balls.end());
}

double Body::support(int node, const Vector3d& direction) const {
  const Node& own = nodes_[static_cast<std::size_t>(node)];
  const double length = direction.norm();
  double most = -std::numeric_limits<double>::infinity();
  for (const Ball& ball : own.balls)
    most = std::max(most, direction.dot(ball.center) + length * ball.radius);
  for (const Element& element : own.round) most = std::max(most, supportOf(element, direction));
  if (!own.balls.empty() || !own.round.empty()) return most;
  for (std::size_t i = own.first; i < own.last; ++i)
    most = std::max(most, supportOf(elements_[i], direction));
  return most;
}

}  // namespace swept::verify
