// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace swept::detail {

/// A message without what nobody reads: names and values of a file may be as long as the file. Of a
/// word of more than 512 bytes the middle is left out, and of a message of more than 4000 bytes:
/// what is at fault comes first, what is allowed last. UTF-8 characters stay whole.
std::string shortMessage(std::string_view message);

}  // namespace swept::detail
