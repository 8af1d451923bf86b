// SPDX-License-Identifier: BSD-3-Clause
#include "folder_watch.hpp"

#include <poll.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <stdexcept>

namespace swept::test {

FolderWatch::FolderWatch(const std::string& folder)
    : descriptor_(inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
  const auto changes = IN_CREATE | IN_MODIFY | IN_MOVED_TO | IN_DELETE;
  if (descriptor_ < 0 || inotify_add_watch(descriptor_, folder.c_str(), changes) < 0)
    throw std::runtime_error("no watch of " + folder);
}

FolderWatch::~FolderWatch() {
  close(descriptor_);
}

void FolderWatch::waitForChange() {
  constexpr int kMoment = 20;  // ms
  pollfd events{.fd = descriptor_, .events = POLLIN, .revents = 0};
  if (poll(&events, 1, kMoment) <= 0) return;
  alignas(inotify_event) char buffer[4096];
  while (read(descriptor_, buffer, sizeof buffer) > 0) {
  }
}

}  // namespace swept::test
