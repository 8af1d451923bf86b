// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "certify/checker_model.hpp"
#include "lanes/joint_tables.hpp"
#include "lanes/lane_bodies.hpp"
#include "lanes/lane_model.hpp"
#include "lanes/lane_references.hpp"
#include "lanes/root_rows.hpp"
#include "lanes/single.hpp"

namespace swept::detail {

namespace {

/// The pairs of a model as the lanes see them, and the obstacles.
class LaneCompiler {
 public:
  LaneCompiler(const CheckerModel& model, const CheckerModel* like) : model_(model), like_(like) {}

  LaneModel compile() {
    const bool sameBodies = like_ != nullptr && like_->lanes.usable &&
                            like_->robotGeometry.shares(model_.robotGeometry);
    if (sameBodies) shareLaneBodies(like_->lanes, lanes_);
    lanes_.usable = sameBodies || compileLaneBodies(model_, lanes_);
    if (!lanes_.usable) return std::move(lanes_);
    addPairs();
    addReferences(sameBodies);
    addMargins();
    lanes_.rootRows = compileRootRows(lanes_);
    addTables();
    lanes_.obstacles = compileObstacles(
        model_.worldGeometry, lanes_.reach, reachIsBounded(), lanes_.obstacleExtras,
        like_ != nullptr ? &like_->lanes.obstacles : nullptr, lanes_.farther);
    return std::move(lanes_);
  }

 private:
  /// Only of what is paired with the obstacles.
  bool reachIsBounded() const {
    return std::ranges::none_of(lanes_.worldBodies, [this](int body) {
      return std::ranges::any_of(lanes_.ancestors[body], [this](int ancestor) {
        return slidesFreely(model_.kinematics.bodies[ancestor].type);
      });
    });
  }

  void addPairs() {
    const std::size_t obstacles = model_.worldGeometry.size();
    const std::size_t geometries = model_.robotGeometry.size();
    lanes_.pairOf.assign(geometries * obstacles, -1);
    lanes_.pairOfGeometries.assign(geometries * geometries, -1);
    lanes_.sources.resize(model_.pairs.size());
    references_.assign(lanes_.bodies.size(), -1);
    references_[0] = 0;
    std::vector<char> meetsWorld(lanes_.bodies.size(), 0);
    // Of a first body and each second one, the index into bodyPairs; -1: none yet.
    std::vector<std::vector<std::int32_t>> known(lanes_.bodies.size());
    for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
      const GeometryPair& pair = model_.pairs[i];
      const int bodyA = model_.robotGeometry[pair.a].body;
      if (!pair.self) {
        lanes_.pairOf[pair.a * obstacles + pair.b] = static_cast<std::int32_t>(i);
        lanes_.sources[i] = {pair.a, pair.b, 0, 0};
        meetsWorld[bodyA] = 1;
        continue;
      }
      lanes_.pairOfGeometries[pair.a * geometries + pair.b] = static_cast<std::int32_t>(i);
      const int bodyB = model_.robotGeometry[pair.b].body;
      if (known[bodyA].empty()) known[bodyA].resize(lanes_.bodies.size(), -1);
      std::int32_t& at = known[bodyA][bodyB];
      if (at < 0) {
        at = static_cast<std::int32_t>(lanes_.bodyPairs.size());
        lanes_.bodyPairs.push_back({.bodyA = bodyA,
                                    .bodyB = bodyB,
                                    .reference = referenceOf(pair.reference),
                                    .table = {}});
      }
      lanes_.sources[i] = {pair.a, -1, pair.b, at};
    }
    for (std::size_t body = lanes_.bodies.size(); body-- > 1;)
      if (meetsWorld[body]) lanes_.worldBodies.push_back(static_cast<int>(body));
  }

  int referenceOf(int body) {
    int& reference = references_[body];
    if (reference < 0) {
      reference = static_cast<int>(referenceBodies_.size());
      referenceBodies_.push_back(body);
    }
    return reference;
  }

  void addReferences(bool sameBodies) {
    const auto same = [](const LaneReference& reference, int body) {
      return reference.body == body;
    };
    if (sameBodies && std::ranges::equal(like_->lanes.references, referenceBodies_, same)) {
      lanes_.references = like_->lanes.references;
      lanes_.carried = like_->lanes.carried;
    } else {
      compileReferences(model_, referenceBodies_, lanes_);
    }
  }

  /// All rounded up, so that no margin is lost.
  void addMargins() {
    double least = model_.pairs.empty() ? model_.options.margin : model_.pairs.front().kept();
    double most = least;
    for (const GeometryPair& pair : model_.pairs) {
      least = std::min(least, pair.kept());
      most = std::max(most, pair.kept());
    }
    lanes_.margin = std::nextafter(static_cast<float>(least), 1e30F);
    if (!(most > least)) return;
    lanes_.extras.resize(model_.pairs.size());
    lanes_.obstacleExtras.assign(model_.worldGeometry.size(), 0.0F);
    for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
      const GeometryPair& pair = model_.pairs[i];
      const float extra = std::nextafter(singleAbove(pair.kept() - least), 1e30F);
      lanes_.extras[i] = extra;
      float& all = pair.self ? lanes_.bodyPairs[lanes_.sources[i].bodyPair].extra
                             : lanes_.obstacleExtras[pair.b];
      all = std::max(all, extra);
    }
  }

  void addTables() {
    lanes_.tables = like_ == nullptr ? buildJointTables(model_, lanes_) : like_->lanes.tables;
    if (lanes_.tables != nullptr) chooseTables(model_, *lanes_.tables, lanes_);
  }

  const CheckerModel& model_;
  const CheckerModel* like_;
  LaneModel lanes_;
  std::vector<int> referenceBodies_{0};
  std::vector<int> references_;  ///< per body: of referenceBodies_; -1: none
};

}  // namespace

LaneModel compileLanes(const CheckerModel& model, const CheckerModel* like) {
  return LaneCompiler(model, like).compile();
}

}  // namespace swept::detail
