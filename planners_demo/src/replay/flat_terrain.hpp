// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "io/json_value.hpp"

namespace swept {

struct Terrain {
  Eigen::MatrixXd heights;
  double base;
};

/// Of a text: `flat, all H, RxC samples, base B`. Throws InputError.
Terrain readFlatTerrain(const JsonValue& place);

}  // namespace swept
