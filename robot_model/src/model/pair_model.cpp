// SPDX-License-Identifier: BSD-3-Clause
#include "model/pair_model.hpp"

#include "model/compile.hpp"

namespace swept::detail {

BodyName PairModel::nameOfA(const GeometryPair& pair) const {
  return collisionBodies[robotGeometry[pair.a].collisionBody].name;
}

BodyName PairModel::nameOfB(const GeometryPair& pair) const {
  if (pair.self) return collisionBodies[robotGeometry[pair.b].collisionBody].name;
  const std::string& name = world->bodies()[worldGeometry[pair.b].body].name;
  return BodyName(std::shared_ptr<const std::string>(world, &name));
}

bool PairModel::isSelfPair(const GeometryPair& pair) const {
  return pair.self &&
         collisionBodies[robotGeometry[pair.b].collisionBody].kind != CollisionBody::Kind::Obstacle;
}

bool PairModel::checksWorld(int ofRobot, int ofWorld) const {
  const int first = firstBodyPair[robotGeometry[ofRobot].collisionBody];
  return first >= 0 && bodyPairs[first + worldGeometry[ofWorld].body].reason == PairReason::Checked;
}

void compilePairModel(const PairModel* like, PairModel& model) {
  if (!model.options.reference) model.options.reference = model.robot->defaultState();
  compileBodies(like, model);
  compileTube(model);
  compilePairs(model);
  boundTube(model);
  findNever(like, model);
}

}  // namespace swept::detail
