// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "model/pair_model.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/simd_bodies.hpp"
#include "simd/compile/simd_model.hpp"
#include "simd/compile/simd_references.hpp"
#include "simd/compile/single.hpp"

namespace swept::detail {

namespace {

/// The pairs of a model in the form of the SIMD tier, and the obstacles.
class SimdCompiler {
 public:
  SimdCompiler(const PairModel& model, const PairModel* like, const SimdModel* likeSimd)
      : model_(model), like_(like), likeSimd_(likeSimd) {}

  SimdModel compile() {
    const bool sameBodies =
        like_ != nullptr && likeSimd_->usable && like_->robotGeometry.shares(model_.robotGeometry);
    if (sameBodies) shareSimdBodies(*likeSimd_, simd_);
    simd_.usable = sameBodies || compileSimdBodies(model_, simd_);
    if (!simd_.usable) return std::move(simd_);
    addPairs();
    addReferences(sameBodies);
    addMargins();
    addTube();
    if (!simd_.usable) return std::move(simd_);
    simd_.rootRows = compileRootRows(simd_);
    simd_.obstacles =
        compileObstacles(model_.worldGeometry, simd_.reach, reachIsBounded(), simd_.obstacleExtras,
                         like_ != nullptr ? &likeSimd_->obstacles : nullptr, simd_.farther);
    return std::move(simd_);
  }

 private:
  /// Only for geometry that is paired with the obstacles.
  bool reachIsBounded() const {
    return std::ranges::none_of(simd_.worldBodies, [this](int body) {
      return std::ranges::any_of(simd_.ancestors[body], [this](int ancestor) {
        return slidesFreely(model_.kinematics.bodies[ancestor].type);
      });
    });
  }

  void addPairs() {
    const std::size_t obstacles = model_.worldGeometry.size();
    const std::size_t geometries = model_.robotGeometry.size();
    simd_.pairOf.assign(geometries * obstacles, -1);
    simd_.pairOfGeometries.assign(geometries * geometries, -1);
    simd_.sources.reserve(model_.pairCount());
    references_.assign(simd_.bodies.size(), -1);
    references_[0] = 0;
    std::vector<char> meetsWorld(simd_.bodies.size(), 0);
    // For a first body and each second one, the index into bodyPairs; -1: none yet.
    std::vector<std::vector<std::int32_t>> known(simd_.bodies.size());
    const auto addWithWorld = [&](int a, int b) {
      simd_.pairOf[a * obstacles + b] = static_cast<std::int32_t>(simd_.sources.size());
      simd_.sources.push_back({a, b, 0, 0});
      meetsWorld[model_.robotGeometry[a].body] = 1;
    };
    for (const WorldPair& pair : model_.worldPairs) addWithWorld(pair.a, pair.b);
    for (const GeometryPair& pair : model_.pairs) {
      const std::size_t i = simd_.sources.size();
      const int bodyA = model_.robotGeometry[pair.a].body;
      if (!pair.self) {
        addWithWorld(pair.a, pair.b);
        continue;
      }
      simd_.pairOfGeometries[pair.a * geometries + pair.b] = static_cast<std::int32_t>(i);
      const int bodyB = model_.robotGeometry[pair.b].body;
      if (known[bodyA].empty()) known[bodyA].resize(simd_.bodies.size(), -1);
      std::int32_t& at = known[bodyA][bodyB];
      if (at < 0) {
        at = static_cast<std::int32_t>(simd_.bodyPairs.size());
        simd_.bodyPairs.push_back({.bodyA = bodyA,
                                   .bodyB = bodyB,
                                   .reference = referenceOf(pair.reference),
                                   .table = {}});
      }
      simd_.sources.push_back({pair.a, -1, pair.b, at});
    }
    addWorldBodies(meetsWorld);
  }

  void addWorldBodies(const std::vector<char>& meetsWorld) {
    std::vector<char> carries(simd_.bodies.size(), 0);
    for (std::size_t body = simd_.bodies.size(); body-- > 1;) {
      if (!meetsWorld[body]) continue;
      simd_.worldBodies.push_back(static_cast<int>(body));
      for (int at = simd_.bodies[body].parent; at > 0; at = simd_.bodies[at].parent)
        carries[at] = 1;
    }
    const auto others = std::ranges::stable_partition(
        simd_.worldBodies, [&carries](int body) { return carries[body] == 0; });
    simd_.worldTips = simd_.worldBodies.size() - others.size();
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
    const auto same = [](const SimdReference& reference, int body) {
      return reference.body == body;
    };
    if (sameBodies && std::ranges::equal(likeSimd_->references, referenceBodies_, same)) {
      simd_.references = likeSimd_->references;
      simd_.carried = likeSimd_->carried;
    } else {
      compileReferences(model_, referenceBodies_, simd_);
    }
  }

