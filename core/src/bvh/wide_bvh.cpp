// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/wide_bvh.hpp"

#include <cmath>
#include <limits>

#include "bv/extents.hpp"
#include "bv/principal_axes.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Tree = BvTree<Aabb>;

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

/// Fits boxes to runs of primitives.
class BoxFitter {
 public:
  BoxFitter(const PrimitivePoints& primitives, const Vector3d& middle)
      : primitives_(primitives), middle_(middle) {}

  Moments moments(int primitive) const {
    Moments moments;
    for (const Vector3d& p : pointsOf(primitive, 1)) {
      const Vector3d d = p - middle_;
      moments.count += 1.0;
      moments.sum += d;
      moments.outer += d * d.transpose();
    }
    return moments;
  }

  /// The box of the primitives below a node, along their principal axes or those of the frame,
  /// whichever has the smaller surface. Its centre is a float from `origin`.
  OrientedBox fit(const Tree::Node& node, const Moments& moments, const Vector3d& origin) const {
    const std::span<const Vector3d> points = pointsOf(node.first, node.count);
    double radius = 0.0;
    if (!primitives_.radii.empty()) {
      for (int i = node.first; i < node.first + node.count; ++i)
        radius = std::max(radius, primitives_.radii[static_cast<std::size_t>(i)]);
    }
    const Aabb& bounds = node.volume;
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
    if (surface(box) > area(bounds)) {
      box = along(Matrix3d::Identity(), points, radius, origin, far.sum());
    }
    return box;
  }

 private:
  std::span<const Vector3d> pointsOf(int first, int count) const {
    const std::size_t per = primitives_.perPrimitive;
    return primitives_.points.subspan(static_cast<std::size_t>(first) * per,
                                      static_cast<std::size_t>(count) * per);
  }

  static double surface(const OrientedBox& box) {
    return 4.0 * (static_cast<double>(box.half[0]) * box.half[1] +
                  static_cast<double>(box.half[1]) * box.half[2] +
                  static_cast<double>(box.half[2]) * box.half[0]);
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
  Collapse(const Tree& binary, const PrimitivePoints& primitives)
      : binary_(binary), fitter_(primitives, binary.node(0).volume.center()) {
    nodes_.reserve(binary.order().size() / 4 + 1);
  }

  std::vector<WideNode> run(OrientedBox& rootBox) {
    const Moments moments = addNode(0);
    rootBox = fitter_.fit(binary_.node(0), moments, binary_.node(0).volume.center());
    return std::move(nodes_);
  }

 private:
  using Lanes = std::array<int, WideNode::kLanes>;  ///< nodes of the binary tree

  Moments addNode(int root) {
    Lanes lanes;
    int count = 0;
    lanes[count++] = root;
    while (count < WideNode::kLanes && expandLargest(lanes, count)) {
    }
    while (absorbSmallest(lanes, count)) {
    }
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    WideNode node{};
    node.count = count;
    node.origin = binary_.node(root).volume.center();
    Moments all;
    for (int i = 0; i < count; ++i) {
      const Tree::Node& from = binary_.node(lanes[i]);
      node.child[i] = from.isLeaf() ? ~from.first : static_cast<int>(nodes_.size());
      const Moments moments = from.isLeaf() ? fitter_.moments(from.first) : addNode(lanes[i]);
      node.set(i, fitter_.fit(from, moments, node.origin));
      all.add(moments);
    }
    nodes_[index] = node;
    return all;
  }

  /// Replaces the lane of the largest box by its two children. Those that will fit into one node
  /// stay: split up, they would leave many nodes nearly empty.
  bool expandLargest(Lanes& lanes, int& count) const {
    int largest = -1;
    for (int i = 0; i < count; ++i) {
      const Tree::Node& node = binary_.node(lanes[i]);
      if (node.count <= WideNode::kLanes && count > 1) continue;
      if (node.isLeaf()) continue;
      if (largest < 0 || area(node.volume) > area(binary_.node(lanes[largest]).volume)) largest = i;
    }
    if (largest < 0) return false;
    expand(lanes, count, largest);
    return true;
  }

  /// Replaces the lane with the fewest primitives by all of these, if there is room.
  bool absorbSmallest(Lanes& lanes, int& count) const {
    int smallest = -1;
    for (int i = 0; i < count; ++i) {
      const Tree::Node& node = binary_.node(lanes[i]);
      if (node.isLeaf() || node.count + count - 1 > WideNode::kLanes) continue;
      if (smallest < 0 || node.count < binary_.node(lanes[smallest]).count) smallest = i;
    }
    if (smallest < 0) return false;
    expand(lanes, count, smallest);
    return true;
  }

  void expand(Lanes& lanes, int& count, int lane) const {
    const int parent = lanes[lane];
    lanes[lane] = parent + 1;
    lanes[count++] = binary_.node(parent).rightChild;
  }

  const Tree& binary_;
  const BoxFitter fitter_;
  std::vector<WideNode> nodes_;
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

WideBvh::WideBvh(const Tree& binary, const PrimitivePoints& primitives)
    : bounds_(binary.node(0).volume) {
  for (int i = 0; i < 3; ++i) {
    reach_ += std::max(std::abs(bounds_.lower[i]), std::abs(bounds_.upper[i]));
  }
  nodes_ = Collapse(binary, primitives).run(rootBox_);
}

}  // namespace swept::detail
