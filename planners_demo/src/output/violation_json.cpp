// SPDX-License-Identifier: BSD-3-Clause
#include "output/violation_json.hpp"

#include <array>

namespace swept {

Json violationJson(const ConstraintViolation& violation, const TaskConstraint& constraints) {
  static constexpr std::array<const char*, 4> kKinds{"joint", "position", "orientation", "axis"};
  return {{"t", violation.t},
          {"kind", kKinds[static_cast<std::size_t>(violation.kind)]},
          {"index", violation.index},
          {"excess", finiteOrNull(violation.excess)},
          {"text", describe(violation, constraints)}};
}

}  // namespace swept
