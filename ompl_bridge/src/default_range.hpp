// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/SpaceInformation.h>

namespace swept::detail {

/// Longest motion of a tree, in the metric of the space: see CertifiedConnect::setRange().
double defaultRange(const ompl::base::SpaceInformation& si);

}  // namespace swept::detail
