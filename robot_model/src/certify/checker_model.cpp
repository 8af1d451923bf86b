// SPDX-License-Identifier: BSD-3-Clause
#include "certify/checker_model.hpp"

#include <algorithm>
#include <atomic>

#include "certify/body_compile.hpp"
#include "certify/near_pairs.hpp"
#include "certify/never_compile.hpp"
#include "certify/pair_compile.hpp"

namespace swept::detail {

std::string CheckerModel::nameOfA(const GeometryPair& pair) const {
  return carriers[robotGeometry[pair.a].carrier].name;
}

std::string CheckerModel::nameOfB(const GeometryPair& pair) const {
  return pair.self ? carriers[robotGeometry[pair.b].carrier].name
                   : world->bodies()[worldGeometry[pair.b].body].name;
}

bool CheckerModel::isSelfPair(const GeometryPair& pair) const {
  return pair.self && carriers[robotGeometry[pair.b].carrier].kind != Carrier::Kind::Obstacle;
}

bool CheckerModel::checksWorld(int ofRobot, int ofWorld) const {
  const int first = firstBodyPair[robotGeometry[ofRobot].carrier];
  return first >= 0 && bodyPairs[first + worldGeometry[ofWorld].body].reason == PairReason::Checked;
}

std::shared_ptr<const CheckerModel> compileChecker(std::shared_ptr<const Robot> robot,
                                                   const Group& group,
                                                   std::shared_ptr<const World> world,
                                                   CheckerOptions options,
                                                   const CheckerModel* like) {
  static std::atomic<std::uint64_t> versions{0};
  auto model = std::make_shared<CheckerModel>();
  model->version = ++versions;
  model->robot = std::move(robot);
  model->world = std::move(world);
  model->group = group;
  model->options = std::move(options);
  if (!model->options.reference) model->options.reference = model->robot->defaultState();
  compileBodies(like, *model);
  compilePairs(*model);
  findNever(like, *model);
  model->boxes = compileBoxes(*model, like);
  model->lanes = compileLanes(*model, like);
  return model;
}

WorkspaceData::WorkspaceData(const CheckerModel& model)
    : version(model.version),
      motion(model.kinematics.bodies.size()),
      states(model.kinematics.bodies.size()),
      stateStamps(model.kinematics.bodies.size(), -1),
      placed(model.robotGeometry.size()),
      carried(model.kinematics.bodies.size()),
      arms(model.kinematics.bodies.size()),
      hints(model.pairs.size(), Eigen::Vector3d::Zero()),
      hintStamps(model.pairs.size(), -1),
      lanes(model.lanes),
      probe(model.kinematics.dimension) {
  // Bounds on travel relative to all ancestors together are a little larger than one by one.
  const bool nested = std::ranges::any_of(model.robotGeometry, [](const RobotGeometry& geometry) {
    return geometry.levers.path.size() > kLongPath;
  });
  if (nested) {
    for (const RobotGeometry& geometry : model.robotGeometry)
      nestedTravels.emplace_back(geometry.levers.path.size() + 1);
  } else {
    travels.resize(model.travels.size());
  }
  travelStamps.resize(nested ? model.robotGeometry.size() : model.travels.size(), -1);
  if (model.world->obstacles().empty()) return;
  from.resize(model.kinematics.wholeDimension);
  to.resize(model.kinematics.wholeDimension);
}

}  // namespace swept::detail
