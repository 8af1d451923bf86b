// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace swept {

/// For a file that is read twice. Throws InputError for a pipe or a device, which can be read only
/// once.
void requireReadAgain(const std::string& file);

}  // namespace swept
