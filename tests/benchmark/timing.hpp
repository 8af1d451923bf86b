// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

/// Measuring several libraries on the same work, in turns.
namespace swept::benchmark {

/// s, of this thread alone: other programs on the machine do not count.
inline double cpuSeconds() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Bytes on the heap now: what a thing holds is the difference made by building it. The same
/// measure for every library, unlike what each tells of itself.
inline double heapBytes() {
  const struct mallinfo2 heap = mallinfo2();
  return static_cast<double>(heap.uordblks) + static_cast<double>(heap.hblkhd);
}

/// One library's way to do the whole work once.
struct Contestant {
  std::string name;
  std::function<void()> run;
  double seconds = std::numeric_limits<double>::infinity();  ///< the least of all turns
};

/// Takes turns, so that a change of the machine's speed meets every contestant, and keeps the least
/// time of each: noise only adds. One unmeasured turn first.
inline void takeTurns(std::vector<Contestant>& contestants, int turns) {
  for (int turn = -1; turn < turns; ++turn) {
    for (Contestant& contestant : contestants) {
      const double start = cpuSeconds();
      contestant.run();
      const double seconds = cpuSeconds() - start;
      if (turn >= 0) contestant.seconds = std::min(contestant.seconds, seconds);
    }
  }
}

/// The fastest of all but the first, which is ours; null if it is alone.
inline const Contestant* bestPeer(const std::vector<Contestant>& contestants) {
  if (contestants.size() < 2) return nullptr;
  return &*std::min_element(
      contestants.begin() + 1, contestants.end(),
      [](const Contestant& a, const Contestant& b) { return a.seconds < b.seconds; });
}

inline std::string number(double value, int digits = 3) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

/// Rows of a Markdown table, printed as they come.
class MarkdownTable {
 public:
  explicit MarkdownTable(const std::vector<std::string>& head) {
    row(head);
    row(std::vector<std::string>(head.size(), "---"));
  }
  void row(const std::vector<std::string>& cells) const {
    for (const std::string& cell : cells) std::printf("| %s ", cell.c_str());
    std::printf("|\n");
    std::fflush(stdout);
  }
};

/// `ours`, `peer (name)` and their ratio, in units of `unit` seconds per query.
inline std::vector<std::string> comparison(const std::vector<Contestant>& contestants,
                                           std::size_t queries, double unit) {
  const double scale = 1.0 / (unit * static_cast<double>(queries));
  const Contestant* peer = bestPeer(contestants);
  const double ours = contestants.front().seconds;
  if (peer == nullptr) return {number(ours * scale), "-", "-"};
  return {number(ours * scale), number(peer->seconds * scale) + " (" + peer->name + ")",
          number(ours / peer->seconds, 2)};
}

}  // namespace swept::benchmark
