// SPDX-License-Identifier: BSD-3-Clause
#include "cover/shape_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include "bv/principal_axes.hpp"
#include "cover/convex_field.hpp"
#include "cover/stopping.hpp"
#include "geometry/small_ball.hpp"
#include "swept/core/distance.hpp"

namespace swept::detail {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr std::size_t kNeighbours = 8;
/// Relative to the largest coordinate: more than single precision takes from sizes, places and
/// rotations, five roundings of 6e-8.
constexpr double kSingle = 1e-6;
/// Relative to the size of the body: corners of hulls that are nearer to the rest are left out.
constexpr double kSimpler = 2e-4;
constexpr int kMostPieces = 1200;
constexpr double kBoxCost = 0.02;  // of joining two nodes, per diagonal of their box

Isometry3d poseOf(const Matrix3d& rotation, const Vector3d& place) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear() = rotation;
  pose.translation() = place;
  return pose;
}

PosedShape boxAround(std::span<const Vector3d> points, const Matrix3d& axes) {
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : points) box.extend(Vector3d(axes.transpose() * point));
  return {Box{0.5 * box.sizes()}, poseOf(axes, axes * box.center())};
}

/// About the third axis: the smallest circle across it, then the shortest segment.
PosedShape capsuleAround(std::span<const Vector3d> points, const Matrix3d& axes) {
  std::vector<Vector3d> flat;
  flat.reserve(points.size());
  for (const Vector3d& point : points) {
    flat.emplace_back(axes.transpose() * point);
    flat.back().z() = 0.0;
  }
  const BoundingSphere circle = smallBall(flat);
  double lower = std::numeric_limits<double>::infinity();
  double upper = -lower;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double across = (flat[i] - circle.center).norm();
    const double room = std::sqrt(std::max(0.0, circle.radius * circle.radius - across * across));
    const double z = axes.col(2).dot(points[i]);
    lower = std::min(lower, z + room);
    upper = std::max(upper, z - room);
  }
  if (lower > upper) lower = upper = 0.5 * (lower + upper);
  const Vector3d middle(circle.center.x(), circle.center.y(), 0.5 * (lower + upper));
  double radius = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double z = axes.col(2).dot(points[i]);
    const double beyond = z - std::clamp(z, lower, upper);
    radius = std::max(radius, std::hypot((flat[i] - circle.center).norm(), beyond));
  }
  return {Capsule{radius, 0.5 * (upper - lower)}, poseOf(axes, axes * middle)};
}

/// m^3, of the shape grown by `least` (m): flat shapes differ, too.
double volumeOf(const Shape& shape, double least) {
  if (const auto* box = std::get_if<Box>(&shape))
    return 8.0 * (box->halfExtents.array() + least).prod();
  const Capsule& capsule = std::get<Capsule>(shape);
  const double radius = capsule.radius + least;
  return std::numbers::pi * radius * radius * (2.0 * capsule.halfLength + 4.0 / 3.0 * radius);
}

PosedShape grown(PosedShape posed, double by) {
  if (auto* box = std::get_if<Box>(&posed.shape))
    box->halfExtents.array() += by;
  else if (auto* capsule = std::get_if<Capsule>(&posed.shape))
    capsule->radius += by;
  return posed;
}

/// The axes that give the least volume: the best of those given, turned a little at a time.
PosedShape bestAround(std::span<const Vector3d> points, EnclosingKind kind,
                      std::span<const Matrix3d> frames, double least, bool turns) {
  const auto around = [&](const Matrix3d& axes) {
    return kind == EnclosingKind::Box ? boxAround(points, axes) : capsuleAround(points, axes);
  };
  PosedShape best;
  double volume = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Matrix3d& axes) {
    PosedShape shape = around(axes);
    const double own = volumeOf(shape.shape, least);
    if (!(own < (1.0 - 1e-9) * volume)) return false;
    volume = own;
    best = std::move(shape);
    return true;
  };
  for (const Matrix3d& axes : frames) {
    consider(axes);
    if (kind == EnclosingKind::Box) continue;
    for (int k = 0; k < 2; ++k) {
      Matrix3d other;
      other << axes.col((k + 1) % 3), axes.col((k + 2) % 3), axes.col(k);
      consider(other);
    }
  }
  if (!turns) return best;
  constexpr int kMostTurns = 60;
  int tries = 0;
  for (double angle = 0.3; angle > 0.01;) {
    bool isBetter = false;
    for (int k = 0; k < 6 && !isBetter && tries < kMostTurns; ++k, ++tries)
      isBetter = consider(best.body_from_shape.linear() *
                          Eigen::AngleAxisd(k < 3 ? angle : -angle, Vector3d::Unit(k % 3)));
    if (!isBetter) angle *= 0.4;
    if (tries >= kMostTurns) break;
  }
  return best;
}

