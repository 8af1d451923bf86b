// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/distinct_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "command_line/exit_code.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

struct NamedFile {
  std::string option;
  fs::path file;

  std::string text() const { return option + " '" + file.string() + "'"; }
};

std::vector<NamedFile> written(const Arguments& args) {
  return {{"-o", args.output},
          {"--csv", args.batch.csv},
          {"--csv", args.report.csv},
          {"--html", args.report.html},
          {"page", args.page.file}};
}

std::vector<NamedFile> read(const Arguments& args) {
  std::vector<NamedFile> files{{"robot", args.robot},         {"--scene", args.scene},
                               {"--problems", args.problems}, {"--request", args.request},
                               {"path", args.path},           {"trajectory", args.trajectory.file},
                               {"--limits", args.limits},     {"--controllers", args.controllers},
                               {"--check", args.cover.check}};
  for (const std::string& state : args.states)
    if (const std::string file = state.substr(state.starts_with('@') ? 1 : 0); file != "-")
      files.push_back({"states", file});
  for (const std::string& cloud : args.clouds) files.push_back({"--cloud", cloud});
  for (const std::string& part : args.schedule.parts)
    files.push_back({"part", part.substr(part.find('=') + 1)});
  for (const std::string& results : args.batch.files) files.push_back({"results", results});
  return files;
}

/// By whatever name. Pipes and devices take what several write.
bool isSameFile(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;
  std::error_code error;  // what cannot be looked at is refused when it is opened
  if (fs::equivalent(a, b, error)) return fs::is_regular_file(a, error);
  const fs::path place = fs::weakly_canonical(fs::absolute(a), error);
  return !fs::exists(a, error) && !place.empty() &&
         place == fs::weakly_canonical(fs::absolute(b), error);
}

/// What goes to a stream that leads to the file would be lost, or take the place of its beginning.
void requireNoStream(const NamedFile& one) {
  struct stat file {};
  if (one.file.empty() || stat(one.file.c_str(), &file) != 0 || !S_ISREG(file.st_mode)) return;
  for (const auto& [stream, name] :
       {std::pair{STDOUT_FILENO, "standard output"}, std::pair{STDERR_FILENO, "standard error"}}) {
    struct stat open {};
    if (fstat(stream, &open) == 0 && open.st_dev == file.st_dev && open.st_ino == file.st_ino)
      throw UsageError(one.text() + " is the file that " + name + " goes to");
  }
}

}  // namespace

void requireDistinctFiles(const Arguments& args) {
  std::vector<NamedFile> others = read(args);
  for (const NamedFile& one : written(args)) {
    requireNoStream(one);
    for (const NamedFile& other : others)
      if (isSameFile(one.file, other.file))
        throw UsageError(one.text() + " would replace the file of " + other.text());
    others.push_back(one);
  }
}

}  // namespace swept
