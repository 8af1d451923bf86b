// SPDX-License-Identifier: BSD-3-Clause
#include "io/urdf_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "io/mesh_store.hpp"
#include "io/urdfdom_parse.hpp"
#include "robot/joint_types.hpp"
#include "swept/robot_model/limits.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Eigen::Vector3d toEigen(const urdf::Vector3& v) {
  return {v.x, v.y, v.z};
}

Eigen::Isometry3d toEigen(const urdf::Pose& pose) {
  double x = 0.0, y = 0.0, z = 0.0, w = 1.0;
  pose.rotation.getQuaternion(x, y, z, w);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.linear() = Eigen::Quaterniond(w, x, y, z).normalized().toRotationMatrix();
  result.translation() = toEigen(pose.position);
  return result;
}

class Assembler {
 public:
  Assembler(const UrdfOutline& outline, const InputSource& source)
      : outline_(outline),
        source_(source),
        model_(parseWithUrdfdom(outline.reduced, source)),
        meshes_(source) {}

  RobotParts assemble(const SrdfDocument& srdf, const InputSource& srdfSource);

 private:
  void addVirtualJoint(const SrdfDocument& srdf, const InputSource& srdfSource);
  void requireMeshes() const;
  void addLink(const UrdfOutline::Link& link, int parentJoint);
  int addJoint(const UrdfOutline::Joint& joint, int parentLink);
  /// The link's `piece`-th; a mesh is put there by addMeshes().
  CollisionGeometry geometry(const urdf::Collision& collision,
                             const UrdfOutline::Collision& outline, const std::string& owner,
                             std::size_t piece);
  void addMeshes();
  void addVariables(int jointIndex);
  void resolveMimic(int jointIndex);
  void warnOfMimicRange(const Joint& joint);
  void boundMaster(const Joint& follower);

  const UrdfOutline& outline_;
  const InputSource& source_;
  urdf::ModelInterfaceSharedPtr model_;
  /// Where a mesh belongs.
  struct MeshPlace {
    std::size_t link;
    std::size_t piece;
    MeshReference mesh;
  };
  MeshStore meshes_;
  std::vector<MeshPlace> meshPlaces_;
  std::set<const SphereCover*> withCover_;
  RobotParts parts_;
};

RobotParts Assembler::assemble(const SrdfDocument& srdf, const InputSource& srdfSource) {
  parts_.name = outline_.robotName;
  addVirtualJoint(srdf, srdfSource);
  requireMeshes();
  std::map<std::string, const UrdfOutline::Link*> links;
  for (const auto& link : outline_.links) links.emplace(link.name, &link);
  std::map<std::string, std::vector<const UrdfOutline::Joint*>> children;
  for (const auto& joint : outline_.joints) children[joint.parent].push_back(&joint);

  // Depth first, so that a chain's joints lie together; a stack, since depth is the user's choice.
  std::vector<std::pair<const UrdfOutline::Joint*, int>> pending;
  const auto visit = [&](const std::string& name, int parentJoint) {
    addLink(*links.at(name), parentJoint);
    const auto& joints = children[name];
    const int link = static_cast<int>(parts_.links.size()) - 1;
    for (auto j = joints.rbegin(); j != joints.rend(); ++j) pending.emplace_back(*j, link);
  };
  visit(model_->getRoot()->name, parts_.joints.empty() ? -1 : 0);
  while (!pending.empty()) {
    const auto [joint, parentLink] = pending.back();
    pending.pop_back();
    visit(joint->child, addJoint(*joint, parentLink));
  }
  addMeshes();
  const int count = static_cast<int>(parts_.joints.size());
  for (int j = 0; j < count; ++j) addVariables(j);
  for (int j = 0; j < count; ++j) resolveMimic(j);
  for (const Joint& joint : parts_.joints) boundMaster(joint);
  return std::move(parts_);
}

void Assembler::addVirtualJoint(const SrdfDocument& srdf, const InputSource& srdfSource) {
  parts_.modelFrame = model_->getRoot()->name;
  if (!srdf.virtualJoint) return;
  const SrdfDocument::VirtualJoint& given = *srdf.virtualJoint;
  const std::string owner = "virtual joint '" + given.name + "'";
  const std::string root = model_->getRoot()->name;
  if (given.child != root) {
    srdfSource.fail(given.line, owner + ": its child link '" + given.child +
                                    "' must be the root link '" + root + "'");
  }
  if (model_->getJoint(given.name)) {
    srdfSource.fail(given.line, owner + ": the URDF has a joint of that name");
  }
  // The frame that the root link moves in needs a name other than the link's.
  parts_.modelFrame = given.parentFrame.empty() ? "world" : given.parentFrame;
  Joint joint;
  joint.name = given.name;
  joint.type = given.type;
  joint.childLink = 0;
  joint.axis = Eigen::Vector3d::UnitZ();  // an SRDF has no axis: a planar base moves on the ground
  parts_.joints.push_back(joint);
}

