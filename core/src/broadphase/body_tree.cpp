// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/broadphase/body_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>

#include "broadphase/world_box.hpp"
#include "bv/box_pair.hpp"
#include "geometry/error_model.hpp"
#include "geometry/nearest_rotation.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kBins = 16;
/// Cuts by area may be lopsided at every level; below this depth halving bounds the depth by 64 for
/// 2^30 bodies, and with it the recursion.
constexpr int kDepthOfHalving = 32;

Aabb nothing() {
  return {Vector3d::Constant(kInfinity), Vector3d::Constant(-kInfinity)};
}

void include(Aabb& box, const Aabb& other) {
  box.lower = box.lower.cwiseMin(other.lower);
  box.upper = box.upper.cwiseMax(other.upper);
}

double halfArea(const Aabb& box) {
  const Vector3d size = box.upper - box.lower;
  return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
}

/// m. Proven lower bound of the distance of two boxes. Differences round by half an epsilon each,
/// and hypot by a few; the last term covers what underflows.
double gap(const Aabb& a, const Aabb& b) {
  const Vector3d apart = (a.lower - b.upper).cwiseMax(b.lower - a.upper).cwiseMax(Vector3d::Zero());
  const double length = std::hypot(apart.x(), apart.y(), apart.z());
  const double bound = length * detail::kDistanceShrink - std::numeric_limits<double>::min();
  return bound > 0.0 ? bound : 0.0;  // NaN gives 0: nothing is proven
}

Isometry3d relative(const Isometry3d& world_from_a, const Isometry3d& world_from_b) {
  Isometry3d a_from_b = Isometry3d::Identity();
  const Eigen::Matrix3d a_from_world = world_from_a.linear().transpose();
  a_from_b.linear().noalias() = a_from_world * world_from_b.linear();
  a_from_b.translation().noalias() =
      a_from_world * (world_from_b.translation() - world_from_a.translation());
  return a_from_b;
}

/// m. Upper bound on the distance of the shape's points from its origin; constant time, unlike the
/// ball of a mesh.
double extentOf(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
    return mesh->hull().extent() + mesh->hull().error();
  if (const auto* hull = std::get_if<ConvexHull>(&shape)) return hull->extent() + hull->error();
  if (const auto* cloud = std::get_if<PointCloud>(&shape))
    return cloud->hull().extent() + cloud->hull().error() + cloud->largestRadius();
  const BoundingSphere ball = boundingSphere(shape);
  return ball.center.norm() + ball.radius;
}

}  // namespace

/// Reorders a list of bodies into the tree's order and writes the nodes.
class BodyTree::Builder {
 public:
  Builder(std::vector<Node>& nodes, std::span<const Aabb> boxes, std::span<int> order)
      : nodes_(nodes), boxes_(boxes) {
    nodes_.reserve(2 * order.size());
    if (!order.empty()) build(order, 1);
  }

 private:
  void build(std::span<int> items, int depth) {
    Aabb box = nothing();
    for (const int item : items) include(box, boxes_[static_cast<std::size_t>(item)]);
    const std::size_t self = nodes_.size();
    nodes_.push_back({box, 0, items.size() == 1 ? items.front() : -1});
    if (items.size() > 1) {
      const std::size_t left = partition(items, depth);
      build(items.first(left), depth + 1);
      build(items.subspan(left), depth + 1);
    }
    nodes_[self].next = nodes_.size();
  }

  double position(int item, int axis) const {
    return boxes_[static_cast<std::size_t>(item)].center()[axis];
  }

  /// Sizes of both parts are at least 1.
  std::size_t partition(std::span<int> items, int depth) {
    Aabb centers = nothing();
    for (const int item : items) {
      const Vector3d center = boxes_[static_cast<std::size_t>(item)].center();
      include(centers, {center, center});
    }
    int axis = 0;
    const double length = (centers.upper - centers.lower).maxCoeff(&axis);
    const double perLength = kBins / length;
    // Equal centres, and extents so small or large that the scale is not a number, are halved.
    if (depth < kDepthOfHalving && length > 0.0 && perLength > 0.0 && perLength < kInfinity) {
      const double start = centers.lower[axis];
      const auto binOf = [&](int item) {
        return std::clamp(static_cast<int>((position(item, axis) - start) * perLength), 0,
                          kBins - 1);
      };
      const int cut = chooseCut(items, binOf);
      if (cut > 0) {
        const auto middle = std::stable_partition(items.begin(), items.end(),
                                                  [&](int item) { return binOf(item) < cut; });
        return static_cast<std::size_t>(middle - items.begin());
      }
    }
    std::sort(items.begin(), items.end(), [&](int a, int b) {
      const double pa = position(a, axis), pb = position(b, axis);
      return pa != pb ? pa < pb : a < b;
    });
    return items.size() / 2;
  }

