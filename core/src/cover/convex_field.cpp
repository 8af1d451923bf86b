// SPDX-License-Identifier: BSD-3-Clause
#include "cover/convex_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "geometry/nearest_rotation.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

constexpr double kFieldRounding = 1e-14;
constexpr double kNothing = std::numeric_limits<double>::infinity();

/// Each edge is passed once each way.
bool isClosedSurface(std::span<const Eigen::Vector3i> triangles) {
  std::map<std::pair<int, int>, int> passes;
  for (const Eigen::Vector3i& t : triangles)
    for (int k = 0; k < 3; ++k) ++passes[{t[k], t[(k + 1) % 3]}];
  return std::ranges::all_of(passes, [&](const auto& pass) {
    const auto back = passes.find({pass.first.second, pass.first.first});
    return pass.second == 1 && back != passes.end() && back->second == 1;
  });
}

Vector3d unitVectorOf(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double x = normal(random);
  const double y = normal(random);
  const double z = normal(random);
  return Vector3d(x, y, z).normalized();
}

}  // namespace

ConvexField::ConvexField(const EnclosingSphere& sphere)
    : radius_(sphere.radius), center_(sphere.center) {
  reach_ = sphere.radius;
  area_ = 4.0 * std::numbers::pi * radius_ * radius_;
  size_ = center_.lpNorm<Eigen::Infinity>() + radius_;
  box_ = {center_.array() - radius_, center_.array() + radius_};
}

ConvexField::ConvexField(const PosedShape& posed, double growth)
    : body_from_shape_(rigidPose(posed.body_from_shape)),
      shape_from_body_(body_from_shape_.inverse()),
      growth_(growth),
      center_(body_from_shape_.translation()) {
  if (const auto* sphere = std::get_if<Sphere>(&posed.shape)) {
    *this = ConvexField(EnclosingSphere{center_, sphere->radius + growth});
    return;
  }
  const double pi = std::numbers::pi;
  if (const auto* capsule = std::get_if<Capsule>(&posed.shape)) {
    kind_ = Kind::Capsule;
    radius_ = capsule->radius + growth;
    half_.z() = capsule->halfLength;
    area_ = 4.0 * pi * radius_ * (radius_ + half_.z());
    reach_ = radius_ + half_.z();
  } else if (const auto* cylinder = std::get_if<Cylinder>(&posed.shape)) {
    kind_ = Kind::Cylinder;
    radius_ = cylinder->radius;
    half_.z() = cylinder->halfLength;
    const double grown = radius_ + growth;
    area_ = 2.0 * pi * grown * (grown + 2.0 * (half_.z() + growth));
    reach_ = std::hypot(radius_, half_.z()) + growth;
  } else if (const auto* box = std::get_if<Box>(&posed.shape)) {
    kind_ = Kind::Box;
    half_ = box->halfExtents;
    const Vector3d grown = half_.array() + growth;
    area_ = 8.0 * (grown.x() * grown.y() + grown.y() * grown.z() + grown.z() * grown.x());
    reach_ = half_.norm() + growth;
  } else if (const auto* hull = std::get_if<ConvexHull>(&posed.shape)) {
    useFaces(hull->vertices(), hull->faces(), growth);
  } else if (const auto* mesh = std::get_if<TriangleMesh>(&posed.shape)) {
    useFaces(mesh->vertices(), mesh->triangles(), growth);
  } else {
    throw std::invalid_argument(
        "a shape around a body is neither sphere, box, capsule, cylinder, hull nor mesh");
  }
  size_ = center_.lpNorm<Eigen::Infinity>() + reach_;
  if (kind_ != Kind::Faces) box_ = {center_.array() - reach_, center_.array() + reach_};
}