/// Called before the first mesh is read, so that one message names all that are missing.
void Assembler::requireMeshes() const {
  std::vector<MeshReference> references;
  for (const UrdfOutline::Link& link : outline_.links)
    for (const UrdfOutline::Collision& collision : link.collisions)
      if (!collision.mesh.empty())
        references.push_back({collision.mesh, collision.shapeLine, "link '" + link.name + "'"});
  meshes_.requireFound(references);
}

void Assembler::addMeshes() {
  std::vector<MeshReference> references;
  for (const MeshPlace& place : meshPlaces_) references.push_back(place.mesh);
  meshes_.prepare(references);
  for (const MeshPlace& place : meshPlaces_) {
    CollisionGeometry& geometry = parts_.links[place.link].collision[place.piece];
    const MadeMesh& made = meshes_.get(place.mesh);
    geometry.shape = *made.mesh;
    geometry.cover = made.cover;
    const bool isFirst = withCover_.insert(made.cover.get()).second;
    geometry.coverSeconds = isFirst ? made.coverSeconds : 0.0;
  }
}

void Assembler::addLink(const UrdfOutline::Link& link, int parentJoint) {
  const urdf::LinkConstSharedPtr model = model_->getLink(link.name);
  const std::string owner = "link '" + link.name + "'";
  if (!model || model->collision_array.size() != link.collisions.size()) {
    source_.fail(link.line, owner + ": urdfdom and the strict pass disagree on its collisions");
  }
  Link result;
  result.name = link.name;
  result.parentJoint = parentJoint;
  result.hasVisual = link.hasVisual;
  for (std::size_t i = 0; i < link.collisions.size(); ++i) {
    result.collision.push_back(geometry(*model->collision_array[i], link.collisions[i], owner, i));
  }
  parts_.links.push_back(std::move(result));
}

CollisionGeometry Assembler::geometry(const urdf::Collision& collision,
                                      const UrdfOutline::Collision& outline,
                                      const std::string& owner, std::size_t piece) {
  const Eigen::Isometry3d pose = toEigen(collision.origin);
  if (outline.capsule) return {*outline.capsule, pose, "capsule"};
  switch (collision.geometry->type) {
    case urdf::Geometry::SPHERE: {
      const auto& sphere = dynamic_cast<const urdf::Sphere&>(*collision.geometry);
      return {makeSphere(sphere.radius), pose, "sphere"};
    }
    case urdf::Geometry::BOX: {
      const auto& box = dynamic_cast<const urdf::Box&>(*collision.geometry);
      return {makeBox(toEigen(box.dim)), pose, "box"};
    }
    case urdf::Geometry::CYLINDER: {
      const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(*collision.geometry);
      return {makeCylinder(cylinder.radius, cylinder.length), pose, "cylinder"};
    }
    case urdf::Geometry::MESH:
      break;
  }
  const auto& mesh = dynamic_cast<const urdf::Mesh&>(*collision.geometry);
  meshPlaces_.push_back(
      {parts_.links.size(), piece, {mesh.filename, outline.shapeLine, owner, toEigen(mesh.scale)}});
  return {Sphere{0.0}, pose, mesh.filename};  // until addMeshes()
}

int Assembler::addJoint(const UrdfOutline::Joint& joint, int parentLink) {
  const urdf::JointConstSharedPtr model = model_->getJoint(joint.name);
  Joint result;
  result.name = joint.name;
  result.type = joint.type;
  result.parentLink = parentLink;
  result.childLink = static_cast<int>(parts_.links.size());
  result.parent_from_joint = toEigen(model->parent_to_joint_origin_transform);
  if (hasAxis(joint.type)) result.axis = toEigen(model->axis).normalized();
  parts_.joints.push_back(std::move(result));
  return static_cast<int>(parts_.joints.size()) - 1;
}