Matrix3d axesOf(std::span<const Vector3d> points) {
  Matrix3d axes = principalAxes(scatterOf(points));
  if (axes.determinant() < 0.0) axes.col(2) = -axes.col(2);
  return axes;
}

/// Places spread over a shape's surface.
std::vector<Vector3d> samplesOf(const PosedShape& posed) {
  std::vector<Vector3d> samples;
  const auto add = [&](const Vector3d& at) { samples.push_back(posed.body_from_shape * at); };
  if (const auto* box = std::get_if<Box>(&posed.shape)) {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z)
          if (x != 0 || y != 0 || z != 0) add(box->halfExtents.cwiseProduct(Vector3d(x, y, z)));
  } else if (const auto* capsule = std::get_if<Capsule>(&posed.shape)) {
    const double h = capsule->halfLength;
    const double r = capsule->radius;
    for (int k = 0; k < 8; ++k) {
      const double angle = std::numbers::pi / 4.0 * k;
      const Vector3d side(std::cos(angle), std::sin(angle), 0.0);
      for (const double z : {-1.0, -0.5, 0.0, 0.5, 1.0}) add(r * side + Vector3d(0.0, 0.0, z * h));
      for (const double end : {-1.0, 1.0})
        add(0.70710678 * r * side + Vector3d(0.0, 0.0, end * (h + 0.70710678 * r)));
    }
    for (const double end : {-1.0, 1.0}) add({0.0, 0.0, end * (h + r)});
  } else if (const auto* hull = std::get_if<ConvexHull>(&posed.shape)) {
    // The largest faces are those that may span a hollow.
    constexpr std::size_t kMostFaces = 40;
    std::vector<std::pair<double, std::size_t>> faces;
    const auto corner = [&](std::size_t face, int k) -> const Vector3d& {
      return hull->vertices()[static_cast<std::size_t>(hull->faces()[face][k])];
    };
    for (std::size_t i = 0; i < hull->faces().size(); ++i)
      faces.emplace_back(-(corner(i, 1) - corner(i, 0)).cross(corner(i, 2) - corner(i, 0)).norm(),
                         i);
    std::ranges::sort(faces);
    if (faces.size() > kMostFaces) faces.resize(kMostFaces);
    for (const auto& [area, i] : faces) {
      add((corner(i, 0) + corner(i, 1) + corner(i, 2)) / 3.0);
      for (int k = 0; k < 3; ++k) add(0.5 * (corner(i, k) + corner(i, (k + 1) % 3)));
    }
  }
  return samples;
}

std::vector<Vector3d> cubesAround(std::span<const Vector3d> points, double half) {
  std::vector<Vector3d> corners;
  for (const Vector3d& point : points)
    for (int k = 0; k < 8; ++k)
      corners.emplace_back(point + half * Vector3d((k & 1) != 0 ? 1.0 : -1.0,
                                                   (k & 2) != 0 ? 1.0 : -1.0,
                                                   (k & 4) != 0 ? 1.0 : -1.0));
  return corners;
}

/// A ball in the hull of points: within a tetrahedron of far corners.
struct InnerBall {
  Vector3d center = Vector3d::Zero();  ///< m
  double radius = 0.0;                 ///< m, proven
};