void ConvexField::useFaces(std::span<const Vector3d> vertices,
                           std::span<const Eigen::Vector3i> triangles, double growth) {
  kind_ = Kind::Faces;
  center_.setZero();
  for (const Vector3d& vertex : vertices) {
    vertices_.emplace_back(body_from_shape_ * vertex);
    center_ += vertices_.back() / static_cast<double>(vertices.size());
    box_.extend(vertices_.back());
  }
  triangles_.assign(triangles.begin(), triangles.end());
  for (const Vector3d& vertex : vertices_) reach_ = std::max(reach_, (vertex - center_).norm());
  closed_ = isClosedSurface(triangles_);
  const double rounding = kFieldRounding * (center_.lpNorm<1>() + reach_);
  double least = kNothing;  // m, of the distances of the centre from the faces
  for (const Eigen::Vector3i& t : triangles_) {
    const Vector3d& a = vertices_[static_cast<std::size_t>(t[0])];
    const Vector3d ab = vertices_[static_cast<std::size_t>(t[1])] - a;
    const Vector3d ac = vertices_[static_cast<std::size_t>(t[2])] - a;
    const Vector3d across = ab.cross(ac);
    const double twice = across.norm();
    const double side = std::max({ab.norm(), ac.norm(), (ab - ac).norm()});
    area_ += 0.5 * twice;
    areas_.push_back(area_);
    if (!(twice > 0.0)) {
      closed_ = false;
      continue;
    }
    const Vector3d normal = across / twice;
    // Coordinates were rounded where the pose moved them, too.
    const double error = (rounding + 2e-15 * side) * side / twice * side + rounding;
    faces_.push_back({normal, normal.dot(a) - error + growth});
    least = std::min(least, faces_.back().offset - growth - rounding - normal.dot(center_));
  }
  closed_ = closed_ && !faces_.empty() && least > 0.0;
  beyond_ = mostBeyond(growth);
  if (!closed_ || growth == 0.0) return;
  // What is grown is in what is scaled about the centre: n . (x - c) <= h + g <= h (1 + g / least).
  const double scale = 1.0 + growth / least;
  reach_ *= scale;
  box_ = {center_ + scale * (box_.min() - center_), center_ + scale * (box_.max() - center_)};
}

/// m. What is enclosed is in the hull of the vertices, so no more beyond a plane than these.
double ConvexField::mostBeyond(double growth) const {
  constexpr std::size_t kMostProducts = 100'000'000;
  if (vertices_.size() * faces_.size() > kMostProducts) return 2.0 * reach_;
  double most = 0.0;
  for (const Vector3d& vertex : vertices_)
    for (const Face& face : faces_)
      most = std::max(most, face.normal.dot(vertex) - (face.offset - growth));
  return most;
}

double ConvexField::value(const Vector3d& p) const {
  switch (kind_) {
    case Kind::Ball:
      return (p - center_).norm() - radius_;
    case Kind::Capsule: {
      Vector3d at = local(p);
      at.z() -= std::clamp(at.z(), -half_.z(), half_.z());
      return at.norm() - radius_;
    }
    case Kind::Box: {
      const Vector3d beyond = local(p).cwiseAbs() - half_;
      const double most = beyond.maxCoeff();
      return (most > 0.0 ? beyond.cwiseMax(0.0).norm() : most) - growth_;
    }
    case Kind::Cylinder: {
      const Vector3d at = local(p);
      const Eigen::Vector2d beyond(std::hypot(at.x(), at.y()) - radius_,
                                   std::abs(at.z()) - half_.z());
      const double most = beyond.maxCoeff();
      return (most > 0.0 ? beyond.cwiseMax(0.0).norm() : most) - growth_;
    }
    case Kind::Faces:
      break;
  }
  if (!closed_) return kNothing;
  double most = -kNothing;
  for (const Face& face : faces_) most = std::max(most, face.normal.dot(p) - face.offset);
  return most;
}

double ConvexField::rounding(const Vector3d& p) const {
  return kFieldRounding * (p.lpNorm<1>() + size_);
}

Vector3d ConvexField::outward(const Vector3d& p) const {
  const auto unit = [](const Vector3d& v) {
    return v.norm() > 0.0 ? Vector3d(v.normalized()) : Vector3d(Vector3d::UnitX());
  };
  if (kind_ == Kind::Ball) return unit(p - center_);
  if (kind_ == Kind::Faces) {
    if (faces_.empty()) return unit(p - center_);
    const auto front = std::ranges::max_element(
        faces_, {}, [&](const Face& face) { return face.normal.dot(p) - face.offset; });
    return front->normal;
  }
  const Vector3d at = local(p);
  Vector3d away = Vector3d::Zero();
  if (kind_ == Kind::Capsule) {
    away = at;
    away.z() -= std::clamp(at.z(), -half_.z(), half_.z());
  } else if (kind_ == Kind::Box) {
    const Vector3d beyond = at.cwiseAbs() - half_;
    int axis = 0;
    if (beyond.maxCoeff(&axis) > 0.0)
      away = beyond.cwiseMax(0.0).cwiseProduct(at.cwiseSign());
    else
      away[axis] = at[axis] < 0.0 ? -1.0 : 1.0;
  } else {
    const double across = std::hypot(at.x(), at.y());
    const Vector3d side(at.x() / std::max(across, 1e-300), at.y() / std::max(across, 1e-300), 0.0);
    const Vector3d up(0.0, 0.0, at.z() < 0.0 ? -1.0 : 1.0);
    const double outer = across - radius_;
    const double upper = std::abs(at.z()) - half_.z();
    if (outer > 0.0 || upper > 0.0)
      away = std::max(outer, 0.0) * side + std::max(upper, 0.0) * up;
    else
      away = outer > upper ? side : up;
  }
  return unit(body_from_shape_.linear() * away);
}

