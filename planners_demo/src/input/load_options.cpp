// SPDX-License-Identifier: BSD-3-Clause
#include "input/load_options.hpp"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "command_line/exit_code.hpp"
#include "input/robot_loading.hpp"

namespace swept {
namespace {

std::vector<PackageFolder> packageFolders(const Arguments& args) {
  std::vector<PackageFolder> folders;
  for (const std::string& text : args.packages) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      throw UsageError("--package '" + text + "': expected NAME=DIR");
    PackageFolder folder{.name = text.substr(0, equals), .folder = text.substr(equals + 1)};
    if (!std::filesystem::is_directory(folder.folder))
      throw UsageError("--package " + folder.name + ": no folder '" + folder.folder.string() + "'");
    folders.push_back(std::move(folder));
  }
  return folders;
}

}  // namespace

LoadOptions loadOptionsOf(const Arguments& args, Warnings& warnings) {
  return {.packages = packageFolders(args),
          .modelFrame = {},
          .warn = [&](const std::string& line) { warnings(line); },
          .everyWarning = args.verbose,
          .warnOfUnchecked = [&](const std::string& line) { warnings.ofUnchecked(line); },
          .progress = {},
          .cache = cacheFolder()};
}

}  // namespace swept