InnerBall innerBall(std::span<const Vector3d> points) {
  const auto farthest = [&](const auto& measure) {
    return *std::ranges::max_element(points, {}, measure);
  };
  const Vector3d a = farthest([&](const Vector3d& p) { return (p - points.front()).norm(); });
  const Vector3d b = farthest([&](const Vector3d& p) { return (p - a).norm(); });
  const Vector3d c = farthest([&](const Vector3d& p) { return (p - a).cross(b - a).norm(); });
  const Vector3d across = (b - a).cross(c - a);
  const Vector3d d = farthest([&](const Vector3d& p) { return std::abs((p - a).dot(across)); });
  const double volume = std::abs((d - a).dot(across));  // six times
  const double largest = std::max({across.norm(), (b - a).cross(d - a).norm(),
                                   (c - a).cross(d - a).norm(), (c - b).cross(d - b).norm()});
  // The heights are volume / area, with twice the area of a side; the centroid is at a quarter.
  // Where rounding could matter the ball is small, and nothing is scaled about it.
  if (!(volume > 1e-6 * largest * (b - a).norm())) return {};
  return {0.25 * (a + b + c + d), 0.249 * volume / largest};
}

/// Points whose hull contains the unit ball.
const std::vector<Vector3d>& pointsAroundBall() {
  static const std::vector<Vector3d> kPoints = [] {
    constexpr int kCount = 50;
    std::vector<Vector3d> points;
    for (int i = 0; i < kCount; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / kCount;
      const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
      const double across = std::sqrt(1.0 - z * z);
      points.emplace_back(across * std::cos(angle), across * std::sin(angle), z);
    }
    // All faces are at least this far from the middle.
    const double inner = -ConvexField(PosedShape{ConvexHull::of(points)}).value(Vector3d::Zero());
    for (Vector3d& point : points) point *= 1.000001 / inner;
    return points;
  }();
  return kPoints;
}

/// m, an upper bound.
double distanceFrom(const ConvexHull& hull, const Vector3d& point) {
  return distance(hull, Sphere{0.0}, Isometry3d(Eigen::Translation3d(point))).upper;
}

/// Few of the points, whose hull contains all of them if it is grown by `error` (m).
struct FewPoints {
  std::vector<Vector3d> points;
  double error = 0.0;
};

/// The point farthest from the hull of those taken is the next, until it is within `tolerance` (m).
FewPoints fewOf(std::span<const Vector3d> points, double tolerance) {
  FewPoints few;
  for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1)})
    for (const double sign : {1.0, -1.0}) {
      const auto most = std::ranges::max_element(
          points, {}, [&](const Vector3d& p) { return sign * axis.dot(p); });
      if (std::ranges::find(few.points, *most) == few.points.end()) few.points.push_back(*most);
    }
  // A larger hull is no farther: old distances bound new ones.
  std::vector<double> distances(points.size(), std::numeric_limits<double>::infinity());
  while (few.points.size() < points.size()) {
    const ConvexHull hull = ConvexHull::of(few.points);
    std::vector<bool> isNew(points.size(), false);
    std::size_t most = 0;
    for (;;) {
      most = static_cast<std::size_t>(std::ranges::max_element(distances) - distances.begin());
      if (isNew[most]) break;
      isNew[most] = true;
      distances[most] = std::min(distances[most], distanceFrom(hull, points[most]));
    }
    if (distances[most] <= tolerance) break;
    if (std::ranges::find(few.points, points[most]) != few.points.end()) break;
    few.points.push_back(points[most]);
  }
  // The first ones may be in the middle of what came later.
  for (std::size_t i = 0; i < few.points.size() && few.points.size() > 1;) {
    const Vector3d point = few.points[i];
    few.points.erase(few.points.begin() + static_cast<std::ptrdiff_t>(i));
    if (distanceFrom(ConvexHull::of(few.points), point) <= tolerance) continue;
    few.points.insert(few.points.begin() + static_cast<std::ptrdiff_t>(i), point);
    ++i;
  }
  const ConvexHull hull = ConvexHull::of(few.points);
  for (const Vector3d& point : points)
    few.error = std::max(few.error, distanceFrom(hull, point) + hull.error());
  return few;
}

