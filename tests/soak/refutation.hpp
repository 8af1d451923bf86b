// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "failures.hpp"
#include "sample.hpp"

namespace soak {

struct RefutationCounts {
  std::int64_t states = 0;        ///< samples
  std::int64_t motions = 0;       ///< samples
  std::int64_t oracleStates = 0;  ///< that the oracle looked at
  std::int64_t rebuilt = 0;       ///< samples asked again in a checker made from the empty world
  double leastRoomOfFree = 1.0;   ///< m, see RefuterReport
};

/// Tries to refute samples: asks again, in this thread and with a fresh workspace, for what has to
/// be the same to the last bit, and holds the answers against the oracle.
class Refutation {
 public:
  /// `seed` is named in what fails, as it tells what the worlds' bodies are.
  Refutation(std::uint64_t seed, Failures& failures) : seed_(seed), failures_(failures) {}

  void judge(const Sample& sample);
  const RefutationCounts& counts() const { return counts_; }

 private:
  void sameAgain(const Sample& sample, const swept::Checker& checker, const char* where);
  void state(const Sample& sample);
  void motion(const Sample& sample);
  void fail(const Sample& sample, const std::string& what);

  std::uint64_t seed_;
  Failures& failures_;
  RefutationCounts counts_;
};

/// What was asked, where and what came of it, with a command that asks it again.
std::string reproducer(const Sample& sample, std::uint64_t seed);

/// What the library answers about a sample's question when asked by one thread alone.
swept::MotionCertificate ask(const swept::Checker& checker, const Sample& sample);

}  // namespace soak