double ConvexField::over(const BodyPiece& piece) const {
  if (kind_ == Kind::Ball) return piece.farthest(center_) - radius_;
  double most = -kNothing;
  for (const Vector3d& point : piece.content) most = std::max(most, value(point) + rounding(point));
  return most + piece.blur;
}

bool ConvexField::containsCube(const Vector3d& middle, double half) const {
  if (kind_ == Kind::Ball) {
    const Vector3d far = (middle - center_).cwiseAbs().array() + half;
    return far.norm() < radius_ - 1e-12 * size_;
  }
  const double error = 1e-12 * size_;
  if (value(middle) >= -error) return false;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                        (corner & 4) != 0 ? 1.0 : -1.0);
    if (value(middle + half * sign) >= -error) return false;
  }
  return true;
}

bool ConvexField::missesCube(const Vector3d& middle, double half) const {
  const double here = value(middle);
  return std::isfinite(here) && here - std::numbers::sqrt3 * half > beyond_ + 1e-12 * size_;
}

Vector3d ConvexField::pointOfSurface(std::mt19937& random) const {
  std::uniform_real_distribution<double> uniform;
  const Vector3d direction = unitVectorOf(random);
  if (kind_ == Kind::Ball) return center_ + radius_ * direction;
  const double which = uniform(random);
  const double u = uniform(random);
  const double v = uniform(random);
  Vector3d at;
  if (kind_ == Kind::Faces) {
    if (areas_.empty()) return center_;
    const auto found = std::ranges::lower_bound(areas_, which * area_);
    const auto i =
        static_cast<std::size_t>(std::min(found - areas_.begin(), std::ssize(areas_) - 1));
    const Eigen::Vector3i& t = triangles_[i];
    const double root = std::sqrt(u);
    const auto corner = [&](int k) -> const Vector3d& {
      return vertices_[static_cast<std::size_t>(t[k])];
    };
    const Vector3d point =
        (1.0 - root) * corner(0) + root * (1.0 - v) * corner(1) + root * v * corner(2);
    return growth_ > 0.0 ? Vector3d(point + growth_ * outward(point)) : point;
  }
  if (kind_ == Kind::Box) {
    const Vector3d grown = half_.array() + growth_;
    const Vector3d sides(grown.y() * grown.z(), grown.z() * grown.x(), grown.x() * grown.y());
    const double at8 = which * sides.sum();
    const int axis = at8 < sides[0] ? 0 : at8 < sides[0] + sides[1] ? 1 : 2;
    at[axis] = direction[axis] < 0.0 ? -grown[axis] : grown[axis];
    at[(axis + 1) % 3] = (2.0 * u - 1.0) * grown[(axis + 1) % 3];
    at[(axis + 2) % 3] = (2.0 * v - 1.0) * grown[(axis + 2) % 3];
  } else if (kind_ == Kind::Capsule) {
    if (which * (radius_ + half_.z()) < radius_) {
      at = radius_ * direction;
      at.z() += direction.z() < 0.0 ? -half_.z() : half_.z();
    } else {
      const double angle = 2.0 * std::numbers::pi * u;
      at = {radius_ * std::cos(angle), radius_ * std::sin(angle), (2.0 * v - 1.0) * half_.z()};
    }
  } else {
    const double radius = radius_ + growth_;
    const double half = half_.z() + growth_;
    const double angle = 2.0 * std::numbers::pi * u;
    const bool isCap = which * (radius + 2.0 * half) < radius;
    const double across = isCap ? radius * std::sqrt(v) : radius;
    at = {across * std::cos(angle), across * std::sin(angle),
          isCap ? (direction.z() < 0.0 ? -half : half) : (2.0 * v - 1.0) * half};
  }
  return body_from_shape_ * at;
}

std::vector<ConvexField> fieldsOf(std::span<const EnclosingSphere> spheres) {
  return {spheres.begin(), spheres.end()};
}

std::vector<ConvexField> fieldsOf(std::span<const PosedShape> shapes, double growth) {
  std::vector<ConvexField> fields;
  for (const PosedShape& posed : shapes) fields.emplace_back(posed, growth);
  return fields;
}

double outsideAll(const Vector3d& point, std::span<const ConvexField> fields) {
  double least = kNothing;
  for (const ConvexField& field : fields) least = std::min(least, field.value(point));
  return least;
}

}  // namespace swept::detail