/// A hull that contains the points with balls of radius `pad` (m) around them.
///
/// Lemma: let a ball of radius r about c be in a hull. Then the hull scaled by 1 + e about c
/// contains the hull grown by r e / (1 + e): for a corner v, the ball of this radius about v is in
/// the hull of the ball about c and the corner that v becomes, by the similarity about the latter
/// that takes c to v.
///
/// Flat ones become the hull of a cube around each point, which contains a ball around it.
PosedShape hullAround(std::span<const Vector3d> points, double pad, double tolerance) {
  constexpr double kMostGrowth = 0.02;
  const FewPoints few = fewOf(points, tolerance);
  const ConvexHull hull = ConvexHull::of(few.points);
  const InnerBall inner = innerBall(hull.vertices());
  const double by = few.error + hull.error() + pad;
  if (by < kMostGrowth * inner.radius) {
    const double growth = 1.001 * by / (inner.radius - by);
    return {ConvexHull::scaled(hull, 1.0 + growth, inner.center)};
  }
  // The error of the last hull is no more than that of the first, up to the size of the cubes.
  return {ConvexHull::of(cubesAround(few.points, 1.5 * by + 2.0 * hull.error()))};
}

}  // namespace

ShapeFit::ShapeFit(std::span<const PosedShape> body, EnclosingKind kind,
                   const EnclosingShapesOptions& options, const StopQuestion& stop)
    : source_(body.begin(), body.end()), kind_(kind), stop_(stop), body_(body) {
  divide(options.pieces);
  findFrames(body);
  agglomerate();
}

/// The largest piece first.
void ShapeFit::divide(int count) {
  const auto less = [](const BodyPiece& a, const BodyPiece& b) { return a.reach < b.reach; };
  std::vector<BodyPiece> open = body_.pieces();
  for (const BodyPiece& piece : open)
    size_ = std::max(size_, piece.reach + (piece.middle - open.front().middle).norm());
  std::ranges::make_heap(open, less);
  std::vector<BodyPiece> halves;
  while (!open.empty() && static_cast<int>(open.size() + pieces_.size()) < count) {
    throwIfStopped(stop_);
    std::ranges::pop_heap(open, less);
    BodyPiece top = std::move(open.back());
    open.pop_back();
    if (!body_.canSplit(top) || top.reach < 1e-3 * size_ || top.reach <= 1.001 * top.blur) {
      pieces_.push_back(std::move(top));
      continue;
    }
    halves.clear();
    body_.split(top, halves);
    for (BodyPiece& half : halves) {
      open.push_back(std::move(half));
      std::ranges::push_heap(open, less);
    }
  }
  for (BodyPiece& piece : open) pieces_.push_back(std::move(piece));
}

void ShapeFit::findFrames(std::span<const PosedShape> body) {
  constexpr std::size_t kMostFrames = 4;
  frames_.emplace_back(Matrix3d::Identity());
  for (std::size_t i = 0; i < body.size() && frames_.size() < kMostFrames; ++i) {
    const Matrix3d& axes = body_.pose(i).linear();
    const auto isSame = [&](const Matrix3d& other) { return (axes - other).norm() < 1e-6; };
    if (std::ranges::none_of(frames_, isSame)) frames_.push_back(axes);
  }
}

/// Adds points whose hull, grown by what is returned (m), contains the piece: of a round piece,
/// those of a polyhedron around each ball.
double ShapeFit::addPoints(const BodyPiece& piece, std::vector<Vector3d>& points) const {
  if (piece.blur <= kSimpler * size_) {
    points.insert(points.end(), piece.content.begin(), piece.content.end());
    return piece.blur;
  }
  for (const Vector3d& center : piece.content)
    for (const Vector3d& around : pointsAroundBall())
      points.emplace_back(center + piece.blur * around);
  return 0.0;
}

ShapeFit::Node ShapeFit::leafOf(const BodyPiece& piece) const {
  throwIfStopped(stop_);
  Node node;
  node.pieces = {&piece};
  std::vector<Vector3d> points;
  node.blur = addPoints(piece, points);
  fit(node, ConvexHull::of(points));
  return node;
}

ShapeFit::Node ShapeFit::joinOf(int a, int b) const {
  throwIfStopped(stop_);
  const Node& left = nodes_[static_cast<std::size_t>(a)];
  const Node& right = nodes_[static_cast<std::size_t>(b)];
  Node node;
  node.left = a;
  node.right = b;
  std::vector<Vector3d> points = left.points;
  points.insert(points.end(), right.points.begin(), right.points.end());
  node.blur = std::max(left.blur, right.blur);
  fit(node, ConvexHull::of(points));
  return node;
}

