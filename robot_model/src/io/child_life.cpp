// SPDX-License-Identifier: BSD-3-Clause
#include "io/child_life.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <new>

#if defined(__linux__)
#include <sys/prctl.h>
#endif

namespace swept::detail {

namespace {

rlimit limitOf(decltype(RLIMIT_AS) resource) {
  rlimit limit{.rlim_cur = RLIM_INFINITY, .rlim_max = RLIM_INFINITY};
  getrlimit(resource, &limit);
  return limit;
}

/// Sets the limits again for each request. The time of earlier requests does not count, nor memory
/// that they gave back.
class Bounds {
 public:
  explicit Bounds(std::uint64_t parentMemory)
      : parentMemory_(parentMemory), memory_(limitOf(RLIMIT_AS)) {
    rlimit core = limitOf(RLIMIT_CORE);
    core.rlim_cur = 0;
    setrlimit(RLIMIT_CORE, &core);
  }
  void setFor(const RequestHead& head) const {
    // Not RLIMIT_CPU, which counts from the start of the process, and in whole seconds.
    const itimerval timer{.it_interval = {},
                          .it_value = {.tv_sec = static_cast<time_t>(head.seconds), .tv_usec = 0}};
    setitimer(ITIMER_PROF, &timer, nullptr);
    if (parentMemory_ == 0) return;
    // Only the soft limit: a hard limit could not be raised again.
    rlimit memory = memory_;
    memory.rlim_cur = std::min<rlim_t>(memory.rlim_cur, parentMemory_ + head.memory);
    setrlimit(RLIMIT_AS, &memory);
  }

 private:
  std::uint64_t parentMemory_;
  rlimit memory_;  ///< the host's
};

/// Restores the default action of signals that end a process, whatever the host does with them.
void resetSignals() {
  sigset_t ending;
  sigemptyset(&ending);
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGPROF}) {
    std::signal(signal, SIG_DFL);
    sigaddset(&ending, signal);
  }
  sigprocmask(SIG_UNBLOCK, &ending, nullptr);
  std::signal(SIGPIPE, SIG_IGN);
}

bool receiveAll(int socket, char* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = recv(socket, bytes + done, size - done, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

bool sendAll(int socket, const char* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = send(socket, bytes + done, size - done, MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

/// False: the other end of the socket is closed.
bool answerNext(int socket, const ChildWork& work, const Bounds& bounds) {
  RequestHead head{};
  if (!receiveAll(socket, reinterpret_cast<char*>(&head), sizeof head)) return false;
  bounds.setFor(head);
  std::string request(head.size, '\0');
  if (!receiveAll(socket, request.data(), request.size())) return false;
  const std::string answer = work(request);
  const std::uint64_t size = answer.size();
  return sendAll(socket, reinterpret_cast<const char*>(&size), sizeof size) &&
         sendAll(socket, answer.data(), answer.size());
}

}  // namespace

std::uint64_t addressSpace() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return 0;  // a sanitizer's shadow memory takes the whole address space
#else
  std::ifstream stream("/proc/self/statm");
  std::uint64_t pages = 0;
  if (!(stream >> pages)) return 0;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
#endif
}

void liveAsChild(int socket, pid_t parent, const ChildWork& work, std::uint64_t parentMemory) {
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kUnfinished);
#else
  static_cast<void>(parent);
#endif
  resetSignals();
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  const Bounds bounds(parentMemory);
  try {
    while (answerNext(socket, work, bounds)) continue;
  } catch (const std::bad_alloc&) {
    _exit(kNoMemory);
  } catch (...) {
  }
  _exit(kUnfinished);
}

}  // namespace swept::detail
