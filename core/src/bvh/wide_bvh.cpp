// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/wide_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bv/extents.hpp"
#include "bv/principal_axes.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Node = TreeTopology::Node;

/// m. Boxes that single precision cannot hold are unbounded.
constexpr double kLargest = 1e30;

double area(const Aabb& box) {
  const Vector3d size = box.upper - box.lower;
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

/// Not smaller than `value` >= 0.
float roundedUp(double value) {
  return static_cast<float>(value * (1.0 + 1.2e-7)) + std::numeric_limits<float>::min();
}

/// The nearest numbers that single precision holds (Dekker 1971, splitting). Not by conversion to
/// float and back, which GCC 12 optimises away where it vectorises.
template <typename Derived>
typename Derived::PlainObject inSinglePrecision(const Eigen::MatrixBase<Derived>& values) {
  const typename Derived::PlainObject spread = (0x1p29 + 1.0) * values;
  return spread - (spread - values);
}

OrientedBox unbounded(const Vector3d& origin) {
  OrientedBox box;
  box.center = origin;
  box.half.fill(std::numeric_limits<float>::infinity());
  return box;
}

/// Sums that give the second moments of points about their mean. They add up, so that a node's take
/// no second look at its primitives.
struct Moments {
  double count = 0.0;
  Vector3d sum = Vector3d::Zero();
  Matrix3d outer = Matrix3d::Zero();

  void add(const Moments& other) {
    count += other.count;
    sum += other.sum;
    outer += other.outer;
  }
  Matrix3d scatter() const { return outer - sum * sum.transpose() / count; }
};

/// A run of primitives.
struct Run {
  int first;
  int count;
};

Aabb boundsOf(const PrimitivePoints& primitives, const Run& run) {
  const std::size_t per = primitives.perPrimitive;
  const auto first = static_cast<std::size_t>(run.first);
  const auto count = static_cast<std::size_t>(run.count);
  Aabb box{primitives.points[first * per], primitives.points[first * per]};
  for (const Vector3d& p : primitives.points.subspan(first * per, count * per)) {
    box.lower = box.lower.cwiseMin(p);
    box.upper = box.upper.cwiseMax(p);
  }
  if (primitives.radii.empty()) return box;
  const auto radii = primitives.radii.subspan(first, count);
  const double radius = *std::max_element(radii.begin(), radii.end());
  // More than the one rounding of the coordinates.
  const Vector3d far = box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).array() + radius;
  const Vector3d growth = Vector3d::Constant(radius) + 4e-16 * far;
  return {box.lower - growth, box.upper + growth};
}

/// Of every node of a tree.
std::vector<Aabb> boundsOf(const TreeTopology& tree, const PrimitivePoints& primitives) {
  std::vector<Aabb> bounds(tree.nodes.size());
  for (std::size_t i = bounds.size(); i-- > 0;) {  // children follow their parents
    const Node& node = tree.nodes[i];
    if (node.rightChild < 0) {
      bounds[i] = boundsOf(primitives, {node.first, node.count});
      continue;
    }
    const Aabb& left = bounds[i + 1];
    const Aabb& right = bounds[static_cast<std::size_t>(node.rightChild)];
    bounds[i] = {left.lower.cwiseMin(right.lower), left.upper.cwiseMax(right.upper)};
  }
  return bounds;
}

/// Fits boxes to runs of primitives.
class BoxFitter {
 public:
  BoxFitter(const PrimitivePoints& primitives, const Vector3d& middle)
      : primitives_(primitives), middle_(middle) {}

  Moments moments(int primitive) const {
    Moments moments;
    for (const Vector3d& p : pointsOf({primitive, 1})) {
      const Vector3d d = p - middle_;
      moments.count += 1.0;
      moments.sum += d;
      moments.outer += d * d.transpose();
    }
    return moments;
  }

  /// Of one primitive.
  OrientedBox fit(int primitive, const Vector3d& origin) const {
    const Run run{primitive, 1};
    return fit(run, boundsOf(primitives_, run), moments(primitive), origin);
  }