/// For the tree: what contains the points nearly, and how far it reaches.
void ShapeFit::fit(Node& node, const ConvexHull& hull) const {
  node.points = hull.vertices();
  for (const Vector3d& point : node.points) node.box.extend(point);
  if (kind_ == EnclosingKind::Convex) {
    node.shape = {hull};
  } else {
    std::vector<Matrix3d> frames = frames_;
    frames.push_back(axesOf(node.points));
    if (node.left >= 0)
      for (const int part : {node.left, node.right})
        frames.emplace_back(nodes_[static_cast<std::size_t>(part)].shape.body_from_shape.linear());
    node.shape =
        grown(bestAround(node.points, kind_, frames, 1e-3 * size_, node.left >= 0), node.blur);
  }
  node.reach = reachOf(node.shape);
}

double ShapeFit::reachOf(const PosedShape& shape) const {
  double most = 0.0;
  for (const Vector3d& point : samplesOf(shape)) most = std::max(most, -body_.depth(point, true));
  return most;
}

std::vector<int> ShapeFit::neighboursOf(int node) const {
  const Node& own = nodes_[static_cast<std::size_t>(node)];
  std::vector<std::tuple<double, double, int>> near;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Node& other = nodes_[i];
    if (other.joined || static_cast<int>(i) == node) continue;
    near.emplace_back(own.box.exteriorDistance(other.box),
                      (own.box.center() - other.box.center()).norm(), static_cast<int>(i));
  }
  std::ranges::sort(near);
  if (near.size() > kNeighbours) near.resize(kNeighbours);
  std::vector<int> nodes;
  for (const auto& [gap, distance, index] : near) nodes.push_back(index);
  return nodes;
}

/// Of two pairs that reach equally far, the one with the smaller box is joined first. The
/// shape of a pair is looked for only when its box alone costs less than all other pairs: of most
/// pairs, one is joined to another by then.
void ShapeFit::agglomerate() {
  for (const BodyPiece& piece : pieces_) nodes_.push_back(leafOf(piece));
  struct Pair {
    double cost;
    int a, b;
    std::shared_ptr<Node> joint;  ///< null: the cost is at least this
    bool operator<(const Pair& other) const {
      return std::tie(other.cost, other.a, other.b) < std::tie(cost, a, b);
    }
  };
  std::priority_queue<Pair> pairs;
  const auto push = [&](int a, int b) {
    const Eigen::AlignedBox3d box =
        nodes_[static_cast<std::size_t>(a)].box.merged(nodes_[static_cast<std::size_t>(b)].box);
    // The hull of both may lack corners by its error.
    pairs.push({0.999 * kBoxCost * box.diagonal().norm(), a, b, nullptr});
  };
  for (std::size_t i = 0; i < nodes_.size(); ++i)
    for (const int j : neighboursOf(static_cast<int>(i)))
      if (j > static_cast<int>(i)) push(static_cast<int>(i), j);
  std::size_t left = nodes_.size();
  while (left > 1) {
    if (pairs.empty()) {
      for (std::size_t i = 0; i < nodes_.size(); ++i)
        if (!nodes_[i].joined)
          for (const int j : neighboursOf(static_cast<int>(i))) push(static_cast<int>(i), j);
    }
    Pair pair = pairs.top();
    pairs.pop();
    Node& a = nodes_[static_cast<std::size_t>(pair.a)];
    Node& b = nodes_[static_cast<std::size_t>(pair.b)];
    if (a.joined || b.joined) continue;
    if (pair.joint == nullptr) {
      pair.joint = std::make_shared<Node>(joinOf(pair.a, pair.b));
      pair.cost = pair.joint->reach + kBoxCost * pair.joint->box.diagonal().norm();
      pairs.push(std::move(pair));
      continue;
    }
    Node joint = std::move(*pair.joint);
    joint.pieces = a.pieces;
    joint.pieces.insert(joint.pieces.end(), b.pieces.begin(), b.pieces.end());
    a.joined = b.joined = true;
    nodes_.push_back(std::move(joint));
    --left;
    const auto index = static_cast<int>(nodes_.size()) - 1;
    for (const int j : neighboursOf(index)) push(j, index);
  }
}