void Assembler::addVariables(int jointIndex) {
  Joint& joint = parts_.joints[jointIndex];
  const urdf::JointConstSharedPtr model = model_->getJoint(joint.name);
  if (joint.type == JointType::Fixed || (model && model->mimic)) return;
  joint.firstVariable = static_cast<int>(parts_.variables.size());
  const auto add = [&](const std::string& suffix, double lower, double upper, bool cyclic) {
    parts_.variables.push_back({joint.name + suffix, jointIndex, lower, upper, cyclic});
    if (valueCount(joint.type) == 1 && model->limits && model->limits->velocity > 0.0)
      parts_.variables.back().velocity = model->limits->velocity;
  };
  constexpr double pi = std::numbers::pi;
  switch (joint.type) {
    case JointType::Fixed:
      break;
    case JointType::Revolute:
    case JointType::Prismatic:
      add("", model->limits->lower, model->limits->upper, false);
      break;
    case JointType::Continuous:
      add("", -pi, pi, true);
      break;
    case JointType::Planar:
      for (const char* name : {"/x", "/y"}) add(name, -kInfinity, kInfinity, false);
      add("/theta", -pi, pi, true);
      break;
    case JointType::Floating:
      for (const char* name : {"/trans_x", "/trans_y", "/trans_z"}) {
        add(name, -kInfinity, kInfinity, false);
      }
      for (const char* name : {"/rot_x", "/rot_y", "/rot_z", "/rot_w"}) add(name, -1.0, 1.0, false);
      break;
  }
}

void Assembler::resolveMimic(int jointIndex) {
  Joint& joint = parts_.joints[jointIndex];
  urdf::JointConstSharedPtr at = model_->getJoint(joint.name);
  if (!at || !at->mimic) return;
  Mimic mimic{-1, 1.0, 0.0};
  for (; at->mimic; at = model_->getJoint(at->mimic->joint_name)) {
    mimic.offset += mimic.multiplier * at->mimic->offset;
    mimic.multiplier *= at->mimic->multiplier;
  }
  mimic.master = indexOf(parts_.joints, at->name);
  joint.mimic = mimic;
  warnOfMimicRange(joint);
}

void Assembler::warnOfMimicRange(const Joint& joint) {
  const auto& outline = outline_.joints[indexOf(outline_.joints, joint.name)];
  const Variable& master = parts_.variables[parts_.joints[joint.mimic->master].firstVariable];
  const double a = joint.mimic->multiplier * master.lower + joint.mimic->offset;
  const double b = joint.mimic->multiplier * master.upper + joint.mimic->offset;
  const std::string start = "joint '" + joint.name + "' mimics '" + master.name + "'";
  if (!std::isfinite(a) || !std::isfinite(b)) {
    source_.fail(outline.mimic->line, start + " and its values are not finite");
  }
  if (!hasLimits(joint.type)) return;
  const auto limits = model_->getJoint(joint.name)->limits;
  // A multiplier of five digits may miss a limit by a hair: that changes nothing, for the joint
  // goes where its master takes it.
  if (isWithin(a, limits->lower, limits->upper) && isWithin(b, limits->lower, limits->upper))
    return;
  source_.warn(outline.mimic->line,
               start + " and takes values in [" + formatNumber(std::min(a, b)) + ", " +
                   formatNumber(std::max(a, b)) + "], beyond its limits [" +
                   formatNumber(limits->lower) + ", " + formatNumber(limits->upper) + "]");
}

/// A cyclic variable is the same after a turn: then all joints that follow it have to be, too. Else
/// a motion through a whole turn would end where the next one does not begin.
void Assembler::boundMaster(const Joint& follower) {
  if (!follower.mimic) return;
  Joint& master = parts_.joints[follower.mimic->master];
  Variable& variable = parts_.variables[master.firstVariable];
  const double multiplier = follower.mimic->multiplier;
  const bool comesBack = turns(follower.type) && multiplier == std::round(multiplier);
  if (!variable.cyclic || comesBack) return;
  variable.cyclic = false;
  master.type = JointType::Revolute;
  source_.warn(outline_.joints[indexOf(outline_.joints, follower.name)].mimic->line,
               "joint '" + follower.name + "' mimics '" + master.name + "' times " +
                   formatNumber(multiplier) + " and is elsewhere after a turn of it: '" +
                   master.name + "', which is continuous, is read as revolute with limits [" +
                   formatNumber(variable.lower) + ", " + formatNumber(variable.upper) + "]");
}

}  // namespace

RobotParts assembleRobot(const UrdfOutline& outline, const SrdfDocument& srdf,
                         const InputSource& urdfSource, const InputSource& srdfSource) {
  return Assembler(outline, urdfSource).assemble(srdf, srdfSource);
}

}  // namespace swept::detail
