// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace swept::detail {

/// Shortens a message: names and values of a file may be as long as the file. A word of more than
/// 512 bytes, and a message of more than 4000 bytes, lose their middle. The error comes first in a
/// message, the allowed values last. UTF-8 characters stay whole; a zero byte becomes `\u0000`.
std::string shortMessage(std::string_view message);

}  // namespace swept::detail
