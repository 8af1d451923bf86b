// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

#include "core/error_table_shapes.hpp"
#include "swept/core/tolerances.hpp"

namespace extremes {

using namespace error_table;

namespace {

const Kind& kindOf(Form shape) {
  return kinds()[static_cast<std::size_t>(shape)];
}

/// The same with other points.
struct Rebuilt {
  const Body& body;
  const swept::Shape& shape;

  swept::Shape operator()(const swept::ConvexHull&) const {
    return swept::ConvexHull::of(body.points);
  }
  swept::Shape operator()(const swept::Triangle&) const {
    return swept::Triangle{{body.points[0], body.points[1], body.points[2]}};
  }
  swept::Shape operator()(const swept::TriangleMesh&) const {
    return swept::TriangleMesh::build(body.points, body.surface);
  }
  swept::Shape operator()(const swept::PointCloud&) const {
    return swept::PointCloud::build(body.points, body.radius);
  }
  template <class Other>
  swept::Shape operator()(const Other&) const {
    return shape;
  }
};

bool hasCorners(const swept::Shape& shape) {
  return std::holds_alternative<swept::ConvexHull>(shape) ||
         std::holds_alternative<swept::Triangle>(shape) ||
         std::holds_alternative<swept::TriangleMesh>(shape) ||
         std::holds_alternative<swept::PointCloud>(shape);
}

/// What rounding makes of a body there may be a little dented, but for a triangle.
void move(Solid& solid, const Vector3d& shift) {
  if (!hasCorners(solid.shape)) return;
  Body& body = solid.body;
  body.extent = 0.0;
  for (Vector3d& p : body.points) {
    p += shift;
    body.extent = std::max(body.extent, p.norm() + body.radius);
  }
  solid.shape = std::visit(Rebuilt{body, solid.shape}, swept::Shape(solid.shape));
  if (std::holds_alternative<swept::TriangleMesh>(solid.shape)) body.convex = false;
}

bool isPolytope(const Body& body) {
  return body.core == Body::Core::Points && body.radius == 0.0 && body.faces.size() > 2;
}

Real drawGap(Random& random, const Wanted& wanted) {
  if (wanted.gap > 0.0) return wanted.gap;
  if (random.chance(0.05)) return 0;
  return std::min(wanted.sizeA, wanted.sizeB) * random.decades(-12.0, 1.0);
}

/// The depth of a ball of radius `rolling` is known up to that.
Real drawDepth(Random& random, const Wanted& wanted, double rolling) {
  if (wanted.gap > 0.0) return wanted.gap;
  const double deepest = std::min({wanted.sizeA, wanted.sizeB, 0.95 * rolling});
  return deepest * random.decades(-9.0, 0.0);
}

std::optional<Sample> overlapOf(const Solid& a, const Solid& b, const Wanted& wanted,
                                Random& random) {
  if (!a.body.convex || !b.body.convex) return std::nullopt;
  const Touch touch = drawTouch(a.body, b.body, random);
  const bool flat = a.body.isFlat() || b.body.isFlat();
  if (flat && a.body.isFlat() == b.body.isFlat()) return std::nullopt;
  const double rolling = a.body.rolling + b.body.rolling;
  if (flat) {
    const Real depth = drawDepth(random, wanted, std::numeric_limits<double>::infinity());
    const Placement placement = placedAlong(touch, -depth);
    return Sample{a, b, placement.a_from_b, placement.truth, touch};
  }
  if (rolling > 0.0) {
    const Real depth = drawDepth(random, wanted, rolling);
    if (depth > Real(0.95 * rolling)) return std::nullopt;
    return overlapAt(a, b, touch, depth);
  }
  // Rounding far from the origin gives polytopes other faces.
  if (wanted.awayFromOrigin > 0.0) return std::nullopt;
  if (!isPolytope(a.body) || !isPolytope(b.body)) return std::nullopt;
  if (wanted.gap > 0.0) {
    const Isometry3d pose = placedAlong(touch, -Real(wanted.gap)).a_from_b;
    return overlappingAt(a, b, pose);
  }
  return overlappingAt(a, b, placeDeep(a.body, b.body, random).a_from_b);
}

}  // namespace

std::vector<Form> mostForms() {
  return {Form::Sphere, Form::Box,       Form::Cylinder, Form::Capsule,
          Form::Cone,   Form::Ellipsoid, Form::Hull,     Form::Triangle,
          Form::Mesh,   Form::Cloud,     Form::HalfSpace};
}

double Sample::rounding() const {
  constexpr double kSome = 4.0;
  return kSome * swept::tolerance::kSupportRounding *
         (std::sqrt(3.0) * (a.body.extent + b.body.extent) + pose.translation().norm());
}

Sample apartAt(Solid a, Solid b, const Touch& touch, const Real& gap) {
  const Point exact = touch.shift + touch.n * gap;
  const Placement placement = placed(touch, exact);
  const Point e = real(Vector3d(placement.a_from_b.translation())) - exact;
  const Real between = gap + touch.n.dot(e);
  const bool flat = a.body.isFlat() || b.body.isFlat();
  const Truth truth{between, flat ? between : length(touch.n * gap + e)};
  return {std::move(a), std::move(b), placement.a_from_b, truth, touch};
}

std::optional<Sample> overlappingAt(Solid a, Solid b, const Isometry3d& pose) {
  if (!a.body.convex || !b.body.convex) return std::nullopt;
  const Real depth = depthOf(a.body, b.body, pose);
  if (depth < 0) return std::nullopt;
  return Sample{std::move(a), std::move(b), pose, {-depth, -depth}};
}

Solid drawOne(Random& random, const Wanted& wanted, double size) {
  Solid solid = kindOf(wanted.shapes[random.below(wanted.shapes.size())]).draw(random, size);
  if (wanted.awayFromOrigin > 0.0) move(solid, wanted.awayFromOrigin * random.direction());
  return solid;
}

Sample overlapAt(Solid a, Solid b, const Touch& touch, const Real& depth) {
  const Real rolling = a.body.rolling + b.body.rolling;
  const Point exact = touch.shift - touch.n * depth;
  const Placement placement = placed(touch, exact);
  const Point e = real(Vector3d(placement.a_from_b.translation())) - exact;
  const Truth truth{touch.n.dot(e) - depth, length(touch.n * (rolling - depth) + e) - rolling};
  return {std::move(a), std::move(b), placement.a_from_b, truth, touch};
}

Sample drawApart(Random& random, const Wanted& wanted) {
  for (;;) {
    Solid a = drawOne(random, wanted, wanted.sizeA);
    Solid b = drawOne(random, wanted, wanted.sizeB);
    if (a.body.isFlat() && b.body.isFlat()) continue;
    const Touch touch = drawTouch(a.body, b.body, random);
    return apartAt(std::move(a), std::move(b), touch, drawGap(random, wanted));
  }
}

Sample drawOverlapping(Random& random, const Wanted& wanted) {
  for (;;) {
    const Solid a = drawOne(random, wanted, wanted.sizeA);
    const Solid b = drawOne(random, wanted, wanted.sizeB);
    if (auto sample = overlapOf(a, b, wanted, random)) return *std::move(sample);
  }
}

Sample drawEither(Random& random, const Wanted& wanted, int i) {
  return i % 2 == 0 ? drawApart(random, wanted) : drawOverlapping(random, wanted);
}

Solid meshOf(std::vector<Vector3d> points, std::vector<Eigen::Vector3i> faces) {
  Body body;
  body.points = std::move(points);
  body.faces = std::move(faces);
  findEdges(body);
  finish(body);
  return {swept::TriangleMesh::build(body.points, body.faces), body};
}

Solid boxOf(const Vector3d& half) {
  Body body = boxBody(half);
  finish(body);
  return {swept::Box{half}, body};
}

Solid boxMeshOf(const Vector3d& half) {
  const Body body = boxBody(half);
  return meshOf(body.points, body.faces);
}

Solid triangleOf(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  Body body;
  body.points = {a, b, c};
  body.faces = {{0, 1, 2}};
  for (int i = 0; i < 3; ++i) {
    const Vector3d none = Vector3d::Zero();
    body.edges.push_back({i, (i + 1) % 3, none, none, none});
  }
  finish(body);
  return {swept::Triangle{{a, b, c}}, body};
}

Solid sphereOf(double radius) {
  Body body;
  body.points = {Vector3d::Zero()};
  body.radius = radius;
  finish(body);
  return {swept::Sphere{radius}, body};
}

Solid hullOf(std::vector<Vector3d> points) {
  Body body;
  body.points = std::move(points);
  finish(body);
  return {swept::ConvexHull::of(body.points), body};
}

Sample alignedBoxes(Solid a, const Vector3d& halfA, Solid b, const Vector3d& halfB,
                    const Matrix3d& turn, const Vector3d& translation) {
  const Vector3d turned = turn.cwiseAbs() * halfB;
  Real deepest = -std::numeric_limits<double>::infinity();
  Real squared = 0;
  int axis = 0;
  int gaps = 0;
  for (int i = 0; i < 3; ++i) {
    const Real gap = abs(Real(translation[i])) - Real(halfA[i]) - Real(turned[i]);
    if (gap > deepest) axis = i;
    deepest = std::max(deepest, gap);
    gaps += gap > -0.01 * std::min(halfA[i], turned[i]);
    if (gap > 0) squared += gap * gap;
  }
  const Real truth = squared > 0 ? sqrt(squared) : deepest;
  Sample sample{std::move(a), std::move(b), Isometry3d::Identity(), {truth, truth}};
  sample.pose.linear() = turn;
  sample.pose.translation() = translation;
  if (gaps > 1) return sample;
  const Point n = basis(axis) * Real(translation[axis] < 0.0 ? -1 : 1);
  sample.thickness = 2.0 * (halfA[axis] + turned[axis]);
  sample.touch = Touch{turn, n, real(translation) - n * deepest, Feature::Face, Feature::Face};
  return sample;
}

}  // namespace extremes
