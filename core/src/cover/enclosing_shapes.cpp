// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/enclosing_shapes.hpp"

#include <stdexcept>

#include "cover/endable_search.hpp"
#include "cover/shape_fit.hpp"
#include "cover/sphere_checks.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

struct EnclosingShapesSearch::Data : detail::EndableSearch<detail::ShapeFit> {};

EnclosingShapesSearch::EnclosingShapesSearch(std::span<const PosedShape> body, EnclosingKind kind,
                                             const EnclosingShapesOptions& options,
                                             const StopQuestion& stop) {
  data_ = inDefaultEnvironment([&] {
    detail::requireSphereOption("pieces", options.pieces, 1.0);
    if (body.empty()) throw std::invalid_argument("a body without shapes needs none around it");
    return std::make_unique<Data>(Data{{detail::ShapeFit(body, kind, options, stop)}});
  });
}

EnclosingShapesSearch::~EnclosingShapesSearch() = default;
EnclosingShapesSearch::EnclosingShapesSearch(EnclosingShapesSearch&&) noexcept = default;
EnclosingShapesSearch& EnclosingShapesSearch::operator=(EnclosingShapesSearch&&) noexcept = default;

int EnclosingShapesSearch::countFor(double reach) const {
  return inDefaultEnvironment([&] {
    data_->requireWhole();
    return data_->fit.countFor(reach);
  });
}

double EnclosingShapesSearch::reachFor(int count) const {
  return inDefaultEnvironment([&] {
    detail::requireSphereOption("count", count, 1.0);
    data_->requireWhole();
    return data_->fit.reachFor(count);
  });
}

EnclosingShapes EnclosingShapesSearch::atMost(int count, const StopQuestion& stop) {
  return inDefaultEnvironment([&] {
    detail::requireSphereOption("count", count, 1.0);
    return data_->ask([&](auto& fit) { return fit.atMost(count, stop); });
  });
}

EnclosingShapes EnclosingShapesSearch::within(double reach, const StopQuestion& stop) {
  return inDefaultEnvironment([&] {
    detail::requireSphereOption("reach", reach, 0.0, true);
    return data_->ask([&](auto& fit) { return fit.within(reach, stop); });
  });
}

}  // namespace swept
