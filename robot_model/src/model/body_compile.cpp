// SPDX-License-Identifier: BSD-3-Clause
#include "model/compile.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "kinematics/rigid_transform.hpp"
#include "model/pair_model.hpp"
#include "robot/shape_cover.hpp"
#include "rules/name_pattern.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A piece of geometry as given.
struct GivenPiece {
  const Shape* shape;
  Isometry3d frame_from_shape;               ///< the collision body's frame
  std::shared_ptr<const SphereCover> cover;  ///< null: not known yet, or none
};

std::vector<GivenPiece> piecesOf(const PairModel& model, const CollisionBody& collisionBody) {
  std::vector<GivenPiece> pieces;
  switch (collisionBody.kind) {
    case CollisionBody::Kind::Link:
      for (const CollisionGeometry& piece : model.robot->links()[collisionBody.link].collision)
        pieces.push_back({&piece.shape, piece.link_from_shape, piece.cover});
      break;
    case CollisionBody::Kind::Attached:
      for (const AttachedBody::Part& part :
           std::ranges::find(model.options.attached, collisionBody.name, &AttachedBody::name)
               ->parts)
        pieces.push_back({&part.shape, orthonormalized(part.link_from_shape), nullptr});
      break;
    case CollisionBody::Kind::Obstacle:
      for (const MovingObstacle::Part& part : model.world->findObstacle(collisionBody.name)->parts)
        pieces.push_back({&part.shape, part.body_from_shape, nullptr});
      break;
  }
  return pieces;
}

bool samePose(const Isometry3d& a, const Isometry3d& b) {
  return a.matrix() == b.matrix();
}

/// m. Bound on the distance of the shape's points from their places in the source.
double sourceErrorOf(const Shape& shape) {
  const auto* mesh = std::get_if<TriangleMesh>(&shape);
  return mesh != nullptr ? mesh->sourceError() : 0.0;
}

class BodyCompiler {
 public:
  BodyCompiler(const PairModel* like, PairModel& model) : like_(like), model_(model) {}

  void compile() {
    model_.kinematics = compileKinematics(*model_.robot, model_.group, *model_.options.reference);
    addLinks();
    for (const AttachedBody& body : model_.options.attached) addAttached(body);
    addObstacles();
    for (std::size_t i = 0; i < model_.collisionBodies.size(); ++i)
      addGeometry(static_cast<int>(i));
    // Frames without geometry count as well.
    const bool same = like_ != nullptr && kept_ == geometry_.size() &&
                      like_->robotGeometry.size() == geometry_.size() &&
                      like_->kinematics.bodies.size() == model_.kinematics.bodies.size();
    model_.robotGeometry = same ? like_->robotGeometry : SharedArray(std::move(geometry_));
    addWorld();
  }

 private:
  [[noreturn]] static void fail(const AttachedBody& body, const std::string& what) {
    throw std::invalid_argument("Checker: attached body '" + body.name + "' " + what);
  }

  void addLinks() {
    const std::vector<Link>& links = model_.robot->links();
    for (std::size_t i = 0; i < links.size(); ++i)
      model_.collisionBodies.push_back({.name = BodyName(links[i].name),
                                        .link = static_cast<int>(i),
                                        .body = model_.kinematics.bodyOfLink[i],
                                        .body_from_frame = model_.kinematics.body_from_link[i]});
  }

  void addAttached(const AttachedBody& body) {
    const std::optional<int> link = model_.robot->findLink(body.link);
    if (!link) fail(body, "is attached to link '" + body.link + "', which the robot does not have");
    for (const std::string& touch : body.touchLinks)
      if (!isPattern(touch) && !model_.robot->findLink(touch))
        fail(body, "has touch link '" + touch + "', which the robot does not have");
    if (body.name.empty() ||
        std::ranges::find(model_.collisionBodies, body.name, &CollisionBody::name) !=
            model_.collisionBodies.end())
      fail(body, body.name.empty() ? "has no name" : "has the name of a link or another one");
    for (const AttachedBody::Part& part : body.parts) {
      if (!isRigid(part.link_from_shape))
        fail(body, "has a part whose pose is no finite rigid transform");
      if (!isBounded(part.shape)) fail(body, "has a plane or a half-space, which cannot move");
    }
    CollisionBody collisionBody = model_.collisionBodies[*link];
    collisionBody.kind = CollisionBody::Kind::Attached;
    collisionBody.name = BodyName(body.name);
    // A separate frame keeps the data about the link unchanged.
    if (collisionBody.body != 0) {
      collisionBody.body =
          addAttachedFrame(model_.kinematics, collisionBody.body, collisionBody.body_from_frame);
      collisionBody.body_from_frame.setIdentity();
    }
    model_.collisionBodies.push_back(std::move(collisionBody));
  }

