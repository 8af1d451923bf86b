// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "input/task.hpp"
#include "output/text_output.hpp"

namespace swept {

/// The warning that nothing is checked at all, so the answer proves nothing.
void warnOfNothing(const Checker& checker, Warnings& warnings);

/// A line about links that the group moves and that have no known geometry; empty: there are none.
std::string uncheckedText(const Checker& checker);

/// The limits of an answer, in the form of output/unchecked_json.hpp.
void addUnchecked(Json& json, const Checker& checker, const Warnings& warnings);

}  // namespace swept
