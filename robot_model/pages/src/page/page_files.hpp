// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace swept {

/// A file that goes into every page, as it was when the program was built.
struct PageFile {
  std::string_view name;
  std::string_view text;
};

/// In the order in which scripts run. Defined by a source that is made when building.
std::span<const PageFile> pageFiles();

}  // namespace swept
