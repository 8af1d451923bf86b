// SPDX-License-Identifier: BSD-3-Clause
#include "io/package_paths.hpp"

#include <tinyxml2.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "io/regular_file.hpp"
#include "swept/robot_model/text_file.hpp"

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

/// What is between the colons of an environment variable.
std::vector<fs::path> foldersOf(const char* variable) {
  std::vector<fs::path> entries;
  const char* value = std::getenv(variable);
  std::string_view rest = value != nullptr ? value : "";
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    if (colon != 0) entries.emplace_back(rest.substr(0, colon));
    rest = colon == std::string_view::npos ? std::string_view{} : rest.substr(colon + 1);
  }
  return entries;
}

/// `NAME/rest` of a reference into a package.
std::optional<std::string> pathInPackages(const std::string& reference) {
  auto path = after(reference, "package://");
  if (!path) path = after(reference, "model://");
  // `package:///NAME/rest` is common; as an absolute path it would be in no package.
  if (path) path->erase(0, path->find_first_not_of('/'));
  return path;
}

/// `<name>` of the package.xml in `folder`; empty where there is none to read.
std::string nameInManifest(const fs::path& folder) {
  const fs::path file = folder / "package.xml";
  if (!whyUnreadable(file).empty()) return {};
  try {
    const std::string text = readTextFile(file);
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) return {};
    const auto* root = document.FirstChildElement("package");
    const auto* name = root == nullptr ? nullptr : root->FirstChildElement("name");
    const std::string_view words = name == nullptr || !name->GetText() ? "" : name->GetText();
    const auto begin = words.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return {};
    return std::string(words.substr(begin, words.find_last_not_of(" \t\r\n") + 1 - begin));
  } catch (const InputError&) {
    return {};
  }
}

std::vector<fs::path> withParents(const fs::path& folder) {
  std::vector<fs::path> all{folder};
  while (all.back() != all.back().parent_path()) all.push_back(all.back().parent_path());
  return all;
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
  const std::string name = path.substr(0, path.find('/'));
  const auto inPackage = below(path, name);
  for (const fs::path& parent : withParents(folder))
    if (inPackage && nameInManifest(parent) == name) found.push_back(parent / *inPackage);
  for (const fs::path& parent : withParents(folder)) found.push_back(parent / path);
  for (const fs::path& entry : foldersOf("ROS_PACKAGE_PATH")) {
    found.push_back(entry / path);
    fs::path last = entry.lexically_normal();
    if (last.filename().empty()) last = last.parent_path();
    if (last.filename() == name && inPackage) found.push_back(last / *inPackage);
  }
  for (const fs::path& prefix : foldersOf("AMENT_PREFIX_PATH"))
    found.push_back(prefix / "share" / path);
  return found;
}

}  // namespace

std::vector<fs::path> candidatePaths(const std::string& reference, const fs::path& folder,
                                     const LoadOptions& options) {
  std::vector<fs::path> found;
  if (const auto path = pathInPackages(reference)) {
    found = packageCandidates(*path, folder, options);
  } else if (const auto file = after(reference, "file://")) {
    found = {folder / *file};
  } else if (reference.find("://") == std::string::npos) {
    found = {folder / reference};  // an absolute reference replaces the folder
  }
  std::vector<fs::path> places;
  for (const fs::path& path : found) {
    const fs::path place = path.lexically_normal();
    if (std::find(places.begin(), places.end(), place) == places.end()) places.push_back(place);
  }
  return places;
}

std::string packageOf(const std::string& reference) {
  const auto path = pathInPackages(reference);
  return path ? path->substr(0, path->find('/')) : std::string();
}

}  // namespace swept::detail