  /// First bin of the right part; 0 if no cut separates anything.
  template <typename BinOf>
  int chooseCut(std::span<const int> items, const BinOf& binOf) const {
    std::array<Aabb, kBins> boxes;
    boxes.fill(nothing());
    std::array<int, kBins> counts{};
    for (const int item : items) {
      const auto bin = static_cast<std::size_t>(binOf(item));
      include(boxes[bin], boxes_[static_cast<std::size_t>(item)]);
      ++counts[bin];
    }
    std::array<double, kBins> rightCosts{};
    Aabb right = nothing();
    for (std::size_t i = kBins - 1, count = 0; i > 0; --i) {
      include(right, boxes[i]);
      count += static_cast<std::size_t>(counts[i]);
      rightCosts[i] = count == 0 ? 0.0 : static_cast<double>(count) * halfArea(right);
    }
    double best = kInfinity;
    int cut = 0;
    Aabb left = nothing();
    for (std::size_t i = 1, count = 0; i < kBins; ++i) {
      include(left, boxes[i - 1]);
      count += static_cast<std::size_t>(counts[i - 1]);
      if (count == 0 || count == items.size()) continue;
      const double cost = static_cast<double>(count) * halfArea(left) + rightCosts[i];
      if (cost < best) {
        best = cost;
        cut = static_cast<int>(i);
      }
    }
    return cut;
  }

  std::vector<Node>& nodes_;
  std::span<const Aabb> boxes_;
};

BodyTree::BodyTree(std::vector<Body> bodies) : bodies_(std::move(bodies)) {
  if (detail::inForeignEnvironment()) {
    *this = inDefaultEnvironment([&] { return BodyTree(std::move(bodies_)); });
    return;
  }
  constexpr std::size_t kMaxBodies = std::size_t{1} << 30;
  if (bodies_.size() > kMaxBodies) {
    throw std::invalid_argument("tree of " + std::to_string(bodies_.size()) +
                                " bodies; allowed: at most " + std::to_string(kMaxBodies));
  }
  std::vector<Aabb> boxes;
  std::vector<int> order;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Body& body = bodies_[i];
    body.world_from_body = detail::rigidPose(body.world_from_body);
    boxes.push_back(detail::worldBox(body.shape, body.world_from_body, detail::BoxFit::Tight));
    boxes_.push_back(localBox(body.shape));
    extents_.push_back(extentOf(body.shape));
    const Aabb& box = boxes.back();
    const bool finite =
        box.lower.allFinite() && box.upper.allFinite() && body.world_from_body.matrix().allFinite();
    (finite ? order : aside_).push_back(static_cast<int>(i));
  }
  Builder(nodes_, boxes, order);
}

BodyTree::LocalBox BodyTree::localBox(const Shape& shape) {
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return {Vector3d::Zero(), Vector3d::Zero(), sphere->radius};
  if (const auto* capsule = std::get_if<Capsule>(&shape))
    return {Vector3d::Zero(), {0.0, 0.0, capsule->halfLength}, capsule->radius};
  const detail::WideBvh* bvh = nullptr;
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) bvh = &mesh->bvh();
  if (const auto* cloud = std::get_if<PointCloud>(&shape)) bvh = &cloud->bvh();
  if (bvh != nullptr) {
    const detail::TreeBox box = detail::treeBox(*bvh);
    return {box.middle, box.half, 0.0};
  }
  // The rounding of a box's middle and half loses less than the margin of apart().
  const Aabb box = boundingBox(shape);
  return {box.center(), 0.5 * box.upper - 0.5 * box.lower, 0.0};
}

/// True only if one of 15 axes separates the boxes by more than the radii and rounding. Gaps along
/// edge axes are scaled by a length of at most 1, which errs towards false; so does NaN.
bool BodyTree::apart(const LocalBox& a, const LocalBox& b, const Isometry3d& a_from_b) {
  detail::BoxPair pair;
  pair.rotation = a_from_b.linear();
  pair.offset = pair.rotation * b.middle + a_from_b.translation() - a.middle;
  pair.halfA = a.half;
  pair.halfB = b.half;
  const double scale = detail::magnitude(a.middle) + detail::magnitude(b.middle) +
                       detail::magnitude(a.half) + detail::magnitude(b.half) + a.radius + b.radius +
                       detail::magnitude(a_from_b.translation());
  pair.margin = a.radius + b.radius + detail::volumeMargin(scale);
  return detail::separatedByFaces(pair) || detail::separatedByEdges(pair);
}

