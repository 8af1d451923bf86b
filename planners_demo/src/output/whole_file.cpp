// SPDX-License-Identifier: BSD-3-Clause
#include "output/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "command_line/exit_code.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // in a row, as Linux has it
constexpr std::array kEnding{SIGINT, SIGTERM, SIGHUP};

// What a signal handler may touch.
char gUnfinished[PATH_MAX];
volatile std::sig_atomic_t gIsUnfinished = 0;

std::mutex gUnfinishedMutex;

void onEnding(int signal) {
  removeUnfinishedFile();
  raise(signal);  // once this returns, with its usual effect
}

/// While it lives, signals that would end the program remove the file first. Of files that threads
/// write at the same time, it is one.
class Unfinished {
 public:
  explicit Unfinished(const std::string& file) : lock_(gUnfinishedMutex, std::try_to_lock) {
    if (!lock_ || file.size() >= sizeof gUnfinished) return;
    std::memcpy(gUnfinished, file.c_str(), file.size() + 1);
    gIsUnfinished = 1;
    struct sigaction action = {};
    action.sa_handler = onEnding;
    action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
    for (std::size_t i = 0; i < kEnding.size(); ++i) {
      struct sigaction before = {};
      sigaction(kEnding[i], nullptr, &before);
      taken_[i] = before.sa_handler == SIG_DFL;
      if (taken_[i]) sigaction(kEnding[i], &action, nullptr);
    }
  }
  ~Unfinished() {
    if (!lock_) return;
    for (std::size_t i = 0; i < kEnding.size(); ++i)
      if (taken_[i]) std::signal(kEnding[i], SIG_DFL);
    gIsUnfinished = 0;
  }
  Unfinished(const Unfinished&) = delete;
  Unfinished& operator=(const Unfinished&) = delete;

 private:
  std::unique_lock<std::mutex> lock_;
  std::array<bool, kEnding.size()> taken_{};
};

[[noreturn]] void refuse(const fs::path& file, int error) {
  throw UsageError("cannot write '" + file.string() + "': " + std::strerror(error));
}

/// Refuses `file` when whom the program runs as may not do so with `path`.
void requireAccess(const fs::path& file, const fs::path& path, int mode) {
  if (faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) != 0) refuse(file, errno);
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

fs::file_type typeOf(const fs::path& file) {
  std::error_code error;  // what cannot be looked at cannot be opened either, which says why
  return fs::status(file, error).type();
}

/// A pipe, a device: there are no bytes there to be kept, and a file in its place is no pipe.
bool takesBytesOnly(fs::file_type type) {
  return type == fs::file_type::fifo || type == fs::file_type::character ||
         type == fs::file_type::block;
}

/// Returns errno, or 0.
int writeAll(int descriptor, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = ::write(descriptor, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    done += static_cast<std::size_t>(written);
  }
  // Of pipes and devices there is nothing to bring to a disk.
  return fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
}

/// Of the file that is there, or as any program's new file.
mode_t modeOf(const fs::path& file) {
  struct stat status {};
  if (stat(file.c_str(), &status) == 0) return status.st_mode & 07777;
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

int writeBytes(const fs::path& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) return errno;
  const int error = writeAll(descriptor, text);
  return close(descriptor) != 0 && error == 0 ? errno : error;
}

int replaceFile(const fs::path& file, const std::string& text) {
  // Under a name of its own first.
  std::string temporary = (folderOf(file) / ("." + file.filename().string() + ".XXXXXX")).string();
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) return errno;
  const Unfinished unfinished(temporary);
  fchmod(descriptor, modeOf(file));
  int error = writeAll(descriptor, text);
  if (close(descriptor) != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(temporary.c_str(), file.c_str()) != 0) error = errno;
  if (error != 0) unlink(temporary.c_str());
  return error;
}

}  // namespace

fs::path endOfLinks(const fs::path& file) {
  fs::path end = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(fs::symlink_status(end, error)); ++links) {
    if (links == kMostLinks) refuse(file, ELOOP);
    const fs::path next = fs::read_symlink(end, error);
    if (error) refuse(file, error.value());
    end = folderOf(end) / next;
  }
  return end;
}

void removeUnfinishedFile() {
  if (gIsUnfinished != 0) unlink(gUnfinished);
}

void requireWritable(const fs::path& file) {
  const fs::file_type type = typeOf(file);
  if (type == fs::file_type::directory) refuse(file, EISDIR);
  if (type == fs::file_type::socket) refuse(file, ENXIO);
  if (takesBytesOnly(type)) {
    requireAccess(file, file, W_OK);
    return;
  }
  const fs::path end = endOfLinks(file);
  const fs::path folder = folderOf(end);
  requireAccess(file, folder, F_OK);
  if (typeOf(folder) != fs::file_type::directory) refuse(file, ENOTDIR);
  requireAccess(file, folder, W_OK | X_OK);
  // It is replaced, for which rights to its folder are enough; but it was protected for a reason.
  if (type == fs::file_type::regular) requireAccess(file, end, W_OK);
}

void writeWholeFile(const fs::path& file, const std::string& text) {
  const int error =
      takesBytesOnly(typeOf(file)) ? writeBytes(file, text) : replaceFile(endOfLinks(file), text);
  if (error != 0) refuse(file, error);
}

}  // namespace swept
