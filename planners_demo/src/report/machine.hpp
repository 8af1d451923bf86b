// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swept {

/// Name and value of what times depend on: processor, cores, system, compiler, and the versions of
/// swept, OMPL and, where it is part of this build, FCL.
std::vector<std::pair<std::string, std::string>> machineFacts();

}  // namespace swept
