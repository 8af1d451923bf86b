// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/did_you_mean.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <vector>

namespace swept {
namespace {

/// Longer names get no suggestion: the time grows with the square.
constexpr std::size_t kLongest = 256;

/// Capital letters count as lower case.
bool same(char a, char b) {
  return std::tolower(static_cast<unsigned char>(a)) == std::tolower(static_cast<unsigned char>(b));
}

/// Number of changes from one text to the other; see didYouMean.
std::size_t changes(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> least(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        least[i][j] = i + j;
        continue;
      }
      std::size_t best = least[i - 1][j - 1] + (same(a[i - 1], b[j - 1]) ? 0 : 1);
      best = std::min({best, least[i - 1][j] + 1, least[i][j - 1] + 1});
      if (i > 1 && j > 1 && same(a[i - 1], b[j - 2]) && same(a[i - 2], b[j - 1]))
        best = std::min(best, least[i - 2][j - 2] + 1);
      least[i][j] = best;
    }
  return least[a.size()][b.size()];
}

}  // namespace

std::string didYouMean(const std::string& name, std::span<const std::string> known) {
  if (name.size() > kLongest) return {};
  const std::string* nearest = nullptr;
  // A third of the letters: a name that is farther is another name.
  std::size_t least = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    if (candidate.size() > kLongest || candidate.empty()) continue;
    const std::size_t count = changes(name, candidate);
    if (count >= least) continue;
    least = count;
    nearest = &candidate;
  }
  return nearest == nullptr ? "" : "; did you mean '" + *nearest + "'?";
}

}  // namespace swept
