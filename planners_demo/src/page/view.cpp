// SPDX-License-Identifier: BSD-3-Clause
#include "page/view.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "output/whole_file.hpp"
#include "page/pages.hpp"

namespace swept {
namespace {

constexpr int kEnding = 5;  // characters of .html

/// `swept-XXXXXX.html` in the folder for such.
std::string temporaryPattern() {
  std::error_code noFolder;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(noFolder);
  if (noFolder) throw UsageError("no folder for temporary files: " + noFolder.message());
  return (folder / "swept-XXXXXX.html").string();
}

/// What it says is of no interest: without a desktop the name is on stdout all the same.
void openInBrowser(const std::string& file) {
  const pid_t child = fork();
  if (child == 0) {
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
    execlp("xdg-open", "xdg-open", file.c_str(), static_cast<char*>(nullptr));
    _exit(127);
  }
  if (child > 0) waitpid(child, nullptr, 0);
}

bool showsStates(const Arguments& args) {
  return !args.states.empty() || !args.problems.empty();
}

void writePage(const Arguments& args, const Model& model, const Task& task,
               const Checker* checker) {
  if (showsStates(args))
    writeCheckPage(args, model, task);
  else
    writeInfoPage(args, model, checker);
}

}  // namespace

ExitCode runView(const Arguments& given) {
  Arguments args = given;
  requirePageFile(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = showsStates(args) ? loadTask(args, model, warnings) : Task{};
  const auto checker = showsStates(args) ? task.checker : makeCheckerOfGroup(args, model, warnings);
  if (!given.page.file.empty()) {
    writePage(args, model, task, checker.get());
    return ExitCode::Free;
  }
  const std::string pattern = temporaryPattern();
  UnfinishedFile page(pattern, kEnding);
  if (page.descriptor() < 0)
    throw UsageError("cannot write '" + pattern + "': " + std::strerror(errno));
  args.page.file = page.name();
  writePage(args, model, task, checker.get());
  page.keep();
  openInBrowser(args.page.file);
  return ExitCode::Free;
}

}  // namespace swept
