// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/enclosing_spheres.hpp"

#include <stdexcept>

#include "cover/endable_search.hpp"
#include "cover/sphere_checks.hpp"
#include "cover/sphere_fit.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

SearchStopped::SearchStopped() : std::runtime_error("stopped before it was done") {}

struct EnclosingSpheresSearch::Data : detail::EndableSearch<detail::SphereFit> {};

EnclosingSpheresSearch::EnclosingSpheresSearch(std::span<const PosedShape> body,
                                               const EnclosingSpheresOptions& options,
                                               const StopQuestion& stop) {
  data_ = inDefaultEnvironment([&] {
    detail::requireSphereOption("pieces", options.pieces, 1.0);
    detail::requireSphereOption("restarts", options.restarts, 1.0);
    detail::requireSphereOption("rounds", options.rounds, 0.0);
    if (body.empty()) throw std::invalid_argument("a body without shapes needs no spheres");
    return std::make_unique<Data>(Data{{detail::SphereFit(body, options, stop)}});
  });
}

EnclosingSpheresSearch::~EnclosingSpheresSearch() = default;
EnclosingSpheresSearch::EnclosingSpheresSearch(EnclosingSpheresSearch&&) noexcept = default;
EnclosingSpheresSearch& EnclosingSpheresSearch::operator=(EnclosingSpheresSearch&&) noexcept =
    default;

int EnclosingSpheresSearch::countFor(double reach) const {
  return inDefaultEnvironment([&] {
    data_->requireWhole();
    return data_->fit.countFor(reach);
  });
}

EnclosingSpheres EnclosingSpheresSearch::atMost(int count, const StopQuestion& stop) {
  return inDefaultEnvironment([&] {
    detail::requireSphereOption("count", count, 1.0);
    return data_->ask([&](auto& fit) { return fit.atMost(count, stop); });
  });
}

EnclosingSpheres EnclosingSpheresSearch::within(double reach, const StopQuestion& stop) {
  return inDefaultEnvironment([&] {
    detail::requireSphereOption("reach", reach, 0.0, true);
    return data_->ask([&](auto& fit) { return fit.within(reach, stop); });
  });
}

}  // namespace swept
