// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "input/task.hpp"
#include "output/text_output.hpp"

namespace swept {

/// Where nothing is checked at all: which is no proof of anything.
void warnOfNothing(const Checker& checker, Warnings& warnings);

/// A line on the links that the group moves and nothing is known about; empty: there are none.
std::string uncheckedText(const Checker& checker);

/// What answers are not about, as output/unchecked_json.hpp has it.
void addUnchecked(Json& json, const Checker& checker, const Warnings& warnings);

}  // namespace swept
