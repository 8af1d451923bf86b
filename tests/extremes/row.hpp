// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

/// How the library's answers to extreme input compare with the truth.
namespace extremes {

enum class Outcome : std::uint8_t {
  Right,
  Undecided,  ///< the query does not tell which side, and the truth is within its tolerance
  Far,        ///< it does not tell although the truth is beyond the tolerance
  Wrong,
};

/// What one query answered.
struct Answer {
  Outcome outcome = Outcome::Right;
  double error = 0.0;     ///< relative to the size of the sample
  double bound = 0.0;     ///< likewise: what the answer says the error is at most
  bool honest = true;     ///< the truth is where the answer says that it is
  bool apart = true;      ///< the truth: no contact
  std::int64_t work = 0;  ///< iterations, intervals, pairs
  double seconds = 0.0;   ///< s
  std::string text;       ///< C++ of the sample, with answer and truth, unless all is right
};

/// One query about all samples of one case.
struct Row {
  std::string query, name;
  std::string baseline;    ///< the case that is ordinary for this one
  double workLimit = 0.0;  ///< times the work of the ordinary case
  bool bothSides = true;   ///< samples have to be apart, and to touch, a quarter each at least
  bool countsWork = true;
  bool hasBound = true;  ///< the answer is more than yes or no
  int n = 0, right = 0, undecided = 0, far = 0, wrong = 0;
  int apart = 0;  ///< samples without contact
  bool honest = true;
  double error = 0.0, bound = 0.0;
  std::int64_t work = 0;
  std::vector<double> seconds;
  std::string failure;  ///< the text of the first answer that is not as it should be
  double workRatio = 0.0, timeRatio = 0.0;

  /// Others state their work as a multiple of this one's.
  bool isOrdinary() const { return name == baseline; }

  void add(const Answer& answer) {
    ++n;
    apart += answer.apart;
    right += answer.outcome == Outcome::Right;
    undecided += answer.outcome == Outcome::Undecided;
    far += answer.outcome == Outcome::Far;
    wrong += answer.outcome == Outcome::Wrong;
    honest &= answer.honest;
    error = std::max(error, answer.error);
    bound = std::max(bound, answer.bound);
    work = std::max(work, answer.work);
    seconds.push_back(answer.seconds);
    const bool failed =
        answer.outcome == Outcome::Wrong || answer.outcome == Outcome::Far || !answer.honest;
    if (failed && failure.empty()) failure = answer.text;
  }
};

/// FNV-1a: a case has the same samples wherever it is in the table.
inline std::uint64_t seedOf(const std::string& name) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

/// All rows, with work and time relative to the ordinary cases.
std::vector<Row> measured();

/// The result of `query`, and how long it took.
template <class Query>
auto timed(const Query& query, double& seconds) {
  const auto start = std::chrono::steady_clock::now();
  auto result = query();
  seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace extremes