  void addObstacles() {
    const std::vector<MovingObstacle>& obstacles = model_.world->obstacles();
    int body = addObstacleFrames(model_.kinematics, obstacles.size());
    for (const MovingObstacle& obstacle : obstacles)
      model_.collisionBodies.push_back(
          {.kind = CollisionBody::Kind::Obstacle, .name = BodyName(obstacle.name), .body = body++});
    for (std::size_t i = 0; i < model_.collisionBodies.size(); ++i) requireOwnName(i);
  }

  /// The robot's parts and those of the world are distinguished by their names.
  void requireOwnName(std::size_t index) const {
    const CollisionBody& collisionBody = model_.collisionBodies[index];
    const bool taken =
        collisionBody.kind == CollisionBody::Kind::Obstacle
            ? std::ranges::find(model_.collisionBodies, collisionBody.name, &CollisionBody::name) !=
                  model_.collisionBodies.begin() + static_cast<std::ptrdiff_t>(index)
            : collisionBody.kind == CollisionBody::Kind::Attached &&
                  model_.world->find(collisionBody.name) != nullptr;
    if (taken) {
      throw std::invalid_argument("Checker: the world has a body '" + collisionBody.name +
                                  "', and so has the robot");
    }
  }

  void addGeometry(int index) {
    const CollisionBody& collisionBody = model_.collisionBodies[index];
    const double scale = model_.options.rules.scale(collisionBody.name);
    const std::vector<GivenPiece> pieces = piecesOf(model_, collisionBody);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      const RobotGeometry* known = findKnown(collisionBody, pieces[i], static_cast<int>(i), scale);
      RobotGeometry geometry =
          known != nullptr ? *known : newGeometry(pieces[i], static_cast<int>(i), scale);
      const bool moved =
          known == nullptr || known->body != collisionBody.body || known->collisionBody != index;
      if (moved) place(collisionBody, pieces[i].frame_from_shape, geometry);
      geometry.collisionBody = index;
      // Whether all of them have not moved.
      if (!moved && known == like_->robotGeometry.begin() + geometry_.size()) ++kept_;
      geometry_.push_back(std::move(geometry));
    }
  }

  RobotGeometry newGeometry(const GivenPiece& piece, int index, double scale) const {
    RobotGeometry geometry;
    geometry.piece = index;
    geometry.scale = scale;
    geometry.shape = scale == 1.0 ? *piece.shape : scaled(*piece.shape, scale);
    geometry.sourceError = sourceErrorOf(geometry.shape);
    geometry.cover = scale == 1.0 && piece.cover != nullptr ? piece.cover : coverOf(geometry.shape);
    return geometry;
  }

  void place(const CollisionBody& collisionBody, const Isometry3d& frame_from_shape,
             RobotGeometry& geometry) const {
    geometry.body = collisionBody.body;
    geometry.body_from_shape = collisionBody.body_from_frame * frame_from_shape;
    const BoundingSphere ball = boundingSphere(geometry.shape);
    geometry.center = geometry.body_from_shape * ball.center;
    geometry.radius = ball.radius;
    geometry.magnitude =
        geometry.body_from_shape.translation().norm() + ball.center.norm() + ball.radius;
    geometry.levers = leverArms(model_.kinematics, geometry.body, geometry.center, ball.radius);
    geometry.transforms = geometry.levers.transforms;
    if (collisionBody.link < 0) return;
    const FixedJointChain& fixedChain = model_.kinematics.fixedChainOfLink[collisionBody.link];
    geometry.magnitude += fixedChain.detour(model_.kinematics.body_from_link[collisionBody.link]);
    geometry.transforms += fixedChain.transforms;
  }

  /// The same piece of the same collision body in the earlier version; null: there is none.
  const RobotGeometry* findKnown(const CollisionBody& collisionBody, const GivenPiece& piece,
                                 int index, double scale) const {
    if (like_ == nullptr) return nullptr;
    for (const RobotGeometry& other : like_->robotGeometry) {
      const CollisionBody& owner = like_->collisionBodies[other.collisionBody];
      if (other.piece != index || other.scale != scale || owner.kind != collisionBody.kind ||
          owner.link != collisionBody.link || owner.name != collisionBody.name)
        continue;
      if (collisionBody.kind == CollisionBody::Kind::Link) return &other;  // of the same robot
      const GivenPiece given = piecesOf(*like_, owner)[index];
      const bool same = areSame(*given.shape, *piece.shape) &&
                        samePose(given.frame_from_shape, piece.frame_from_shape);
      return same ? &other : nullptr;
    }
    return nullptr;
  }

  void addWorld() {
    const std::vector<WorldBody>& bodies = model_.world->bodies();
    std::size_t parts = 0;
    for (const WorldBody& body : bodies) parts += body.parts.size();
    model_.worldGeometry.reserve(parts);
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const double scale = model_.options.rules.scale(bodies[i].name);
      for (std::size_t k = 0; k < bodies[i].parts.size(); ++k)
        addPart(static_cast<int>(i), static_cast<int>(k), scale);
    }
  }

  /// m, from the shape's origin to an unbounded shape's boundary.
  static double planeOffset(const Shape& shape) {
    if (const auto* plane = std::get_if<Plane>(&shape)) return std::abs(plane->offset);
    if (const auto* halfSpace = std::get_if<HalfSpace>(&shape)) return std::abs(halfSpace->offset);
    return 0.0;
  }

  void addPart(int body, int index, double scale) {
    const WorldBody::Part& part = model_.world->bodies()[body].parts[index];
    WorldGeometry& geometry = model_.worldGeometry.emplace_back();
    geometry.body = body;
    geometry.part = index;
    geometry.shape = scale == 1.0 ? part.shape : scaledAsBefore(part.shape, scale);
    geometry.scale = scale;
    geometry.sourceError = sourceErrorOf(geometry.shape);
    geometry.world_from_shape = part.world_from_shape;
    const Aabb box = boundingBox(geometry.shape);
    const bool bounded = box.lower.allFinite() && box.upper.allFinite();
    const Vector3d middle =
        bounded ? Vector3d(0.5 * box.lower + 0.5 * box.upper) : Vector3d::Zero();
    Isometry3d world_from_box = part.world_from_shape;
    world_from_box.translation() = part.world_from_shape * middle;
    geometry.box_from_world = world_from_box.inverse();
    geometry.halfExtents = (box.upper - middle).cwiseMax(middle - box.lower);
    const Vector3d farthest = box.upper.cwiseAbs().cwiseMax(box.lower.cwiseAbs());
    geometry.magnitude = part.world_from_shape.translation().norm() +
                         (bounded ? farthest.norm() : planeOffset(geometry.shape));
  }

  /// A mesh that an earlier version has scaled is not built again.
  Shape scaledAsBefore(const Shape& shape, double scale) const {
    if (like_ != nullptr) {
      for (const WorldGeometry& other : like_->worldGeometry)
        if (other.scale == scale &&
            areSame(like_->world->bodies()[other.body].parts[other.part].shape, shape))
          return other.shape;
    }
    return scaled(shape, scale);
  }

  const PairModel* like_;
  PairModel& model_;
  std::vector<RobotGeometry> geometry_;
  std::size_t kept_ = 0;
};

}  // namespace

void compileBodies(const PairModel* like, PairModel& model) {
  BodyCompiler(like, model).compile();
}

}  // namespace swept::detail
