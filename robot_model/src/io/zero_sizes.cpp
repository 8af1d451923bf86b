// SPDX-License-Identifier: BSD-3-Clause
#include "io/zero_sizes.hpp"

#include <type_traits>
#include <variant>

namespace swept::detail {

bool hasZeroSize(const Shape& shape) {
  return std::visit(
      [](const auto& s) {
        using S = std::remove_cvref_t<decltype(s)>;
        if constexpr (std::is_same_v<S, Box>) return s.halfExtents.minCoeff() == 0.0;
        if constexpr (std::is_same_v<S, Cylinder> || std::is_same_v<S, Cone>)
          return s.radius == 0.0 || s.halfLength == 0.0;
        if constexpr (std::is_same_v<S, Sphere> || std::is_same_v<S, Capsule>)
          return s.radius == 0.0;
        return false;
      },
      shape);
}

void warnOfZeroSize(const Shape& shape, int line, const std::string& owner,
                    WarningKinds& warnings) {
  if (hasZeroSize(shape)) warnings.add(line, owner + ": " + kZeroSize, kZeroSizes);
}

}  // namespace swept::detail