std::vector<int> ShapeFit::cut(double reach) const {
  std::vector<int> nodes;
  std::vector<int> pending{static_cast<int>(nodes_.size()) - 1};
  while (!pending.empty()) {
    const int index = pending.back();
    pending.pop_back();
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (node.reach <= reach || node.left < 0) {
      nodes.push_back(index);
    } else {
      pending.push_back(node.right);
      pending.push_back(node.left);
    }
  }
  return nodes;
}

/// The number of shapes falls as the reach grows, and changes at the reaches of nodes alone.
double ShapeFit::reachFor(int count) const {
  std::vector<double> reaches;
  for (const Node& node : nodes_) reaches.push_back(node.reach);
  std::ranges::sort(reaches);
  const auto isFew = [&](double reach) { return countFor(reach) <= count; };
  const auto found = std::ranges::partition_point(reaches, [&](double r) { return !isFew(r); });
  return found == reaches.end() ? reaches.back() : *found;
}

EnclosingShapes ShapeFit::atMost(int count, const StopQuestion& stop) {
  stop_ = stop;
  return finished(cut(reachFor(count)));
}

/// Samples miss some of what reaches farthest, so less is aimed at until the proven bound is met.
EnclosingShapes ShapeFit::within(double reach, const StopQuestion& stop) {
  stop_ = stop;
  constexpr int kMostTries = 8;
  EnclosingShapes found;
  double aim = reach;
  std::size_t before = 0;
  for (int tries = 0; tries < kMostTries; ++tries, aim *= 0.85) {
    std::vector<int> nodes = cut(aim);
    const auto isTooLarge = [&](int index) {
      const Node& node = nodes_[static_cast<std::size_t>(index)];
      return node.left < 0 && node.reach > aim;
    };
    while (std::ranges::any_of(nodes, isTooLarge) &&
           static_cast<int>(pieces_.size()) < kMostPieces && divideFurther())
      nodes = cut(aim);
    if (nodes.size() == before) continue;
    before = nodes.size();
    found = finished(nodes);
    const SphereExcess excess =
        shapesExcess(source_, found.shapes, 0.0, {.samples = 1, .tolerance = 0.01, .stop = stop});
    if (excess.largest <= reach) break;
  }
  return found;
}

/// Twice as many pieces, and another tree. False if they cannot be divided.
bool ShapeFit::divideFurther() {
  const std::size_t count = pieces_.size();
  pieces_.clear();
  nodes_.clear();
  divide(static_cast<int>(2 * count));
  agglomerate();
  return pieces_.size() > count;
}

/// Measured by all points of all pieces, and a little larger.
ShapeFit::Shaped ShapeFit::measured(const Matrix3d& axes, Pieces pieces) const {
  throwIfStopped(stop_);
  constexpr int kMostTries = 4;
  std::vector<Vector3d> points;
  double blur = 0.0;
  double farthest = 0.0;
  for (const BodyPiece* piece : pieces) blur = std::max(blur, addPoints(*piece, points));
  for (const Vector3d& point : points) farthest = std::max(farthest, point.norm());
  double pad = blur + kSingle * (farthest + blur);
  const ConvexHull hull = ConvexHull::of(points);
  if (kind_ == EnclosingKind::Convex) {
    // A hull with faces that rounding does not tell apart contains its pieces all the same; but
    // nobody could see that. Fewer corners are farther apart.
    double tolerance = kSimpler * size_;
    PosedShape shape = hullAround(hull.vertices(), pad + hull.error(), tolerance);
    for (int tries = 0; tries < kMostTries && !ConvexField(shape).hasInside(); ++tries) {
      tolerance *= 3.0;
      shape = hullAround(hull.vertices(), pad + hull.error(), tolerance);
    }
    const double reach = reachOf(shape);
    return {std::move(shape), std::move(pieces), reach};
  }
  std::vector<Matrix3d> frames = frames_;
  frames.push_back(axes);
  frames.push_back(axesOf(points));
  const PosedShape best = bestAround(hull.vertices(), kind_, frames, 1e-3 * size_, true);
  const auto outside = [&](const PosedShape& shape) {
    const ConvexField field(shape);
    double most = -std::numeric_limits<double>::infinity();
    for (const BodyPiece* piece : pieces) most = std::max(most, field.over(*piece));
    return most;
  };
  // Corners that the hull leaves out, and rounding, may need more.
  for (int tries = 0; tries < kMostTries; ++tries, pad *= 10.0) {
    PosedShape shape = grown(best, pad);
    if (outside(shape) > 0.0) continue;
    const double reach = reachOf(shape);
    return {std::move(shape), std::move(pieces), reach};
  }
  PosedShape roomy = roomyAround(pieces);
  const double reach = reachOf(roomy);
  return {std::move(roomy), std::move(pieces), reach};
}

