// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/world.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace swept {

namespace {

/// How far a given rotation matrix may be from orthonormal: the rounding of files and of products.
constexpr double kRigid = 1e-9;

bool isRigid(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d r = pose.linear();
  const Eigen::Matrix3d defect = r * r.transpose() - Eigen::Matrix3d::Identity();
  return pose.translation().allFinite() && defect.cwiseAbs().maxCoeff() <= kRigid &&
         r.determinant() > 0.0 && pose.matrix().row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
}

}  // namespace

void World::add(WorldBody body) {
  if (find(body.name) != nullptr) {
    throw std::invalid_argument("World: a second body is named '" + body.name + "'");
  }
  for (const WorldBody::Part& part : body.parts) {
    if (!isRigid(part.world_from_shape)) {
      throw std::invalid_argument("World: a pose of body '" + body.name +
                                  "' is no finite rigid transform");
    }
  }
  bodies_.push_back(std::move(body));
}

void World::add(std::string name, Shape shape, const Eigen::Isometry3d& world_from_shape) {
  WorldBody body;
  body.name = std::move(name);
  body.parts.push_back({std::move(shape), world_from_shape});
  add(std::move(body));
}

const WorldBody* World::find(std::string_view name) const {
  const auto found = std::find_if(bodies_.begin(), bodies_.end(),
                                  [name](const WorldBody& body) { return body.name == name; });
  return found == bodies_.end() ? nullptr : &*found;
}

}  // namespace swept
