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

GeometryPair PairModel::pair(std::size_t index) const {
  if (index >= worldPairs.size()) return pairs[index - worldPairs.size()];
  const WorldPair& of = worldPairs[index];
  GeometryPair pair = worldPair(*this, likeWorldPairs[of.a], of.b);
  const int first = firstBodyPair[robotGeometry[of.a].collisionBody];
  pair.margin = bodyPairs[first + worldGeometry[of.b].body].margin;
  if (!worldTubes.empty()) pair.tube = worldTubes[of.a];
  return pair;
}

bool PairModel::isSelfPair(const GeometryPair& pair) const {
  return pair.self &&
         collisionBodies[robotGeometry[pair.b].collisionBody].kind != CollisionBody::Kind::Obstacle;
}

bool PairModel::checksWorld(int ofRobot, int ofWorld) const {
  const int first = firstBodyPair[robotGeometry[ofRobot].collisionBody];
  return first >= 0 && bodyPairs[first + worldGeometry[ofWorld].body].reason == PairReason::Checked;
}

void compileGeometry(const PairModel* like, PairModel& model) {
  if (!model.options.reference) model.options.reference = model.robot->defaultState();
  compileBodies(like, model);
  compileTube(model);
}

void compilePairsOf(const PairModel* like, PairModel& model) {
  compilePairs(model);
  boundTube(model);
  findNever(like, model);
}

}  // namespace swept::detail
