// SPDX-License-Identifier: BSD-3-Clause
#include "io/regular_file.hpp"

#include <system_error>

namespace swept::detail {

namespace fs = std::filesystem;

std::string whyUnreadable(const fs::path& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return std::string(kNoSuchFile);
  if (!fs::status_known(status)) return "file cannot be read: " + error.message();
  return fs::is_regular_file(status) ? "" : "not a regular file";
}

}  // namespace swept::detail
