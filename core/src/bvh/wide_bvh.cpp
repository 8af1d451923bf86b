// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/wide_bvh.hpp"

#include <cmath>
#include <limits>

namespace swept::detail {

namespace {

using Eigen::Vector3d;
using Tree = BvTree<Aabb>;

/// m. Boxes that single precision cannot hold are unbounded.
constexpr double kLargest = 1e30;

double area(const Aabb& box) {
  const Vector3d size = box.upper - box.lower;
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

/// The subtraction of the origin and the conversion to float round; what they move is measured or,
/// like the half extent's own rounding, covered by a few ulps of the coordinates.
BoxF boxOf(const Aabb& bounds, const Vector3d& origin) {
  BoxF box;
  for (int i = 0; i < 3; ++i) {
    const double middle = 0.5 * bounds.lower[i] + 0.5 * bounds.upper[i] - origin[i];
    if (!(std::abs(middle) < kLargest) || !(bounds.upper[i] - bounds.lower[i] < kLargest)) {
      box.half[i] = std::numeric_limits<float>::infinity();
      continue;
    }
    box.center[i] = static_cast<float>(middle);
    const double center = static_cast<double>(box.center[i]) + origin[i];
    const double half = std::max(bounds.upper[i] - center, center - bounds.lower[i]);
    const double slack =
        4.0 * std::numeric_limits<double>::epsilon() *
        (std::abs(bounds.lower[i]) + std::abs(bounds.upper[i]) + std::abs(origin[i]));
    box.half[i] =
        std::nextafter(static_cast<float>(half + slack), std::numeric_limits<float>::infinity());
  }
  return box;
}

class Collapse {
 public:
  Collapse(const Tree& binary, const Vector3d& origin) : binary_(binary), origin_(origin) {
    nodes_.reserve(binary.order().size() / 4 + 1);
  }

  std::vector<WideNode> run() {
    addNode(0);
    return std::move(nodes_);
  }

 private:
  using Lanes = std::array<int, WideNode::kLanes>;  ///< nodes of the binary tree

  int addNode(int root) {
    Lanes lanes;
    int count = 0;
    lanes[count++] = root;
    while (count < WideNode::kLanes && expandLargest(lanes, count)) {
    }
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    WideNode node{};
    node.count = count;
    for (int i = 0; i < count; ++i) {
      const BoxF box = boxOf(binary_.node(lanes[i]).volume, origin_);
      for (int axis = 0; axis < 3; ++axis) {
        node.center[axis][i] = box.center[axis];
        node.half[axis][i] = box.half[axis];
      }
    }
    for (int i = 0; i < count; ++i) {
      const Tree::Node& from = binary_.node(lanes[i]);
      node.child[i] = from.isLeaf() ? ~from.first : addNode(lanes[i]);
    }
    nodes_[index] = node;
    return static_cast<int>(index);
  }

  /// Replaces the lane of the largest box by its two children.
  bool expandLargest(Lanes& lanes, int& count) const {
    int largest = -1;
    for (int i = 0; i < count; ++i) {
      const Tree::Node& node = binary_.node(lanes[i]);
      if (node.isLeaf()) continue;
      if (largest < 0 || area(node.volume) > area(binary_.node(lanes[largest]).volume)) largest = i;
    }
    if (largest < 0) return false;
    const int parent = lanes[largest];
    lanes[largest] = parent + 1;
    lanes[count++] = binary_.node(parent).rightChild;
    return true;
  }

  const Tree& binary_;
  const Vector3d& origin_;
  std::vector<WideNode> nodes_;
};

}  // namespace

WideBvh::WideBvh(const Tree& binary) : origin_(binary.node(0).volume.center()) {
  rootBox_ = boxOf(binary.node(0).volume, origin_);
  for (int i = 0; i < 3; ++i) {
    reach_ += std::abs(static_cast<double>(rootBox_.center[i])) + rootBox_.half[i];
  }
  nodes_ = Collapse(binary, origin_).run();
}

}  // namespace swept::detail
