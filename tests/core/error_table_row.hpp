// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "error_table_judge.hpp"
#include "error_table_shapes.hpp"

namespace error_table {

/// Draws the pairs of one row, in either order, over all scales and ratios of sizes.
class RowSampler {
 public:
  RowSampler(const Kind& first, const Kind& second, std::uint64_t seed)
      : first_(first), second_(second), random_(seed) {}

  Row run(int apart, int overlapping) {
    for (int i = 0; i < apart; ++i) {
      draw(i);
      Placement placement = areFlat() ? parallel(1.0) : placeApart(a(), b(), random_);
      count(placement);
      Judge(solidA(), solidB(), placement, row_).distances();
    }
    for (int i = 0; i < overlapping; ++i) {
      draw(i);
      overlap();
    }
    return std::move(row_);
  }

 private:
  /// m, of the smaller and the larger.
  static constexpr std::array<std::array<double, 2>, 12> kSizes = {{{1e-6, 1e-6},
                                                                    {1e-6, 1e-3},
                                                                    {1e-6, 1.0},
                                                                    {1e-3, 1e-3},
                                                                    {1e-3, 1.0},
                                                                    {1e-3, 1e3},
                                                                    {1.0, 1.0},
                                                                    {1.0, 1e3},
                                                                    {1.0, 1e6},
                                                                    {1e3, 1e3},
                                                                    {1e3, 1e6},
                                                                    {1e6, 1e6}}};

  Solid& solidA() { return swapped_ ? *other_ : *one_; }
  Solid& solidB() { return swapped_ ? *one_ : *other_; }
  const Body& a() { return solidA().body; }
  const Body& b() { return solidB().body; }
  bool areFlat() { return a().isFlat() && b().isFlat(); }

  void draw(int i) {
    std::array<double, 2> sizes = kSizes[i % kSizes.size()];
    if (random_.chance(0.5)) std::swap(sizes[0], sizes[1]);
    one_ = first_.draw(random_, sizes[0]);
    other_ = second_.draw(random_, sizes[1]);
    swapped_ = random_.chance(0.5);
  }

  void count(const Placement& placement) {
    const auto index = [](Feature f) { return static_cast<std::size_t>(f); };
    ++row_.featuresA[index(swapped_ ? placement.featureB : placement.featureA)];
    ++row_.featuresB[index(swapped_ ? placement.featureA : placement.featureB)];
  }

  void overlap() {
    if (!a().convex || !b().convex) return;
    if (areFlat()) {
      if (!a().halfSpace && !b().halfSpace) return;  // parallel planes do not overlap
      Judge(solidA(), solidB(), parallel(-1.0), row_).depths(false);
    } else if (a().isFlat() || b().isFlat()) {
      Judge(solidA(), solidB(), placeAcross(a(), b(), random_), row_).depths(true);
    } else if (a().rolling + b().rolling > 0.0 && (random_.chance(0.5) || isThin())) {
      Judge(solidA(), solidB(), placeShallow(a(), b(), random_), row_).depths(false);
    } else {
      Judge(solidA(), solidB(), placeDeep(a(), b(), random_), row_).depths(true);
    }
  }

  /// The difference of the cores has no inside: the balls around them are all the depth there is.
  bool isThin() {
    const auto dimension = [](const Body& body) {
      if (body.isCurved() || body.faces.size() > 2) return 3;
      return body.faces.size() == 2 ? 2 : static_cast<int>(body.points.size()) - 1;
    };
    return dimension(a()) + dimension(b()) < 3;
  }

  /// Planes and half-spaces with normals that are parallel to the last bit, at a gap of either
  /// sign; half-spaces face each other.
  Placement parallel(double sign) {
    Touch touch;
    touch.linear = random_.permutation();
    touch.featureA = touch.featureB = Feature::Face;
    const double way = a().halfSpace || b().halfSpace ? 1.0 : random_.sign();
    const double facing = a().halfSpace || random_.chance(0.5) ? way : -way;
    const Vector3d normalB = -facing * touch.linear.transpose() * a().size;
    solidB().body.size = normalB;
    std::visit(
        [&](auto& flat) {
          if constexpr (requires { flat.normal; }) flat.normal = normalB;
        },
        solidB().shape);
    touch.n = unit(real(a().size)) * Real(facing);
    const double spread = std::max(a().extent, b().extent);
    const Point pointA = supportOfCore(a(), touch.n, spread, random_).point;
    const Point pointB = supportOfCore(b(), touch.n, spread, random_).point;
    touch.shift = pointA - ExactTurn(touch.linear) * pointB;
    return placedAlong(touch, Real(sign * spread * random_.decades(-12.0, 1.0)));
  }

  const Kind& first_;
  const Kind& second_;
  Random random_;
  std::optional<Solid> one_, other_;
  bool swapped_ = false;
  Row row_;
};

}  // namespace error_table
