// SPDX-License-Identifier: BSD-3-Clause
#include "output/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "command_line/exit_code.hpp"

namespace swept {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, int error) {
  throw UsageError("cannot write '" + file.string() + "': " + std::strerror(error));
}

std::filesystem::path folderOf(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// Returns errno, or 0.
int writeAll(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    done += static_cast<std::size_t>(written);
  }
  return fsync(descriptor) == 0 ? 0 : errno;
}

}  // namespace

void requireWritable(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) refuse(file, EISDIR);
  const std::filesystem::path folder = folderOf(file);
  if (!std::filesystem::is_directory(folder))
    refuse(file, std::filesystem::exists(folder) ? ENOTDIR : ENOENT);
  if (access(folder.c_str(), W_OK | X_OK) != 0) refuse(file, errno);
}

void writeWholeFile(const std::filesystem::path& file, const std::string& text) {
  // Under a name of its own first.
  std::string temporary = (folderOf(file) / ("." + file.filename().string() + ".XXXXXX")).string();
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) refuse(file, errno);
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor, 0666 & ~mask);
  int error = writeAll(descriptor, text);
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) return;
  unlink(temporary.c_str());
  refuse(file, error);
}

}  // namespace swept
