// SPDX-License-Identifier: BSD-3-Clause
#include "batch/interrupt.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>

#include "command_line/exit_code.hpp"
#include "output/whole_file.hpp"

#if defined(__linux__)
#include <sys/prctl.h>
#endif

namespace swept {
namespace {

constexpr std::array kSignals{SIGINT, SIGTERM};

// The data that a signal handler may touch.
volatile std::sig_atomic_t gRequests = 0;
int gPipe[2] = {-1, -1};
std::array<struct sigaction, kSignals.size()> gBefore;

void onSignal(int) {
  if (gRequests > 0) {
    removeUnfinishedFiles();
    _exit(static_cast<int>(ExitCode::Interrupted));
  }
  gRequests = 1;
  const int before = errno;
  [[maybe_unused]] const ssize_t written = write(gPipe[1], "", 1);
  errno = before;
}

void becomeWorker(pid_t parent) {
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
#else
  static_cast<void>(parent);
#endif
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGTERM, SIG_DFL);
  // A planner's failed assertion must show as such, without a core file for each.
  std::signal(SIGABRT, SIG_DFL);
  std::set_terminate(std::abort);
  const rlimit none{.rlim_cur = 0, .rlim_max = 0};
  setrlimit(RLIMIT_CORE, &none);
}

}  // namespace

Interrupt::Interrupt() {
  gRequests = 0;
  if (pipe2(gPipe, O_CLOEXEC | O_NONBLOCK) != 0)
    throw UsageError(std::string("no pipe: ") + std::strerror(errno));
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &gBefore[i]);
    if (gBefore[i].sa_handler == SIG_IGN) continue;
    struct sigaction action = {};
    action.sa_handler = onSignal;
    action.sa_flags = SA_RESTART;
    sigaction(kSignals[i], &action, nullptr);
  }
}

Interrupt::~Interrupt() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &gBefore[i], nullptr);
  close(gPipe[0]);
  close(gPipe[1]);
}

bool Interrupt::requested() {
  return gRequests > 0;
}

int Interrupt::descriptor() const {
  return gPipe[0];
}

pid_t Interrupt::forkWorker() const {
  sigset_t both, before;
  sigemptyset(&both);
  for (const int signal : kSignals) sigaddset(&both, signal);
  sigprocmask(SIG_BLOCK, &both, &before);
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) becomeWorker(parent);
  sigprocmask(SIG_SETMASK, &before, nullptr);
  return child;
}

}  // namespace swept
