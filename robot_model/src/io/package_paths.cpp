// SPDX-License-Identifier: BSD-3-Clause
#include "io/package_paths.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace swept::detail {

namespace fs = std::filesystem;

namespace {

/// `text` without `prefix` in front; empty when it does not start so.
std::optional<std::string> after(const std::string& text, std::string_view prefix) {
  if (!text.starts_with(prefix)) return std::nullopt;
  return text.substr(prefix.size());
}

/// `path` below package `name`: the name must end at a slash, `arm` is no match for `arm_left/x`.
std::optional<std::string> below(const std::string& path, const std::string& name) {
  if (name.empty()) return std::nullopt;
  return after(path, name.back() == '/' ? name : name + "/");
}

std::vector<std::string> rosPackagePath() {
  std::vector<std::string> entries;
  const char* variable = std::getenv("ROS_PACKAGE_PATH");
  std::string_view rest = variable != nullptr ? variable : "";
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    if (colon != 0) entries.emplace_back(rest.substr(0, colon));
    rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
  }
  return entries;
}

std::vector<fs::path> packageCandidates(const std::string& path, const fs::path& folder,
                                        const LoadOptions& options) {
  std::vector<fs::path> found;
  std::vector<PackageFolder> packages = options.packages;
  std::stable_sort(packages.begin(), packages.end(),
                   [](const auto& a, const auto& b) { return a.name.size() > b.name.size(); });
  for (const PackageFolder& package : packages) {
    if (const auto rest = below(path, package.name)) found.push_back(package.folder / *rest);
  }
  for (fs::path parent = folder;; parent = parent.parent_path()) {
    found.push_back(parent / path);
    if (parent == parent.parent_path()) break;
  }
  const std::string name = path.substr(0, path.find('/'));
  for (const std::string& entry : rosPackagePath()) {
    found.push_back(fs::path(entry) / path);
    fs::path last = fs::path(entry).lexically_normal();
    if (last.filename().empty()) last = last.parent_path();
    const auto rest = below(path, name);
    if (last.filename() == name && rest) found.push_back(last / *rest);
  }
  return found;
}

}  // namespace

std::vector<fs::path> candidatePaths(const std::string& reference, const fs::path& folder,
                                     const LoadOptions& options) {
  std::vector<fs::path> found;
  if (auto package = after(reference, "package://")) {
    found = packageCandidates(*package, folder, options);
  } else if (auto model = after(reference, "model://")) {
    found = packageCandidates(*model, folder, options);
  } else if (auto file = after(reference, "file://")) {
    found = {folder / *file};
  } else if (reference.find("://") == std::string::npos) {
    found = {folder / reference};  // an absolute reference replaces the folder
  }
  for (fs::path& path : found) path = path.lexically_normal();
  return found;
}

}  // namespace swept::detail
