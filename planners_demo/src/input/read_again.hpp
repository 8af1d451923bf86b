// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace swept {

/// Of a file that is read twice. Throws InputError for a pipe or a device, whose bytes are gone by
/// then.
void requireReadAgain(const std::string& file);

}  // namespace swept
