// SPDX-License-Identifier: BSD-3-Clause
#include "certify/checker_model.hpp"

#include <atomic>
#include <cstdint>
#include <utility>

#include "certify/near_pairs.hpp"
#include "simd/tables/pair_separation_tables.hpp"
#include "threads/for_each_index.hpp"

namespace swept::detail {

namespace {

/// Of a world that is worth a thread.
constexpr std::size_t kManyPieces = 4096;

}  // namespace

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
  compileGeometry(like, *model);
  model->constraints = compileConstraints(*model);
  // Both only read the geometry. The first to fail is the pairs' exception.
  forEachIndex(2, model->worldGeometry.size() < kManyPieces ? 1 : 2, [&](std::size_t i) {
    if (i == 0)
      compilePairsOf(like, *model);
    else
      model->boxes = compileBoxes(*model, like);
  });
  const SimdModel* const likeSimd = like == nullptr ? nullptr : &like->simd;
  model->simd = compileSimdModel(*model, like, likeSimd);
  addTables(*model, likeSimd, model->simd);
  model->laneConstraints = compileLaneConstraints(*model, model->constraints, model->simd);
  return model;
}

}  // namespace swept::detail
