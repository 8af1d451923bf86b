// SPDX-License-Identifier: BSD-3-Clause
#include <mpi.h>
#include <poll.h>

#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "batch/ranks.hpp"
#include "command_line/exit_code.hpp"
#include "output/terminal_text.hpp"

namespace swept {
namespace {

constexpr int kResult = 1, kEnd = 2;  // tags
constexpr int kTick = 10;             // ms

/// MPI, started by the constructor and ended by the destructor. MPI's own errors end the job.
class Job {
 public:
  Job() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
  }
  ~Job() { MPI_Finalize(); }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  [[noreturn]] void fail(const std::string& message) const {
    printMessage("swept: error: rank " + std::to_string(rank_) + ": " + message);
    MPI_Abort(MPI_COMM_WORLD, static_cast<int>(ExitCode::BadInput));
    std::abort();
  }

  /// Broadcasts rank 0's value to all.
  std::vector<std::size_t> shared(const std::vector<std::size_t>& places) const {
    std::vector<std::uint64_t> numbers(places.begin(), places.end());
    std::uint64_t count = numbers.size();
    MPI_Bcast(&count, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    numbers.resize(count);
    MPI_Bcast(numbers.data(), static_cast<int>(count), MPI_UINT64_T, 0, MPI_COMM_WORLD);
    return {numbers.begin(), numbers.end()};
  }

  void sendToFirst(int tag, const std::string& text) const {
    MPI_Send(text.data(), static_cast<int>(text.size()), MPI_CHAR, 0, tag, MPI_COMM_WORLD);
  }

  /// Passes all messages that have come to `take`. Returns the number of ranks that have ended.
  template <typename Take>
  int receive(const Take& take) const {
    int ended = 0;
    for (int waiting = 0;;) {
      MPI_Status status;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &waiting, &status);
      if (waiting == 0) return ended;
      int size = 0;
      MPI_Get_count(&status, MPI_CHAR, &size);
      std::string text(static_cast<std::size_t>(size), '\0');
      MPI_Recv(text.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE);
      if (status.MPI_TAG == kEnd)
        ++ended;
      else
        take(text);
    }
  }

 private:
  int rank_ = 0, size_ = 1;
};

/// The part of one rank: passes on the results of its own worker, and on rank 0 those that the
/// others send.
class Rank {
 public:
  Rank(const Job& job, const RankedBatch& batch, WorkerProcess worker)
      : job_(job), batch_(batch), worker_(std::move(worker)) {}

  void run() {
    const auto all = job_.shared(job_.rank() == 0 ? batch_.open() : std::vector<std::size_t>());
    const auto rank = static_cast<std::size_t>(job_.rank());
    for (std::size_t i = rank; i < all.size(); i += static_cast<std::size_t>(job_.size()))
      worker_.give(all[i]);
    worker_.giveNoMore();
    int others = job_.rank() == 0 ? job_.size() - 1 : 0;
    for (bool working = true; working || others > 0;) {
      pollfd descriptor{.fd = worker_.descriptor(), .events = POLLIN, .revents = 0};
      poll(&descriptor, working ? 1 : 0, kTick);
      if (working && descriptor.revents != 0) working = listen();
      if (job_.rank() == 0) others -= job_.receive(batch_.take);
    }
    if (job_.rank() != 0) job_.sendToFirst(kEnd, "");
  }

 private:
  /// False: the worker is done.
  bool listen() {
    std::vector<WorkerMessage> messages;
    const bool alive = worker_.receive(messages);
    for (const WorkerMessage& message : messages) {
      if (message.kind == WorkerMessage::Kind::Error) throw UsageError(message.text);
      if (message.kind == WorkerMessage::Kind::Warning && job_.rank() == 0)
        batch_.warn(message.text);
      if (message.kind != WorkerMessage::Kind::Result) continue;
      if (job_.rank() == 0)
        batch_.take(message.text);
      else
        job_.sendToFirst(kResult, message.text);
    }
    if (alive) return true;
    if (const std::string ending = worker_.reap(false); !ending.empty())
      throw UsageError("its batch was " + ending);
    return false;
  }

  const Job& job_;
  const RankedBatch& batch_;
  WorkerProcess worker_;
};

}  // namespace

std::optional<int> mpiRank() {
  for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"}) {
    const char* const text = std::getenv(name);
    if (text == nullptr) continue;
    int rank = 0;
    const auto read = std::from_chars(text, text + std::strlen(text), rank);
    if (read.ec == std::errc() && rank >= 0) return rank;
  }
  return {};
}

void runOnRanks(const RankedBatch& batch) {
  // MPI starts threads; forks come before it, and later ones are of this process.
  std::optional<WorkerProcess> worker;
  {
    const Interrupt interrupt;
    worker.emplace(interrupt, batch.work, std::span<const int>());
  }
  const Job job;
  try {
    Rank(job, batch, std::move(*worker)).run();
  } catch (const std::exception& error) {
    job.fail(error.what());
  }
}

}  // namespace swept
