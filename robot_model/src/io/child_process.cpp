// SPDX-License-Identifier: BSD-3-Clause
#include "io/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <system_error>
#include <utility>

namespace swept::detail {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTick = 50;    // ms, between looks at a child that says nothing
constexpr int kEndTick = 1;  // ms, at one that has closed its socket: most end at once

[[noreturn]] void failToStart(int error) {
  throw std::system_error(error, std::generic_category(), "no process can be made");
}

/// A descriptor other than 0, 1 and 2, which a host may have closed: the child silences these, and
/// the host writes to them.
int beyondStandardStreams(int descriptor) {
  if (descriptor > STDERR_FILENO) return descriptor;
  const int higher = fcntl(descriptor, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
  const int error = errno;
  close(descriptor);
  errno = error;
  return higher;
}

std::array<int, 2> socketEnds() {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) failToStart(errno);
  int error = 0;
  for (int& end : ends) {
    end = beyondStandardStreams(end);
    if (end < 0) error = errno;
  }
  if (error == 0) return ends;
  for (const int end : ends)
    if (end >= 0) close(end);
  failToStart(error);
}

/// Whether the socket has something to say: `data`, its end, or nothing yet.
enum class Heard { Data, End, Nothing };

Heard listen(int socket, std::string& text, std::size_t most) {
  pollfd wait{.fd = socket, .events = POLLIN, .revents = 0};
  if (poll(&wait, 1, kTick) <= 0) return Heard::Nothing;
  std::array<char, 65536> buffer;
  const ssize_t count = recv(socket, buffer.data(), std::min(most, buffer.size()), 0);
  if (count < 0) return errno == EINTR ? Heard::Nothing : Heard::End;
  if (count == 0) return Heard::End;
  text.append(buffer.data(), static_cast<std::size_t>(count));
  return Heard::Data;
}

}  // namespace

/// A child, and the end of the socket that leads to it. The destructor ends and reaps the child at
/// the latest.
class ChildProcess::Process {
 public:
  explicit Process(const ChildWork& work) {
    const std::uint64_t memory = addressSpace();
    const std::array<int, 2> ends = socketEnds();
    const pid_t parent = getpid();
    pid_ = fork();
    if (pid_ == 0) {
      close(ends[0]);
      liveAsChild(ends[1], parent, work, memory);
    }
    const int error = errno;
    close(ends[1]);
    socket_ = ends[0];
    if (pid_ < 0) {
      close(socket_);
      failToStart(error);
    }
  }
  ~Process() {
    close(socket_);
    // Asked first: one that is gone may have left its number to another process.
    if (!isGone()) kill(pid_, SIGKILL);
    while (!ended_ && waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) continue;
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  std::string ask(std::span<const std::string_view> request, const ChildLimits& limits) {
    // What the child said beyond its last answer would be read as the head of the next.
    if (char byte = 0; recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT) > 0)
      throw ChildError("said too much");
    const unsigned wall = limits.seconds * kWallPerCpu;
    latest_ = Clock::now() + std::chrono::seconds(wall);
    late_ = "took more than " + std::to_string(wall) + " s";
    RequestHead head{.seconds = limits.seconds, .memory = limits.bytes, .size = 0};
    for (const std::string_view part : request) head.size += part.size();
    send({reinterpret_cast<const char*>(&head), sizeof head});
    for (const std::string_view part : request) send(part);
    std::uint64_t size = 0;
    std::memcpy(&size, receive(sizeof size).data(), sizeof size);
    if (size > limits.bytes) throw ChildError("said too much");
    return receive(size);
  }

 private:
  /// If the child no longer reads, this says nothing: receive() finds out how it ended.
  void send(std::string_view text) {
    while (!text.empty()) {
      const ssize_t count = ::send(socket_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count >= 0) {
        text.remove_prefix(static_cast<std::size_t>(count));
        continue;
      }
      if (errno == EINTR) continue;
      if (errno != EAGAIN && errno != EWOULDBLOCK) return;
      if (isGone()) throw ChildError(ending());
      requireTime();
      pollfd wait{.fd = socket_, .events = POLLOUT, .revents = 0};
      poll(&wait, 1, kTick);
    }
  }

  std::string receive(std::size_t size) {
    std::string text;
    while (text.size() < size) {
      // Checked before reading: all that a child has written by its end is then in the socket.
      const bool gone = isGone();
      const Heard heard = listen(socket_, text, size - text.size());
      // A child of another thread may hold the socket of an ended child open. And a child that has
      // closed its socket may keep running.
      if (gone && heard != Heard::Data) throw ChildError(ending());
      if (heard == Heard::End) poll(nullptr, 0, kEndTick);
      requireTime();
    }
    return text;
  }

  void requireTime() const {
    if (Clock::now() > latest_) throw ChildError(late_);
  }

  /// Works also where the host lets the system reap its children.
  bool isGone() {
    if (ended_) return true;
    const pid_t found = waitpid(pid_, &status_, WNOHANG);
    ended_ = found == pid_ || (found < 0 && errno == ECHILD);
    return ended_;
  }

  /// Of one that is gone.
  std::string ending() const {
    if (!WIFSIGNALED(status_))
      return WEXITSTATUS(status_) == kNoMemory ? "ran out of memory" : "ended too soon";
    const int signal = WTERMSIG(status_);
    if (signal == SIGPROF || signal == SIGXCPU || signal == SIGKILL)
      return "took too much time or memory";
    return "crashed (signal " + std::to_string(signal) + ")";
  }

  pid_t pid_ = -1;
  int socket_ = -1;
  int status_ = 0;
  bool ended_ = false;
  Clock::time_point latest_;  ///< for the present request
  std::string late_;          ///< said then
};

ChildProcess::ChildProcess(ChildWork work) : work_(std::move(work)) {}

ChildProcess::~ChildProcess() = default;

std::string ChildProcess::ask(std::span<const std::string_view> request,
                              const ChildLimits& limits) {
  if (!process_) process_ = std::make_unique<Process>(work_);
  try {
    std::string answer = process_->ask(request, limits);
    answered_ = true;
    return answer;
  } catch (...) {
    end();
    throw;
  }
}

void ChildProcess::end() {
  process_.reset();
  answered_ = false;
}

}  // namespace swept::detail
