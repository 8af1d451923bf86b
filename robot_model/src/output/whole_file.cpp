// SPDX-License-Identifier: BSD-3-Clause
#include "output/whole_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <utility>

#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // in a row, as Linux has it
constexpr std::array kEnding{SIGINT, SIGTERM, SIGHUP};

/// Of the name of a file, in that of its unfinished one: names may have as many bytes as they like.
constexpr std::size_t kNameShown = 100;
constexpr std::ptrdiff_t kSlots = 16;

struct Slot {
  char name[PATH_MAX];
  volatile std::sig_atomic_t used;
};
// What a signal handler may touch.
std::array<Slot, kSlots> gUnfinished;

std::mutex gUnfinishedMutex;  // what is below, and which slots are used
std::size_t gUsed = 0;
std::array<bool, kEnding.size()> gTaken;

void onEnding(int signal) {
  removeUnfinishedFiles();
  raise(signal);  // once this returns, with its usual effect
}

/// Of signals that have another handler, who set it has to see to unfinished files.
void takeSignals() {
  struct sigaction action = {};
  action.sa_handler = onEnding;
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  for (std::size_t i = 0; i < kEnding.size(); ++i) {
    struct sigaction before = {};
    sigaction(kEnding[i], nullptr, &before);
    gTaken[i] = before.sa_handler == SIG_DFL;
    if (gTaken[i]) sigaction(kEnding[i], &action, nullptr);
  }
}

void giveSignalsBack() {
  for (std::size_t i = 0; i < kEnding.size(); ++i)
    if (gTaken[i]) std::signal(kEnding[i], SIG_DFL);
}

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

/// Under which name `file` is written before it gets its own.
std::string unfinishedName(const fs::path& file) {
  const std::string name = file.filename().string().substr(0, kNameShown);
  return (folderOf(file) / ("." + name + ".XXXXXX")).string();
}

int replaceFile(const fs::path& file, const std::string& text) {
  UnfinishedFile unfinished(unfinishedName(file), 0);
  const int descriptor = unfinished.descriptor();
  if (descriptor < 0) return errno;
  fchmod(descriptor, modeOf(file));
  int error = writeAll(descriptor, text);
  if (unfinished.close() != 0 && error == 0) error = errno;
  if (error == 0 && std::rename(unfinished.name().c_str(), file.c_str()) != 0) error = errno;
  if (error == 0) unfinished.keep();
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

UnfinishedFile::UnfinishedFile(const std::string& pattern, int ending) : name_(pattern) {
  char* name = name_.data();
  if (name_.size() < PATH_MAX) {
    const std::lock_guard lock(gUnfinishedMutex);
    slot_ = std::ranges::find_if(gUnfinished, [](const Slot& slot) { return slot.used == 0; }) -
            gUnfinished.begin();
    if (hasSlot()) {
      if (gUsed++ == 0) takeSignals();
      name = std::strcpy(gUnfinished[static_cast<std::size_t>(slot_)].name, pattern.c_str());
      gUnfinished[static_cast<std::size_t>(slot_)].used = 1;
    }
  }
  // Its name is where handlers look for it before it is there.
  descriptor_ = mkostemps(name, ending, O_CLOEXEC);
  name_ = descriptor_ < 0 ? "" : name;
}

UnfinishedFile::~UnfinishedFile() {
  close();
  if (!name_.empty()) unlink(name_.c_str());
  keep();
}

int UnfinishedFile::close() {
  return descriptor_ < 0 ? 0 : ::close(std::exchange(descriptor_, -1));
}

void UnfinishedFile::keep() {
  name_.clear();
  if (!hasSlot()) return;
  const std::lock_guard lock(gUnfinishedMutex);
  if (--gUsed == 0) giveSignalsBack();
  gUnfinished[static_cast<std::size_t>(slot_)].used = 0;
  slot_ = kSlots;
}

bool UnfinishedFile::hasSlot() const {
  return slot_ < kSlots;
}

void removeUnfinishedFiles() {
  for (const Slot& slot : gUnfinished)
    if (slot.used != 0) unlink(slot.name);
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
  // Names that are too long, which without this are found out after the work.
  for (const std::string& name : {end.string(), unfinishedName(end)})
    if (access(name.c_str(), F_OK) != 0 && errno != ENOENT) refuse(file, errno);
}

void writeWholeFile(const fs::path& file, const std::string& text) {
  const int error =
      takesBytesOnly(typeOf(file)) ? writeBytes(file, text) : replaceFile(endOfLinks(file), text);
  if (error != 0) refuse(file, error);
}

}  // namespace swept
