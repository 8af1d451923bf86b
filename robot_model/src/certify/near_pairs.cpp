// SPDX-License-Identifier: BSD-3-Clause
#include "certify/near_pairs.hpp"

#include <algorithm>
#include <numeric>

#include "model/compile.hpp"
#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// The box of a geometry, rounded outward. Infinite if the geometry is.
Aabb boxOf(const WorldGeometry& geometry) {
  const Eigen::Isometry3d world_from_box = geometry.box_from_world.inverse();
  const Vector3d center = world_from_box.translation();
  Vector3d half = Vector3d::Constant(std::numeric_limits<double>::infinity());
  if (geometry.halfExtents.allFinite())
    half = (world_from_box.linear().cwiseAbs() * geometry.halfExtents).array() +
           kWorldBoxShare * geometry.magnitude;
  return {center - half, center + half};
}

}  // namespace

std::shared_ptr<const SweepAndPrune> compileBoxes(const CheckerModel& model,
                                                  const CheckerModel* like) {
  if (model.worldGeometry.size() < kFewestBoxes) return nullptr;
  const bool same = like != nullptr && like->world == model.world &&
                    std::ranges::equal(like->worldGeometry, model.worldGeometry, {},
                                       &WorldGeometry::scale, &WorldGeometry::scale);
  if (same) return like->boxes;
  std::vector<Aabb> boxes;
  boxes.reserve(model.worldGeometry.size());
  for (const WorldGeometry& geometry : model.worldGeometry) boxes.push_back(boxOf(geometry));
  auto manager = std::make_shared<SweepAndPrune>();
  manager->registerBoxes(boxes);
  return manager;
}

std::optional<std::uint32_t> NearGeometries::pairOf(std::size_t geometry, BoxHandle other) const {
  const std::span<const WorldPair> pairs = worldPairs(geometry);
  const auto found = std::ranges::lower_bound(pairs, static_cast<int>(other), {}, &WorldPair::b);
  if (found == pairs.end() || found->b != static_cast<int>(other)) return std::nullopt;
  return static_cast<std::uint32_t>(&*found - model_.worldPairs.data());
}

GeometryPair NearGeometries::pairOf(const PairBound& bound) const {
  if (bound.geometry < 0) return model_.pair(static_cast<std::size_t>(bound.other));
  const auto geometry = static_cast<std::size_t>(bound.geometry);
  return worldPair(model_, model_.likeWorldPairs[geometry], bound.other);
}

void NearGeometries::collectWorld(double half, double least) {
  for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i)
    if (isMeasured(i)) collectWorld(i, half, least);
}

void NearGeometries::collectWorld(std::size_t geometry, double half, double least) {
  const GeometryPair& like = model_.likeWorldPairs[geometry];
  const auto addOne = [&](std::size_t other) {
    const auto b = static_cast<std::int32_t>(other);
    if (model_.checksWorld(like.a, b))
      add(lowerBound(worldPair(model_, like, b), half), least, like.a, b);
    return least;
  };
  if (model_.boxes == nullptr) {
    for (std::size_t k = 0; k < model_.worldGeometry.size(); ++k) addOne(k);
  } else {
    model_.boxes->distance(query_.ballBox(like, half), workspace_.boxes,
                           [&](BoxHandle other, double) { return addOne(other); });
  }
}

void NearGeometries::collectNearestBoxes(double half, double least) {
  for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
    if (!isMeasured(i)) continue;
    const GeometryPair& like = model_.likeWorldPairs[i];
    model_.boxes->distance(query_.ballBox(like, half), workspace_.boxes,
                           [&](BoxHandle other, double away) {
                             const auto b = static_cast<std::int32_t>(other);
                             if (!model_.checksWorld(like.a, b)) return least;
                             add(lowerBound(worldPair(model_, like, b), half), least, like.a, b);
                             return away;
                           });
  }
}

void NearGeometries::collect(double half, std::vector<std::uint32_t>& pairs) {
  pairs.clear();
  if (model_.boxes == nullptr) {
    pairs.resize(model_.pairCount());
    std::iota(pairs.begin(), pairs.end(), 0U);
    return;
  }
  for (std::size_t i = 0; i < model_.robotGeometry.size(); ++i) {
    if (worldPairs(i).empty()) continue;
    model_.boxes->collide(query_.ballBox(static_cast<int>(i), half), workspace_.boxes,
                          [&](BoxHandle other) {
                            if (const auto pair = pairOf(i, other)) pairs.push_back(*pair);
                            return false;
                          });
  }
  for (std::uint32_t pair = model_.firstSelfPair; pair < model_.pairCount(); ++pair)
    pairs.push_back(pair);
}

}  // namespace swept::detail
