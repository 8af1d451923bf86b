// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

/// The folder of data from outside the project that SWEPT_DATA names, for whoever has it; none
/// where that is not set or empty: what needs the data is skipped then. Throws std::runtime_error
/// where there is no such folder.
inline std::optional<std::filesystem::path> dataFolder() {
  const char* folder = std::getenv("SWEPT_DATA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  if (!std::filesystem::is_directory(folder))
    throw std::runtime_error("SWEPT_DATA: no folder '" + std::string(folder) + "'");
  return folder;
}
