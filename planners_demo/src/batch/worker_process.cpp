// SPDX-License-Identifier: BSD-3-Clause
#include "batch/worker_process.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <utility>

#include "command_line/exit_code.hpp"
#include "output/text_output.hpp"

namespace swept {
namespace {

/// False: the other end is closed.
bool sendAll(int socket, const char* bytes, std::size_t size) {
  for (std::size_t done = 0; done < size;) {
    const ssize_t sent = send(socket, bytes + done, size - done, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return false;
    done += static_cast<std::size_t>(sent);
  }
  return true;
}

/// Descriptors 0, 1 and 2 are open since main() began, so neither the socket nor a file opened here
/// has one of these numbers.
void silence() {
  const int nowhere = open("/dev/null", O_RDWR | O_CLOEXEC);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(nowhere, stream);
  close(nowhere);
}

/// The main loop of a worker. It does not return, so it repeats nothing that the parent does at its
/// end.
[[noreturn]] void live(int socket, const WorkerProcess::Life& life) {
  silence();
  const WorkerLink link(socket);
  try {
    life(link);
  } catch (const std::exception& error) {
    link.say(WorkerMessage::Kind::Error, error.what());
  }
  _exit(0);
}

WorkerMessage messageOf(const std::string& line) {
  WorkerMessage message{.kind = static_cast<WorkerMessage::Kind>(line.at(0)),
                        .text = line.substr(1)};
  using enum WorkerMessage::Kind;
  if (message.kind == Warning || message.kind == Error)
    message.text = Json::parse(message.text).get<std::string>();
  return message;
}

}  // namespace

void WorkerLink::say(WorkerMessage::Kind kind, const std::string& text) const {
  std::string line(1, static_cast<char>(kind));
  // A text for the user may have line breaks, but a message may not.
  const bool forUser = kind == WorkerMessage::Kind::Warning || kind == WorkerMessage::Kind::Error;
  line.append(forUser ? lineOf(text) : text);
  line.append("\n");
  if (!sendAll(socket_, line.data(), line.size())) _exit(1);
}

std::optional<std::size_t> WorkerLink::nextRun() const {
  std::uint64_t run = 0;
  const ssize_t count = recv(socket_, &run, sizeof run, MSG_WAITALL);
  if (count != sizeof run) return {};
  return static_cast<std::size_t>(run);
}

WorkerProcess::WorkerProcess(const Interrupt& interrupt, const Life& life,
                             std::span<const int> others) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw UsageError(std::string("no worker can be started: ") + std::strerror(errno));
  pid_ = interrupt.forkWorker();
  if (pid_ == 0) {
    close(ends[0]);
    for (const int other : others) close(other);
    live(ends[1], life);
  }
  const int error = errno;
  close(ends[1]);
  socket_ = ends[0];
  if (pid_ < 0) {
    close(socket_);
    throw UsageError(std::string("no worker can be started: ") + std::strerror(error));
  }
}

WorkerProcess::~WorkerProcess() {
  if (pid_ > 0) reap(true);
}

WorkerProcess::WorkerProcess(WorkerProcess&& other) noexcept {
  *this = std::move(other);
}

WorkerProcess& WorkerProcess::operator=(WorkerProcess&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(socket_, other.socket_);
  std::swap(ready_, other.ready_);
  std::swap(run_, other.run_);
  std::swap(since_, other.since_);
  std::swap(unread_, other.unread_);
  return *this;
}

void WorkerProcess::give(std::size_t run) {
  run_ = run;
  since_ = Clock::now();
  const std::uint64_t place = run;
  // The end of its messages shows whether the worker still runs.
  sendAll(socket_, reinterpret_cast<const char*>(&place), sizeof place);
}

void WorkerProcess::giveNoMore() const {
  shutdown(socket_, SHUT_WR);
}

bool WorkerProcess::receive(std::vector<WorkerMessage>& messages) {
  std::array<char, 65536> buffer{};
  const ssize_t count = recv(socket_, buffer.data(), buffer.size(), 0);
  if (count < 0 && errno == EINTR) return true;
  if (count <= 0) return false;
  unread_.append(buffer.data(), static_cast<std::size_t>(count));
  std::size_t begin = 0;
  for (std::size_t end; (end = unread_.find('\n', begin)) != std::string::npos; begin = end + 1) {
    messages.push_back(messageOf(unread_.substr(begin, end - begin)));
    if (messages.back().kind == WorkerMessage::Kind::Ready) ready_ = true;
    if (messages.back().kind == WorkerMessage::Kind::Result) run_.reset();
  }
  unread_.erase(0, begin);
  return true;
}

std::string WorkerProcess::reap(bool killFirst) {
  if (killFirst) kill(pid_, SIGKILL);
  close(socket_);
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) continue;
  pid_ = -1;
  socket_ = -1;
  if (WIFSIGNALED(status)) return "stopped by signal " + std::to_string(WTERMSIG(status));
  if (WEXITSTATUS(status) == 0) return {};
  return "ended with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace swept
