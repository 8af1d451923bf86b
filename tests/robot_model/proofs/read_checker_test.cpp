// SPDX-License-Identifier: BSD-3-Clause
// Checkers that are made from path files: what is written of them again is what they were made of.
#include "certificate/read_checker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "certificate/constraints_json.hpp"
#include "certificate/model_json.hpp"
#include "swept/core/point_cloud.hpp"
#include "swept/core/triangle_mesh.hpp"
#include "verify/model.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Every kind of joint at odd angles, two that follow another one, and a side branch.
std::shared_ptr<const Robot> everyJoint() {
  const std::pair<const char*, const char*> kJoints[] = {
      {"slide' type='prismatic",
       "<axis xyz='0.6 0 0.8'/><limit lower='-1' upper='1' effort='1' velocity='1'/>"},
      {"turn' type='continuous", "<axis xyz='0 1 0'/>"},
      {"bend' type='revolute",
       "<axis xyz='1 2 2'/><limit lower='-2' upper='2' effort='1' velocity='1'/>"},
      {"follow' type='revolute",
       "<axis xyz='0 0 1'/><limit lower='-9' upper='9' effort='1' velocity='1'/><mimic "
       "joint='bend' "
       "multiplier='-1.5' offset='0.2'/>"},
      {"creep' type='prismatic",
       "<axis xyz='0 1 0'/><limit lower='-9' upper='9' effort='1' velocity='1'/><mimic "
       "joint='slide' "
       "multiplier='0.5' offset='0.1'/>"},
      {"stay' type='fixed", ""},
      {"drive' type='planar", "<axis xyz='1 -1 0.5'/>"},
      {"float' type='floating", ""}};
  std::string links = "<link name='l0'/>", joints;
  int i = 0;
  for (const auto& [name, more] : kJoints) {
    const std::string parent = "l" + std::to_string(i), child = "l" + std::to_string(++i);
    links += "<link name='" + child + "'><collision><geometry><sphere radius='0." +
             std::to_string(i) + "'/></geometry></collision></link>";
    joints += std::string("<joint name='") + name + "'><parent link='" + parent +
              "'/><child link='" + child + "'/><origin xyz='1.3 0.1 0.2' rpy='" +
              std::to_string(0.3 * i) + " -0.4 0.5'/>" + more + "</joint>";
  }
  return Robot::parse("<robot name='odd'>" + links + joints + "</robot>", "odd.urdf",
                      "<robot name='odd'><group name='some'><joint name='slide'/><joint "
                      "name='bend'/><joint name='drive'/></group><disable_collisions link1='l1' "
                      "link2='l3' reason='Never'/><disable_collisions link1='l1' link2='l4'/>"
                      "<enable_collisions link1='l2' link2='l3'/></robot>",
                      "odd.srdf");
}

std::shared_ptr<const World> everyShape() {
  const auto world = std::make_shared<World>();
  const Isometry3d far(Translation3d(6, 1, 2) *
                       Eigen::AngleAxisd(0.3, Eigen::Vector3d(2, -1, 2) / 3.0));
  world->add(
      WorldBody{.name = "round", .parts = {{makeSphere(0.5), far}, {makeCapsule(0.2, 0.75), far}}});
  world->add(WorldBody{.name = "l2",
                       .parts = {{makeCylinder(0.25, 1.5), far}, {makeBox({1, 2, 3}), far}}});
  world->add(WorldBody{.name = "floor",
                       .parts = {{HalfSpace{.normal = Eigen::Vector3d::UnitZ(), .offset = -9.0},
                                  Isometry3d::Identity()}}});
  const std::vector<Eigen::Vector3d> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<TriangleMesh::Triangle> faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  world->add(WorldBody{.name = "hull", .parts = {{ConvexHull::of(corners), far}}});
  world->add(WorldBody{.name = "solid", .parts = {{TriangleMesh::build(corners, faces), far}}});
  world->add(WorldBody{
      .name = "cloud",
      .parts = {{PointCloud::build(corners, std::vector<double>{0.1, 0.2, 0.3, 0.4}), far},
                {PointCloud::build(corners, 0.05), far}}});
  return world;
}

CheckerOptions everyOption(const Robot& robot) {
  CheckerOptions options;
  options.margin = 0.001;
  options.selfMargin = 0.0005;
  options.tolerance = 0.002;
  options.rules.pad("l5", 0.01).pad("round", 0.02).allow("l6", "l1", "a hose").allow("l7", "cloud");
  options.attached = {{.name = "cup",
                       .link = "l6",
                       .parts = {{makeSphere(0.05), Isometry3d(Translation3d(0, 0, 0.2))}},
                       .touchLinks = {"l5", "l4"}}};
  options.tracking.rotation = 0.001;
  options.tracking.joints["slide"] = {.translation = 0.002};
  options.reference = robot.defaultState();
  for (const auto& [name, value] : {std::pair{"turn", 0.4},
                                    {"float/trans_x", 0.25},
                                    {"float/rot_w", 0.6},
                                    {"float/rot_x", 0.8}})
    (*options.reference)[*robot.findVariable(name)] = value;
  options.constraints = {
      .joints = {{.joint = "slide", .position = 0.5, .above = 0.75, .below = kInfinity},
                 {.joint = "drive/theta", .above = 2.0, .below = 1.0}},
      .positions = {{.frame = {.body = "cup"},
                     .reference = {.body = "l2"},
                     .regions = {{.size = {4.0, 5.0, kInfinity}},
                                 {.type = ConstraintRegion::Type::Cylinder, .size = {9, 8, 0}},
                                 {.type = ConstraintRegion::Type::Sphere, .size = {3, 0, 0}}}}},
      .orientations = {{.frame = {.body = "l4"}, .tolerance = {0.5, 1.5, kInfinity}},
                       {.frame = {.body = "l3"},
                        .tolerance = {0.5, 2.0, 0.5},
                        .parameterization =
                            OrientationConstraint::Parameterization::RotationVector}},
      .axes = {
          {.frame = {.body = "l3"}, .axis = {0, -3, 0}, .direction = {0, -1, 0}, .angle = 0.1}}};
  return options;
}

