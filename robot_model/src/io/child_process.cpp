// SPDX-License-Identifier: BSD-3-Clause
#include "io/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <system_error>

#if defined(__linux__)
#include <sys/prctl.h>
#endif

namespace swept::detail {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTick = 50;        // ms, between looks at a child that says nothing
constexpr int kEndTick = 1;      // ms, at one that has closed its pipe: most end at once
constexpr int kUnfinished = 17;  // exit code of a child that could not say all

/// Bytes of address space in use; 0: not known. Builds with sanitizers do not ask.
[[maybe_unused]] std::uint64_t addressSpace() {
  std::ifstream stream("/proc/self/statm");
  std::uint64_t pages = 0;
  if (!(stream >> pages)) return 0;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void lower(decltype(RLIMIT_CPU) resource, rlim_t soft, rlim_t hard) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return;
  limit.rlim_cur = std::min(limit.rlim_cur, soft);
  limit.rlim_max = std::min(limit.rlim_max, hard);
  setrlimit(resource, &limit);
}

/// Before the fork: reading /proc is not for a child of a process with threads.
struct Bounds {
  rlim_t cpu, memory;

  explicit Bounds(const ChildLimits& limits) : cpu(limits.seconds), memory(RLIM_INFINITY) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    // A sanitizer's shadow takes all addresses there are.
    if (const std::uint64_t used = addressSpace(); used > 0) memory = used + limits.bytes;
#endif
  }
  void apply() const {
    lower(RLIMIT_CPU, cpu, cpu + 1);
    lower(RLIMIT_AS, memory, memory);
    lower(RLIMIT_CORE, 0, 0);
  }
};

bool writeAll(int descriptor, const char* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t count = write(descriptor, bytes + done, size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    done += static_cast<std::size_t>(count);
  }
  return true;
}

/// The life of the child. It does not return, so that nothing of the parent is done twice.
[[noreturn]] void live(int descriptor, pid_t parent, const std::function<std::string()>& work,
                       const Bounds& bounds) {
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(kUnfinished);
#else
  static_cast<void>(parent);
#endif
  for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU})
    std::signal(signal, SIG_DFL);
  std::signal(SIGPIPE, SIG_IGN);
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  bounds.apply();
  try {
    const std::string result = work();
    const std::uint64_t size = result.size();
    const bool written = writeAll(descriptor, reinterpret_cast<const char*>(&size), sizeof size) &&
                         writeAll(descriptor, result.data(), result.size());
    _exit(written ? 0 : kUnfinished);
  } catch (...) {
    _exit(kUnfinished);
  }
}

/// Whether the descriptor has something to say: `data`, its end, or nothing yet.
enum class Heard { Data, End, Nothing };

Heard listen(int descriptor, std::string& text) {
  pollfd wait{.fd = descriptor, .events = POLLIN, .revents = 0};
  if (poll(&wait, 1, kTick) <= 0) return Heard::Nothing;
  std::array<char, 65536> buffer;
  const ssize_t count = read(descriptor, buffer.data(), buffer.size());
  if (count < 0) return errno == EINTR ? Heard::Nothing : Heard::End;
  if (count == 0) return Heard::End;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  return Heard::Data;
}

/// Of a message that starts with its size; false: there is more to come.
bool isWhole(const std::string& text) {
  std::uint64_t size = 0;
  if (text.size() < sizeof size) return false;
  std::memcpy(&size, text.data(), sizeof size);
  return text.size() - sizeof size >= size;
}

/// A child, and the end of the pipe that it writes to. Ended and reaped at the latest here.
class Child {
 public:
  Child(const std::function<std::string()>& work, const Bounds& bounds) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail();
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0) {
      close(ends[0]);
      live(ends[1], parent, work, bounds);
    }
    const int error = errno;
    close(ends[1]);
    descriptor_ = ends[0];
    errno = error;
    if (pid_ < 0) {
      close(descriptor_);
      fail();
    }
  }
  ~Child() {
    close(descriptor_);
    if (!ended_) kill(pid_, SIGKILL);
    while (!ended_ && waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::string listenUntil(Clock::time_point latest, const ChildLimits& limits) {
    std::string text;
    while (!isWhole(text)) {
      if (text.size() > limits.bytes) throw ChildError("said too much");
      // Before listening: what one that is gone has said is all in the pipe.
      const bool gone = isGone();
      const Heard heard = listen(descriptor_, text);
      // The pipe of one that is gone may be held open by a child of another thread; and one that
      // has closed its pipe may stay.
      if (gone && heard != Heard::Data) throw ChildError(ending());
      if (heard == Heard::End) poll(nullptr, 0, kEndTick);
      if (Clock::now() > latest)
        throw ChildError("took more than " + std::to_string(limits.seconds * kWallPerCpu) + " s");
    }
    return text.substr(sizeof(std::uint64_t));
  }

 private:
  [[noreturn]] static void fail() {
    throw std::system_error(errno, std::generic_category(), "no process can be made");
  }

  /// Also where the host lets the system reap its children.
  bool isGone() {
    if (ended_) return true;
    const pid_t found = waitpid(pid_, &status_, WNOHANG);
    ended_ = found == pid_ || (found < 0 && errno == ECHILD);
    return ended_;
  }

  /// Of one that is gone.
  std::string ending() const {
    if (!WIFSIGNALED(status_)) return "ended too soon";
    if (WTERMSIG(status_) == SIGXCPU || WTERMSIG(status_) == SIGKILL)
      return "took too much time or memory";
    return "crashed (signal " + std::to_string(WTERMSIG(status_)) + ")";
  }

  pid_t pid_ = -1;
  int descriptor_ = -1;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace

std::string runInChild(const std::function<std::string()>& work, const ChildLimits& limits) {
  const Bounds bounds(limits);
  Child child(work, bounds);
  const auto latest = Clock::now() + std::chrono::seconds(limits.seconds * kWallPerCpu);
  return child.listenUntil(latest, limits);
}

}  // namespace swept::detail
