// SPDX-License-Identifier: BSD-3-Clause
#include "graph/model_digest.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <variant>
#include <vector>

#include "robot/shape_cover.hpp"

namespace swept::detail {

namespace {

/// Every item is added with its size or count, so that no two contents give the same bytes.
class ModelHash {
 public:
  explicit ModelHash(std::string_view kind) { add(kind); }
  ContentHash::Digest digest() { return hash_.digest(); }

  void add(std::string_view text) {
    add(text.size());
    hash_.add(text);
  }
  void add(double value) {
    const double plain = value == 0.0 ? 0.0 : value;  // one zero
    hash_.addItems(std::span<const double>(&plain, 1));
  }
  template <typename Number>
  requires(std::is_integral_v<Number> || std::is_enum_v<Number>) void add(Number value) {
    const auto wide = static_cast<std::int64_t>(value);
    hash_.addItems(std::span<const std::int64_t>(&wide, 1));
  }
  template <int Rows, int Columns>
  void add(const Eigen::Matrix<double, Rows, Columns>& matrix) {
    add(matrix.size());
    for (Eigen::Index i = 0; i < matrix.size(); ++i) add(matrix.data()[i]);
  }
  void add(const Eigen::Isometry3d& pose) { add(Eigen::Matrix4d(pose.matrix())); }
  void add(const Eigen::Quaterniond& turn) { add(Eigen::Vector4d(turn.coeffs())); }
  void add(const std::vector<int>& values) {
    add(values.size());
    for (const int value : values) add(value);
  }
  void add(const std::optional<double>& value) {
    add(value.has_value());
    add(value.value_or(0.0));
  }

  void add(const Shape& shape) {
    add(shape.index());
    std::visit([this](const auto& own) { addShape(own); }, shape);
  }
  void add(const CollisionRules::Rule& rule) {
    add(rule.kind);
    add(std::string_view(rule.bodyA));
    add(std::string_view(rule.bodyB));
    add(rule.value);
    add(rule.layer);
  }
  void add(const ConstraintFrame& frame) {
    add(std::string_view(frame.body));
    add(frame.body_from_frame);
  }

 private:
  template <typename Item>
  void addMany(const std::vector<Item>& items) {
    add(items.size());
    hash_.addItems(std::span<const Item>(items));
  }
  void addShape(const Sphere& s) { add(s.radius); }
  void addShape(const Box& s) { add(s.halfExtents); }
  template <typename Round>
  requires requires(const Round& s) { s.halfLength; }
  void addShape(const Round& s) {
    add(s.radius);
    add(s.halfLength);
  }
  void addShape(const Ellipsoid& s) { add(s.semiAxes); }
  void addShape(const Triangle& s) {
    for (const Eigen::Vector3d& corner : s.corners) add(corner);
  }
  template <typename Flat>
  requires requires(const Flat& s) { s.normal; }
  void addShape(const Flat& s) {
    add(s.normal);
    add(s.offset);
  }
  void addShape(const ConvexHull& s) {
    addMany(s.vertices());
    add(s.error());
  }
  void addShape(const TriangleMesh& s) {
    addMany(s.vertices());
    addMany(s.triangles());
    add(s.interior());
    add(s.report().closedComponents);
    add(s.report().openComponents);
    add(s.sourceError());
  }
  void addShape(const PointCloud& s) {
    addMany(s.points());
    for (std::size_t i = 0; i < s.points().size(); ++i) add(s.radius(i));
  }