Json pathOf(const Checker& checker) {
  return {{"robot", checker.robot().name()},
          {"group", checker.group().name},
          {"tolerance", checker.options().tolerance},
          {"constraints", constraintsJson(checker)},
          {"model", modelJson(checker)}};
}

class ReadChecker : public testing::Test {
 protected:
  Json written(const std::string& group) const {
    return pathOf(Checker(robot_, group, everyShape(), everyOption(*robot_)));
  }
  static std::string refusal(const Json& path) {
    try {
      CheckerReader().read(path);
    } catch (const verify::Refusal& refusal) {
      return refusal.what();
    }
    return {};
  }
  std::shared_ptr<const Robot> robot_ = everyJoint();
};

/// But for reasons, and for the order of a mesh's triangles and a cloud's points.
TEST_F(ReadChecker, IsWhatWasWritten) {
  const Json path = written("some");
  CheckerReader reader;
  const auto made = reader.read(path);
  Json own = pathOf(*made), wanted = path;
  const auto lastShapes = [](Json& json) -> Json& { return json["model"]["bodies"]; };
  ASSERT_EQ(lastShapes(own).size(), lastShapes(wanted).size());
  for (Json* json : {&own, &wanted}) {
    for (Json& body : lastShapes(*json))
      for (Json& shape : body["shapes"])
        for (const char* key : {"vertices", "triangles", "points", "radii"})
          if (shape.contains(key) && shape[key].is_string()) shape[key] = shape[key].size();
    for (Json& pair : (*json)["model"]["allowed"]) pair.erase(2);
  }
  EXPECT_EQ(own.dump(1), wanted.dump(1));
  EXPECT_EQ(path["model"]["bodies"].size(), 8U + 1U + 6U);
  EXPECT_EQ(path["model"]["asked"].size(), 1U);
  EXPECT_EQ(path["model"]["tracking"].size(), 3U);
  EXPECT_GE(path["model"]["allowed"].size(), 7U);
  // The same pairs, in another file with the shapes that are there already.
  EXPECT_EQ(reader.read(path)->checkedPairs().size(), made->checkedPairs().size());
}

TEST_F(ReadChecker, AnswersAsTheOneThatWasWritten) {
  CheckerOptions options = everyOption(*robot_);
  options.constraints = {};
  const Checker checker(robot_, "some", everyShape(), options);
  const auto made = CheckerReader().read(pathOf(checker));
  Workspace own(*made), wanted(checker);
  int free = 0, colliding = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<double> q;
    for (int k = 0; k < 5; ++k) q.push_back(1.9 * std::sin(1.0 + 7.3 * i + 2.9 * k));
    q[0] *= 0.5;
    const StateReport a = made->reportState(q, own), b = checker.reportState(q, wanted);
    ASSERT_EQ(a.verdict, b.verdict) << i;
    EXPECT_NEAR(a.clearance, b.clearance, 1e-9) << i;
    free += a.verdict == Verdict::Free;
    colliding += a.verdict == Verdict::Collision;
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(colliding, 20);
}

TEST_F(ReadChecker, RefusesWhatItCannotMake) {
  const Json path = written("some");
  Json none = path;
  none.erase("model");
  EXPECT_EQ(refusal(none), "the path: there is no model");
  Json joint = path;
  joint["model"]["joints"][0]["type"] = "screw";
  EXPECT_EQ(refusal(joint), "joints: no type of joint 'screw'");
  Json plane = path;
  plane["model"]["joints"][6]["planar_x"] = plane["model"]["joints"][6]["axis"];
  EXPECT_EQ(refusal(plane), "joint drive: x of its plane is not that of its axis here");
  Json variable = path;
  variable["model"]["variables"][0]["name"] = "glide";
  EXPECT_EQ(refusal(variable), "variable glide: it is of no joint");
  Json shape = path;
  shape["model"]["bodies"][0]["shapes"][0]["type"] = "torus";
  EXPECT_EQ(refusal(shape), "shapes: no type of shape 'torus'");
  Json pairs = path;
  pairs["model"]["allowed"].push_back({"l1", "l7", "who knows"});
  EXPECT_EQ(refusal(pairs), "allowed: the names of pairs cannot be rules");
  Json constraint = path;
  constraint["constraints"][0]["kind"] = "mood";
  EXPECT_EQ(refusal(constraint), "constraints: no kind 'mood'");
}

}  // namespace
}  // namespace swept