/// About the middle of the pieces, with the radius that they need.
PosedShape ShapeFit::roomyAround(const Pieces& pieces) const {
  Eigen::AlignedBox3d box;
  for (const BodyPiece* piece : pieces) box.extend(piece->middle);
  double radius = 0.0;
  for (const BodyPiece* piece : pieces) radius = std::max(radius, piece->farthest(box.center()));
  radius = 1.000001 * radius + kSingle * size_;
  const Isometry3d pose = poseOf(Matrix3d::Identity(), box.center());
  if (kind_ == EnclosingKind::Capsule) return {Capsule{radius, 0.0}, pose};
  return {Box{Vector3d::Constant(radius)}, pose};
}

/// Gives pieces, or parts of them, to other shapes that contain them.
bool ShapeFit::shrink(Shaped& shaped, std::vector<Shaped>& all, std::deque<BodyPiece>& divided) {
  const double least = std::max(0.2 * shaped.reach, 5e-3 * size_);
  std::vector<std::pair<const Shaped*, ConvexField>> others;
  for (const Shaped& other : all)
    if (&other != &shaped) others.emplace_back(&other, ConvexField(other.shape));
  const ConvexField own(shaped.shape);
  Pieces pending = shaped.pieces;
  Pieces kept;
  std::vector<std::pair<const Shaped*, const BodyPiece*>> given;
  std::vector<BodyPiece> halves;
  while (!pending.empty()) {
    throwIfStopped(stop_);
    const BodyPiece& piece = *pending.back();
    pending.pop_back();
    const auto contains = [&](const auto& other) { return other.second.over(piece) <= 0.0; };
    const auto touches = [&](const auto& other) {
      return other.second.value(piece.middle) < 0.5 * piece.reach;
    };
    if (const auto other = std::ranges::find_if(others, contains); other != others.end()) {
      given.emplace_back(other->first, &piece);
    } else if (piece.reach > least && body_.canSplit(piece) &&
               own.value(piece.middle) > -1.5 * piece.reach &&
               std::ranges::any_of(others, touches)) {
      halves.clear();
      body_.split(piece, halves);
      for (BodyPiece& half : halves) {
        divided.push_back(std::move(half));
        pending.push_back(&divided.back());
      }
    } else {
      kept.push_back(&piece);
    }
  }
  if (given.empty()) return false;
  Shaped less = kept.empty() ? Shaped{shaped.shape, {}, 0.0}
                             : measured(shaped.shape.body_from_shape.linear(), kept);
  if (!kept.empty() && !(less.reach < shaped.reach)) return false;
  for (const auto& [other, piece] : given)
    all[static_cast<std::size_t>(other - all.data())].pieces.push_back(piece);
  shaped = std::move(less);
  return true;
}

EnclosingShapes ShapeFit::finished(const std::vector<int>& nodes) {
  constexpr int kPasses = 2;
  std::deque<BodyPiece> divided;  // as long as the shapes have their pieces
  std::vector<Shaped> all;
  for (const int index : nodes) {
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    all.push_back(measured(node.shape.body_from_shape.linear(), node.pieces));
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    std::ranges::stable_sort(all, std::ranges::greater{}, &Shaped::reach);
    bool isChanged = false;
    for (Shaped& shaped : all) isChanged = shrink(shaped, all, divided) || isChanged;
    std::erase_if(all, [](const Shaped& shaped) { return shaped.pieces.empty(); });
    if (!isChanged) break;
  }
  EnclosingShapes found;
  for (Shaped& shaped : all) {
    found.reach = std::max(found.reach, shaped.reach);
    found.shapes.push_back(std::move(shaped.shape));
  }
  return found;
}

}  // namespace swept::detail
