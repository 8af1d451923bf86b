// SPDX-License-Identifier: BSD-3-Clause
#include "page/view.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>

#include "output/terminal_text.hpp"
#include "output/whole_file.hpp"
#include "page/file_page.hpp"
#include "page/pages.hpp"
#include "page/path_page.hpp"
#include "page/program_page.hpp"

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

/// Reads what is to be seen, before there is a file for it. What it returns writes the page.
std::function<void(const Arguments&)> readPage(const Arguments& args, Warnings& warnings) {
  if (namesProof(args)) {
    return [text = pageOfProof(args, warnings)](const Arguments& to) {
      writeWholeFile(to.page.file, text());
      printText("page written to " + escapedLine(to.page.file) + "\n");
    };
  }
  if (namesPaths(args)) {
    const auto view = std::make_shared<const PathsToView>(pathsToView(args, warnings));
    return [view](const Arguments& to) {
      writePage(to, view->model, view->checker.get(), view->content);
    };
  }
  const auto model = std::make_shared<const Model>(loadModel(args, warnings));
  if (showsStates(args)) {
    const auto task = std::make_shared<const Task>(loadTask(args, *model, warnings));
    return [model, task](const Arguments& to) { writeCheckPage(to, *model, *task); };
  }
  const auto checker = makeCheckerOfGroup(args, *model, warnings);
  return [model, checker](const Arguments& to) { writeInfoPage(to, *model, checker.get()); };
}

}  // namespace

ExitCode runView(const Arguments& given) {
  Arguments args = given;
  requirePageFile(args);
  Warnings warnings(args.quiet);
  const auto write = readPage(args, warnings);
  if (!given.page.file.empty()) {
    write(args);
    return ExitCode::Free;
  }
  const std::string pattern = temporaryPattern();
  UnfinishedFile page(pattern, kEnding);
  if (page.descriptor() < 0)
    throw UsageError("cannot write '" + pattern + "': " + std::strerror(errno));
  args.page.file = page.name();
  write(args);
  page.keep();
  openInBrowser(args.page.file);
  return ExitCode::Free;
}

}  // namespace swept
