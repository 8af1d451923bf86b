// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "row.hpp"

namespace extremes {

/// Motions of robots that are hard to follow.
void stiffRows(std::vector<Row>& rows);

}  // namespace extremes
