// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "output/shape_summary.hpp"
#include "page/packed.hpp"

namespace swept {
namespace {

/// The balls of a cover that show it well: those of the finest level with no more than so many per
/// shape.
constexpr int kMostShownBalls = 96;

/// The most points of one cloud: more make a page large and a browser slow.
constexpr std::size_t kMostDrawnBalls = 100'000;

class Collector {
 public:
  explicit Collector(const Checker* checker) : checker_(checker) {}

  PageBody body(const std::string& name, PageBody::Kind kind, int link) const {
    PageBody body{
        .name = name, .kind = kind, .link = link, .moving = nullptr, .parts = {}, .colour = {}};
    if (checker_ != nullptr) body.padding = checker_->options().rules.padding(name);
    return body;
  }

  void addPart(PageBody& body, const Shape& shape, const Eigen::Isometry3d& pose,
               std::shared_ptr<const SphereCover> cover) const {
    const double scale = checker_ == nullptr ? 1.0 : checker_->options().rules.scale(body.name);
    PageBody::Part part{.shape = scale == 1.0 ? shape : scaled(shape, scale),
                        .body_from_shape = pose,
                        .cover = std::move(cover)};
    const bool bounded = std::isfinite(boundingSphere(part.shape).radius);
    const bool own =
        body.kind != PageBody::Kind::World && bounded && (scale != 1.0 || part.cover == nullptr);
    if (own) part.cover = std::make_shared<const SphereCover>(sphereCover(part.shape));
    body.parts.push_back(std::move(part));
  }

 private:
  const Checker* checker_;
};

Json kindJson(const char* kind, Json sizes) {
  Json json = {{"kind", kind}};
  json["size"] = std::move(sizes);
  return json;
}

template <typename Vertices, typename Triangles>
Json trianglesJson(const Vertices& vertices, const Triangles& triangles) {
  std::vector<float> positions;
  positions.reserve(3 * vertices.size());
  for (const auto& vertex : vertices)
    for (const auto value : vertex) positions.push_back(static_cast<float>(value));
  std::vector<std::uint32_t> indices;
  indices.reserve(3 * triangles.size());
  for (const Eigen::Vector3i& triangle : triangles)
    for (const int corner : triangle) indices.push_back(static_cast<std::uint32_t>(corner));
  Json json = {{"kind", "triangles"}};
  json["positions"] = packed<float>(positions);
  if (vertices.size() <= 0x10000) {
    const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
    json["indices16"] = packed<std::uint16_t>(narrow);
  } else {
    json["indices32"] = packed<std::uint32_t>(indices);
  }
  return json;
}

template <typename Ball>
void appendBall(std::vector<float>& numbers, const Ball& center, double radius) {
  for (int axis = 0; axis < 3; ++axis) numbers.push_back(static_cast<float>(center[axis]));
  numbers.push_back(static_cast<float>(radius));
}

/// Sizes are full lengths, m; axes along z.
struct Drawn {
  Json operator()(const Sphere& s) const { return kindJson("sphere", {s.radius}); }
  Json operator()(const Box& b) const {
    return kindJson("box", toJson(Eigen::Vector3d(2.0 * b.halfExtents)));
  }
  Json operator()(const Cylinder& c) const {
    return kindJson("cylinder", {c.radius, 2.0 * c.halfLength});
  }
  Json operator()(const Capsule& c) const {
    return kindJson("capsule", {c.radius, 2.0 * c.halfLength});
  }
  Json operator()(const Cone& c) const { return kindJson("cone", {c.radius, 2.0 * c.halfLength}); }
  Json operator()(const Ellipsoid& e) const { return kindJson("ellipsoid", toJson(e.semiAxes)); }
  Json operator()(const Triangle& t) const {
    const std::vector<Eigen::Vector3d> corners(t.corners.begin(), t.corners.end());
    return trianglesJson(corners, std::vector<Eigen::Vector3i>{{0, 1, 2}});
  }
  Json operator()(const Plane& p) const {
    return {{"kind", "plane"}, {"normal", toJson(p.normal)}, {"offset", p.offset}};
  }
  Json operator()(const HalfSpace& h) const {
    return {{"kind", "half-space"}, {"normal", toJson(h.normal)}, {"offset", h.offset}};
  }
  Json operator()(const ConvexHull& hull) const {
    return trianglesJson(hull.vertices(), hull.faces());
  }
  Json operator()(const TriangleMesh& mesh) const {
    return trianglesJson(mesh.vertices(), mesh.triangles());
  }
  Json operator()(const PointCloud& cloud) const {
    // The order is that of a hierarchy: each so-manyth is as good everywhere.
    const std::size_t count = cloud.points().size();
    const std::size_t step = (count + kMostDrawnBalls - 1) / kMostDrawnBalls;
    std::vector<float> balls;
    for (std::size_t i = 0; i < count; i += step)
      appendBall(balls, cloud.points()[i], cloud.radius(i));
    return {{"kind", "balls"},
            {"balls", packed<float>(balls)},
            {"drawn", balls.size() / 4},
            {"of", count}};
  }
};

/// What copies of a shape share; null for those that hold their few numbers themselves.
const void* sharedDataOf(const Shape& shape) {
  return std::visit(
      []<typename T>(const T& held) -> const void* {
        if constexpr (std::is_same_v<T, ConvexHull> || std::is_same_v<T, TriangleMesh>)
          return held.vertices().data();
        else if constexpr (std::is_same_v<T, PointCloud>)
          return held.points().data();
        else
          return nullptr;
      },
      shape);
}

int levelShown(const SphereCover& cover) {
  int level = 0;
  for (std::size_t i = 0; i < cover.levels.size(); ++i)
    if (cover.levels[i].ballCount <= kMostShownBalls) level = static_cast<int>(i);
  return level;
}

}  // namespace

std::vector<PageBody> pageBodies(const Robot& robot, const World& world, const Checker* checker,
                                 const VisualModel* visuals) {
  const Collector collector(checker);
  std::vector<PageBody> bodies;
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    const Link& link = robot.links()[i];
    if (link.collision.empty()) continue;
    PageBody& body =
        bodies.emplace_back(collector.body(link.name, PageBody::Kind::Link, static_cast<int>(i)));
    const LinkVisuals* looks = visuals == nullptr ? nullptr : visuals->find(link.name);
    if (looks != nullptr) body.colour = looks->colour;
    for (const CollisionGeometry& piece : link.collision)
      collector.addPart(body, piece.shape, piece.link_from_shape, piece.cover);
  }
  const std::vector<AttachedBody> none;
  for (const AttachedBody& held : checker == nullptr ? none : checker->options().attached) {
    const int link = robot.findLink(held.link).value_or(0);
    PageBody& body = bodies.emplace_back(collector.body(held.name, PageBody::Kind::Attached, link));
    for (const AttachedBody::Part& part : held.parts)
      collector.addPart(body, part.shape, part.link_from_shape, nullptr);
  }
  for (const WorldBody& obstacle : world.bodies()) {
    PageBody& body = bodies.emplace_back(collector.body(obstacle.name, PageBody::Kind::World, -1));
    for (const WorldBody::Part& part : obstacle.parts)
      collector.addPart(body, part.shape, part.world_from_shape, nullptr);
  }
  for (const MovingObstacle& obstacle : world.obstacles()) {
    PageBody& body = bodies.emplace_back(collector.body(obstacle.name, PageBody::Kind::World, -1));
    body.moving = &obstacle;
    for (const MovingObstacle::Part& part : obstacle.parts)
      collector.addPart(body, part.shape, part.body_from_shape, nullptr);
  }
  return bodies;
}

