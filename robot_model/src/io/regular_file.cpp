// SPDX-License-Identifier: BSD-3-Clause
#include "io/regular_file.hpp"

#include <system_error>

namespace swept::detail {

namespace fs = std::filesystem;

namespace {

std::string whyNot(const fs::path& file, bool readOnce) {
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (status.type() == fs::file_type::not_found) return std::string(kNoSuchFile);
  if (!fs::status_known(status)) return "file cannot be read: " + error.message();
  const bool gives = readOnce && (fs::is_fifo(status) || fs::is_character_file(status));
  return gives || fs::is_regular_file(status) ? "" : "not a regular file";
}

}  // namespace

std::string whyUnreadable(const fs::path& file) {
  return whyNot(file, false);
}

std::string whyNoBytes(const fs::path& file) {
  return whyNot(file, true);
}

}  // namespace swept::detail