  /// Along the principal axes, the same turned, or those of the frame: the box of least surface.
  /// Its centre is a float from `origin`.
  OrientedBox fit(const Run& run, const Aabb& bounds, const Moments& moments,
                  const Vector3d& origin) const {
    const std::span<const Vector3d> points = pointsOf(run);
    double radius = 0.0;
    if (!primitives_.radii.empty()) {
      for (int i = run.first; i < run.first + run.count; ++i)
        radius = std::max(radius, primitives_.radii[static_cast<std::size_t>(i)]);
    }
    const Vector3d far =
        bounds.lower.cwiseAbs().cwiseMax(bounds.upper.cwiseAbs()).cwiseMax(origin.cwiseAbs());
    if (!(far.maxCoeff() < kLargest)) return unbounded(origin);
    Matrix3d axes = Matrix3d::Identity();
    if (points.size() == 3) {
      axes = triangleAxes(points[0], points[1], points[2]);
    } else if (points.size() > 3) {
      axes = principalAxes(moments.scatter());
    }
    OrientedBox box = along(axes, points, radius, origin, far.sum());
    // Principal axes of a patch about as wide as it is long may be those of its diagonals.
    if (points.size() > 3 && box.half[1] > 0.6F * box.half[0]) {
      const OrientedBox diagonal = along(turned(axes), points, radius, origin, far.sum());
      if (surface(diagonal) < surface(box)) box = diagonal;
    }
    if (surface(box) > area(bounds)) {
      box = along(Matrix3d::Identity(), points, radius, origin, far.sum());
    }
    return box;
  }

 private:
  std::span<const Vector3d> pointsOf(const Run& run) const {
    const std::size_t per = primitives_.perPrimitive;
    return primitives_.points.subspan(static_cast<std::size_t>(run.first) * per,
                                      static_cast<std::size_t>(run.count) * per);
  }

  static double surface(const OrientedBox& box) {
    return 4.0 * (static_cast<double>(box.half[0]) * box.half[1] +
                  static_cast<double>(box.half[1]) * box.half[2] +
                  static_cast<double>(box.half[2]) * box.half[0]);
  }

  /// By 45 degrees about the last axis.
  static Matrix3d turned(const Matrix3d& axes) {
    Matrix3d result = axes;
    result.col(0) = std::sqrt(0.5) * (axes.col(0) + axes.col(1));
    result.col(1) = std::sqrt(0.5) * (axes.col(1) - axes.col(0));
    return result;
  }

  /// Lemma: p - origin rounds by half an epsilon of the coordinates, whose 1-norms are at most
  /// `far` for both, and the projections by at most three more of that size; likewise that of the
  /// centre. 16 epsilons of `far` cover them.
  static OrientedBox along(const Matrix3d& wanted, std::span<const Vector3d> points, double radius,
                           const Vector3d& origin, double far) {
    const Matrix3d axes = inSinglePrecision(wanted);
    const Vector3d& first = points.front();
    const Extents extents = extentsAlong(points, axes);
    const Vector3d start = axes.transpose() * (first - origin);
    const Vector3d lower = start + extents.lower, upper = start + extents.upper;
    const Vector3d center = inSinglePrecision(Vector3d(axes * (0.5 * (lower + upper))));
    const Vector3d middle = axes.transpose() * center;
    const double slack = 16.0 * std::numeric_limits<double>::epsilon() * far + radius;
    OrientedBox box;
    box.center = origin + center;
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i) box.axes[j][i] = static_cast<float>(axes(i, j));
      box.half[j] = roundedUp(std::max(upper[j] - middle[j], middle[j] - lower[j]) + slack);
    }
    return box;
  }

  const PrimitivePoints& primitives_;
  const Vector3d middle_;
};

class Collapse {
 public:
  Collapse(const TreeTopology& binary, const PrimitivePoints& primitives)
      : binary_(binary.nodes),
        bounds_(boundsOf(binary, primitives)),
        fitter_(primitives, bounds_.front().center()) {
    nodes_.reserve(binary.order.size() / 4 + 1);
    const Moments moments = addNode(0);
    const Node& root = binary_.front();
    rootBox_ = fitter_.fit({root.first, root.count}, bounds(), moments, bounds().center());
  }

  std::vector<WideNode> takeNodes() { return std::move(nodes_); }
  const Aabb& bounds() const { return bounds_.front(); }
  const OrientedBox& rootBox() const { return rootBox_; }