  ContentHash hash_;
};

bool namesBody(const CollisionRules::Rule& rule, const World& world) {
  return world.find(rule.bodyA) != nullptr || world.find(rule.bodyB) != nullptr;
}

/// Calls `visit(rule, place)` for the rules that name this body; `place`: how many rules that name
/// no body of the world come before.
template <typename Visit>
void forRulesOf(const Checker& checker, std::string_view body, const Visit& visit) {
  std::size_t place = 0;
  for (const CollisionRules::Rule& rule : checker.options().rules.rules()) {
    if (rule.bodyA == body || rule.bodyB == body) visit(rule, place);
    if (!namesBody(rule, checker.world())) ++place;
  }
}

bool isSameShape(const Shape& a, const Shape& b) {
  const auto sameFlat = [](const auto& one, const auto& other) {
    return one.normal == other.normal && one.offset == other.offset;
  };
  if (a.index() != b.index()) return false;
  if (const auto* plane = std::get_if<Plane>(&a)) return sameFlat(*plane, std::get<Plane>(b));
  if (const auto* half = std::get_if<HalfSpace>(&a)) return sameFlat(*half, std::get<HalfSpace>(b));
  return areSame(a, b);
}

}  // namespace

ContentHash::Digest robotDigest(const Robot& robot) {
  ModelHash hash("robot");
  hash.add(robot.links().size());
  for (const Link& link : robot.links()) {
    hash.add(std::string_view(link.name));
    hash.add(link.parentJoint);
    hash.add(link.collision.size());
    for (const CollisionGeometry& geometry : link.collision) {
      hash.add(geometry.shape);
      hash.add(geometry.link_from_shape);
    }
  }
  hash.add(robot.joints().size());
  for (const Joint& joint : robot.joints()) {
    hash.add(std::string_view(joint.name));
    hash.add(joint.type);
    hash.add(joint.parentLink);
    hash.add(joint.childLink);
    hash.add(joint.parent_from_joint);
    hash.add(joint.axis);
    hash.add(joint.mimic.has_value());
    if (joint.mimic) {
      hash.add(joint.mimic->master);
      hash.add(joint.mimic->multiplier);
      hash.add(joint.mimic->offset);
    }
    hash.add(joint.firstVariable);
  }
  hash.add(robot.variables().size());
  for (const Variable& variable : robot.variables()) {
    hash.add(std::string_view(variable.name));
    hash.add(variable.joint);
    hash.add(variable.lower);
    hash.add(variable.upper);
    hash.add(variable.cyclic);
  }
  hash.add(robot.disabledPairs().size());
  for (const DisabledPair& pair : robot.disabledPairs()) {
    hash.add(pair.linkA);
    hash.add(pair.linkB);
  }
  hash.add(robot.enabledPairs().size());
  for (const EnabledPair& pair : robot.enabledPairs()) {
    hash.add(pair.linkA);
    hash.add(pair.linkB);
  }
  return hash.digest();
}

ContentHash::Digest questionDigest(const Checker& checker) {
  const CheckerOptions& options = checker.options();
  ModelHash hash("question");
  hash.add(std::string_view(checker.group().name));
  hash.add(checker.group().joints);
  hash.add(checker.group().variables);
  hash.add(options.margin);
  hash.add(options.selfMargin);
  hash.add(options.worldMargin);
  hash.add(options.tolerance);
  hash.add(options.maxIntervals);
  hash.add(options.reference.has_value());
  if (options.reference) hash.add(*options.reference);
  for (const CollisionRules::Rule& rule : options.rules.rules())
    if (!namesBody(rule, checker.world())) hash.add(rule);
  hash.add(options.attached.size());
  for (const AttachedBody& body : options.attached) {
    hash.add(std::string_view(body.name));
    hash.add(std::string_view(body.link));
    hash.add(body.parts.size());
    for (const AttachedBody::Part& part : body.parts) {
      hash.add(part.shape);
      hash.add(part.link_from_shape);
    }
    hash.add(body.touchLinks.size());
    for (const std::string& link : body.touchLinks) hash.add(std::string_view(link));
  }
  const auto addTolerance = [&hash](const JointTolerance& tolerance) {
    hash.add(tolerance.rotation);
    hash.add(tolerance.translation);
  };
  addTolerance(options.tracking);
  hash.add(options.tracking.joints.size());
  for (const auto& [name, tolerance] : options.tracking.joints) {
    hash.add(std::string_view(name));
    addTolerance(tolerance);
  }
  const TaskConstraint& task = options.constraints;
  hash.add(task.joints.size());
  for (const JointConstraint& joint : task.joints) {
    hash.add(std::string_view(joint.joint));
    for (const double value : {joint.position, joint.above, joint.below}) hash.add(value);
  }
  hash.add(task.positions.size());
  for (const PositionConstraint& position : task.positions) {
    hash.add(position.frame);
    hash.add(position.reference);
    hash.add(position.regions.size());
    for (const ConstraintRegion& region : position.regions) {
      hash.add(region.type);
      hash.add(region.size);
      hash.add(region.reference_from_region);
    }
  }
  hash.add(task.orientations.size());
  for (const OrientationConstraint& orientation : task.orientations) {
    hash.add(orientation.frame);
    hash.add(orientation.reference);
    hash.add(orientation.orientation);
    hash.add(orientation.tolerance);
    hash.add(orientation.parameterization);
  }
  hash.add(task.axes.size());
  for (const AxisConstraint& axis : task.axes) {
    hash.add(axis.frame);
    hash.add(axis.reference);
    hash.add(axis.axis);
    hash.add(axis.direction);
    hash.add(axis.angle);
  }
  return hash.digest();
}

ContentHash::Digest bodyDigest(const Checker& checker, const WorldBody& body) {
  ModelHash hash("body");
  hash.add(std::string_view(body.name));
  hash.add(body.parts.size());
  for (const WorldBody::Part& part : body.parts) {
    hash.add(part.shape);
    hash.add(part.world_from_shape);
  }
  forRulesOf(checker, body.name, [&](const CollisionRules::Rule& rule, std::size_t place) {
    hash.add(rule);
    hash.add(place);
  });
  return hash.digest();
}

bool isSameBody(const Checker& a, const WorldBody& ofA, const Checker& b, const WorldBody& ofB) {
  const auto samePart = [](const WorldBody::Part& one, const WorldBody::Part& other) {
    return one.world_from_shape.matrix() == other.world_from_shape.matrix() &&
           isSameShape(one.shape, other.shape);
  };
  if (ofA.name != ofB.name || !std::ranges::equal(ofA.parts, ofB.parts, samePart)) return false;
  const auto rulesDigest = [&](const Checker& checker) {
    ModelHash hash("rules");
    forRulesOf(checker, ofA.name, [&](const CollisionRules::Rule& rule, std::size_t place) {
      hash.add(rule);
      hash.add(place);
    });
    return hash.digest();
  };
  const bool noRules = a.options().rules.empty() && b.options().rules.empty();
  return noRules || rulesDigest(a) == rulesDigest(b);
}

}  // namespace swept::detail
