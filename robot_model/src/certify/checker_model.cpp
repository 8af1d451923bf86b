// SPDX-License-Identifier: BSD-3-Clause
#include "certify/checker_model.hpp"

#include <atomic>
#include <cstdint>
#include <utility>

#include "certify/near_pairs.hpp"
#include "simd/tables/pair_separation_tables.hpp"

namespace swept::detail {

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
  compilePairModel(like, *model);
  model->boxes = compileBoxes(*model, like);
  const SimdModel* const likeSimd = like == nullptr ? nullptr : &like->simd;
  model->simd = compileSimdModel(*model, like, likeSimd);
  addTables(*model, likeSimd, model->simd);
  return model;
}

}  // namespace swept::detail
