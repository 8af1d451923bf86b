// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace swept {

/// Text for HTML and XML, between tags or in an attribute.
std::string markupText(const std::string& text);

}  // namespace swept