int PageGeometries::indexOf(const Shape& shape) {
  const void* const data = sharedDataOf(shape);
  const auto known = std::ranges::find(shared_, data, &std::pair<const void*, int>::first);
  if (data != nullptr && known != shared_.end()) return known->second;
  const auto index = static_cast<int>(geometries_.size());
  geometries_.push_back(std::visit(Drawn{}, shape));
  if (data == nullptr) return index;
  shared_.emplace_back(data, index);
  kept_.push_back(shape);
  return index;
}

int PageGeometries::indexOf(const std::shared_ptr<const VisualMesh>& mesh) {
  const auto known = std::ranges::find(shared_, static_cast<const void*>(mesh.get()),
                                       &std::pair<const void*, int>::first);
  if (known != shared_.end()) return known->second;
  const auto index = static_cast<int>(geometries_.size());
  geometries_.push_back(trianglesJson(mesh->vertices, mesh->triangles));
  shared_.emplace_back(mesh.get(), index);
  keptMeshes_.push_back(mesh);
  return index;
}

int PageGeometries::coverIndex(const SphereCover& cover) {
  const auto known = std::ranges::find(shared_, static_cast<const void*>(&cover),
                                       &std::pair<const void*, int>::first);
  if (known != shared_.end()) return known->second;
  std::vector<float> balls;
  for (const int node : cover.cut(levelShown(cover))) {
    const CoverBall& ball = cover.nodes[static_cast<std::size_t>(node)].ball;
    appendBall(balls, ball.center, ball.radius);
  }
  const auto index = static_cast<int>(covers_.size());
  covers_.push_back({{"balls", packed<float>(balls)}, {"finest", cover.levels.back().ballCount}});
  shared_.emplace_back(&cover, index);
  return index;
}

Json PageGeometries::partsJson(const PageBody& body) {
  Json parts = Json::array();
  for (const PageBody::Part& part : body.parts) {
    std::vector<float> pose;
    appendPose(pose, part.body_from_shape);
    Json json = {{"geometry", indexOf(part.shape)}, {"pose", packed<float>(pose)}};
    json["shape"] = shapeText(part.shape);
    json["cover"] = part.cover == nullptr ? Json(nullptr) : Json(coverIndex(*part.cover));
    parts.push_back(std::move(json));
  }
  return parts;
}

}  // namespace swept