 private:
  /// Of the binary tree, or a single primitive.
  struct Lane {
    std::size_t node;
    int primitive;  ///< -1: it is a node
  };
  struct Lanes {
    std::array<Lane, WideNode::kLanes> of;
    int count = 0;
    void add(std::size_t node, int primitive) { of[count++] = {node, primitive}; }
  };

  Moments addNode(std::size_t root) {
    Lanes lanes;
    lanes.add(root, -1);
    while (lanes.count < WideNode::kLanes && splitLargest(lanes)) {
    }
    while (unfoldSmallest(lanes)) {
    }
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    WideNode node{};
    node.count = lanes.count;
    node.origin = bounds_[root].center();
    Moments all;
    for (int i = 0; i < lanes.count; ++i) {
      const auto [from, primitive] = lanes.of[i];
      if (primitive >= 0) {
        node.child[i] = ~primitive;
        node.set(i, fitter_.fit(primitive, node.origin));
        all.add(fitter_.moments(primitive));
        continue;
      }
      node.child[i] = static_cast<int>(nodes_.size());
      const Moments moments = addNode(from);
      const Run run{binary_[from].first, binary_[from].count};
      node.set(i, fitter_.fit(run, bounds_[from], moments, node.origin));
      all.add(moments);
    }
    nodes_[index] = node;
    return all;
  }

  /// Replaces the lane of the largest inner node by its two children.
  bool splitLargest(Lanes& lanes) const {
    int largest = -1;
    for (int i = 0; i < lanes.count; ++i) {
      const std::size_t node = lanes.of[i].node;
      if (binary_[node].rightChild < 0) continue;
      if (largest < 0 || area(bounds_[node]) > area(bounds_[lanes.of[largest].node])) largest = i;
    }
    if (largest < 0) return false;
    const std::size_t parent = lanes.of[largest].node;
    lanes.of[largest].node = parent + 1;
    lanes.add(static_cast<std::size_t>(binary_[parent].rightChild), -1);
    return true;
  }

  /// Replaces the leaf of the fewest primitives by these, if there is room. Other leaves become
  /// nodes of their own.
  bool unfoldSmallest(Lanes& lanes) const {
    int smallest = -1;
    for (int i = 0; i < lanes.count; ++i) {
      const Lane& lane = lanes.of[i];
      const Node& node = binary_[lane.node];
      if (lane.primitive >= 0 || node.rightChild >= 0) continue;
      if (node.count + lanes.count - 1 > WideNode::kLanes) continue;
      if (smallest < 0 || node.count < binary_[lanes.of[smallest].node].count) smallest = i;
    }
    if (smallest < 0) return false;
    const std::size_t leaf = lanes.of[smallest].node;
    lanes.of[smallest].primitive = binary_[leaf].first;
    for (int i = 1; i < binary_[leaf].count; ++i) lanes.add(leaf, binary_[leaf].first + i);
    return true;
  }

  const std::vector<Node>& binary_;
  const std::vector<Aabb> bounds_;
  const BoxFitter fitter_;
  std::vector<WideNode> nodes_;
  OrientedBox rootBox_;
};

}  // namespace

OrientedBox WideNode::box(int lane) const {
  OrientedBox box;
  for (int i = 0; i < 3; ++i) {
    box.center[i] = origin[i] + static_cast<double>(center[i][lane]);
    box.half[i] = half[i][lane];
    for (int j = 0; j < 3; ++j) box.axes[j][i] = axes[j][i][lane];
  }
  return box;
}

void WideNode::set(int lane, const OrientedBox& box) {
  double size = 0.0;
  for (int i = 0; i < 3; ++i) {
    center[i][lane] = static_cast<float>(box.center[i] - origin[i]);
    half[i][lane] = box.half[i];
    for (int j = 0; j < 3; ++j) axes[j][i][lane] = box.axes[j][i];
    size += std::abs(box.center[i] - origin[i]) + box.half[i];
  }
  reach = std::max(reach, roundedUp(size));
}

WideBvh::WideBvh(const TreeTopology& binary, const PrimitivePoints& primitives) {
  Collapse collapse(binary, primitives);
  nodes_ = collapse.takeNodes();
  bounds_ = collapse.bounds();
  rootBox_ = collapse.rootBox();
  for (int i = 0; i < 3; ++i) {
    reach_ += std::max(std::abs(bounds_.lower[i]), std::abs(bounds_.upper[i]));
  }
}

}  // namespace swept::detail