  /// All rounded up, so that no margin is lost.
  void addMargins() {
    double least = model_.pairCount() == 0 ? model_.options.margin : model_.pair(0).kept();
    double most = least;
    for (std::size_t i = 0; i < model_.pairCount(); ++i) {
      const double kept = model_.pair(i).kept();
      least = std::min(least, kept);
      most = std::max(most, kept);
    }
    simd_.margin = std::nextafter(static_cast<float>(least), 1e30F);
    if (!(most > least)) return;
    simd_.extras.resize(model_.pairCount());
    simd_.obstacleExtras.assign(model_.worldGeometry.size(), 0.0F);
    for (std::size_t i = 0; i < model_.pairCount(); ++i) {
      const GeometryPair pair = model_.pair(i);
      const float extra = std::nextafter(singleAbove(pair.kept() - least), 1e30F);
      simd_.extras[i] = extra;
      float& all = pair.self ? simd_.bodyPairs[simd_.sources[i].bodyPair].extra
                             : simd_.obstacleExtras[pair.b];
      all = std::max(all, extra);
    }
  }

  void addTube() {
    if (model_.tube.empty()) return;
    simd_.tubes.resize(model_.pairCount());
    simd_.worldTube.assign(simd_.bodies.size(), 0.0F);
    for (std::size_t i = 0; i < model_.pairCount(); ++i) {
      const GeometryPair pair = model_.pair(i);
      // Without a bound on it, only exact geometry may have one.
      if (!std::isfinite(pair.tube)) simd_.usable = false;
      const float tube = simd_.tubes[i] = singleAbove(pair.tube);
      float& all = pair.self ? simd_.bodyPairs[simd_.sources[i].bodyPair].tube
                             : simd_.worldTube[model_.robotGeometry[pair.a].body];
      all = std::max(all, tube);
    }
    for (SimdBodyPair& pair : simd_.bodyPairs) pair.extra += pair.tube;
    for (std::size_t i = 0; i < model_.tube.size(); ++i) {
      const JointTolerance& joint = model_.tube[i];
      simd_.tubeTurn.push_back(singleAbove(joint.rotation));
      simd_.errsByTurns.push_back(
          joint.translation == 0.0 && (joint.rotation == 0.0 || !floats(simd_.bodies[i].kind)) ? 1
                                                                                               : 0);
    }
  }

  const PairModel& model_;
  const PairModel* like_;
  const SimdModel* likeSimd_;
  SimdModel simd_;
  std::vector<int> referenceBodies_{0};
  std::vector<int> references_;  ///< per body: its index into referenceBodies_; -1: none
};

}  // namespace

std::vector<SimdRootRow> compileRootRows(const SimdModel& simd) {
  const auto radiusOf = [&](int body) { return simd.nodes[simd.rootOfBody[body]].radius; };
  const std::size_t eights = (simd.bodies.size() + kLanes - 1) / kLanes;
  // For a first body and each group of eight others, the index into rows; -1: none yet.
  std::vector<std::vector<std::int32_t>> known(simd.bodies.size());
  std::vector<SimdRootRow> rows;
  for (std::size_t i = 0; i < simd.bodyPairs.size(); ++i) {
    const SimdBodyPair& pair = simd.bodyPairs[i];
    const int eight = pair.bodyB / kLanes;
    const int lane = pair.bodyB % kLanes;
    if (known[pair.bodyA].empty()) known[pair.bodyA].resize(eights, -1);
    std::int32_t& at = known[pair.bodyA][eight];
    if (at < 0) {
      at = static_cast<std::int32_t>(rows.size());
      SimdRootRow& added = rows.emplace_back();
      added.radii = added.keep = Row{};
      added.body = pair.bodyA;
      added.eight = eight;
    }
    SimdRootRow& row = rows[at];
    row.radii.lane[lane] = radiusOf(pair.bodyA) + radiusOf(pair.bodyB);
    row.keep.lane[lane] = (simd.margin + pair.extra) * kMarginOutward;
    row.pairs[lane] = static_cast<std::int32_t>(i);
    row.checked |= 1U << lane;
  }
  return rows;
}

SimdModel compileSimdModel(const PairModel& model, const PairModel* like,
                           const SimdModel* likeSimd) {
  return SimdCompiler(model, like, likeSimd).compile();
}

}  // namespace swept::detail