BodyTree::Hit BodyTree::collides(const Shape& shape, const Isometry3d& given) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return collides(shape, given); });
  }
  const Isometry3d world_from_shape = detail::rigidPose(given);
  Hit result{Contact::Separate, -1};
  const Aabb box = detail::worldBox(shape, world_from_shape, detail::BoxFit::Quick);
  const LocalBox local = localBox(shape);
  forEachOverlap(box, [&](const Body& body) {
    const Isometry3d shape_from_body = relative(world_from_shape, body.world_from_body);
    if (apart(local, boxes_[indexOf(body)], shape_from_body)) return false;
    const Contact contact = collide(shape, body.shape, shape_from_body);
    if (contact == Contact::Separate) return false;
    if (contact == Contact::Touching || result.status == Contact::Separate)
      result = {contact, body.id};
    return contact == Contact::Touching;
  });
  // Without a finite pose nothing is proven, not even for an empty tree.
  if (result.status == Contact::Separate && !world_from_shape.matrix().allFinite())
    result.status = Contact::Unknown;
  return result;
}

/// Lemma: with rotations orthonormal to a few epsilon, the computed pose of b in a differs from the
/// true one by a rotation of at most k and a translation of at most k |t|. Here t is the offset of
/// the origins and k = tolerance::kRoundingPerJoint (90 epsilon, for about 30 operations). A point
/// y of either body, in coordinates from a's origin, thus moves by at most k (|y| + 2 |t|); in
/// coordinates x from b's origin, by at most k (|x| + |t|). The distance changes by no more than
/// the largest movement of a point of one of the two bodies.
void BodyTree::measure(const Body& body, const Shape& shape, double shapeExtent,
                       const Isometry3d& world_from_shape, double tolerance, Nearest& best) const {
  DistanceOptions options;
  options.enough = best.upper;
  options.tolerance = tolerance;
  const Isometry3d shape_from_body = relative(world_from_shape, body.world_from_body);
  const DistanceResult found = distance(shape, body.shape, shape_from_body, options);
  const double reach = std::min(shapeExtent, extents_[indexOf(body)]);
  const double rounding =
      tolerance::kRoundingPerJoint * (reach + 2.0 * shape_from_body.translation().norm());
  const double lower = found.lower - rounding;
  best.lower = std::min(best.lower, lower > 0.0 ? lower : 0.0);
  if (!(found.upper < best.upper)) return;
  best.upper = found.upper;
  best.id = body.id;
  best.pointOfShape = world_from_shape * found.pointA;
  best.pointOfBody = world_from_shape * found.pointB;
}

void BodyTree::descend(std::size_t index, const Aabb& box, const Shape& shape, double shapeExtent,
                       const Isometry3d& world_from_shape, double tolerance, Nearest& best) const {
  const Node& node = nodes_[index];
  if (node.body >= 0) {
    const Body& body = bodies_[static_cast<std::size_t>(node.body)];
    return measure(body, shape, shapeExtent, world_from_shape, tolerance, best);
  }
  const std::size_t left = index + 1, right = nodes_[left].next;
  const double gapLeft = gap(nodes_[left].box, box), gapRight = gap(nodes_[right].box, box);
  const bool leftFirst = gapLeft <= gapRight;
  const std::array<std::pair<std::size_t, double>, 2> children = {
      std::pair{leftFirst ? left : right, leftFirst ? gapLeft : gapRight},
      std::pair{leftFirst ? right : left, leftFirst ? gapRight : gapLeft}};
  for (const auto& [child, bound] : children) {
    // Everything left out is at least as far as the known points: the bound needs no update.
    if (bound >= best.upper || best.upper <= 0.0) continue;
    descend(child, box, shape, shapeExtent, world_from_shape, tolerance, best);
  }
}

BodyTree::Nearest BodyTree::nearest(const Shape& shape, const Isometry3d& given,
                                    double tolerance) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, tolerance] { return nearest(shape, given, tolerance); });
  }
  const Isometry3d world_from_shape = detail::rigidPose(given);
  Nearest best;
  if (!world_from_shape.matrix().allFinite()) return best;
  best.lower = kInfinity;
  const double extent = extentOf(shape);
  for (const int body : aside_) {
    measure(bodies_[static_cast<std::size_t>(body)], shape, extent, world_from_shape, tolerance,
            best);
  }
  if (!nodes_.empty()) {
    const Aabb box = detail::worldBox(shape, world_from_shape, detail::BoxFit::Quick);
    descend(0, box, shape, extent, world_from_shape, tolerance, best);
  }
  best.lower = std::min(best.lower, best.upper);
  return best;
}

}  // namespace swept
