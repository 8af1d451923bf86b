// SPDX-License-Identifier: BSD-3-Clause
#include "io/warning_kinds.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <utility>

namespace swept::detail {

namespace {

/// Of one kind, before the rest is counted.
constexpr int kShown = 3;

constexpr const char* kFirst = " (first at line ";

/// What warnings of one kind have in common: nothing in front of `warning: `, which is the place,
/// nothing in quotation marks and no digits.
std::string kindOf(const std::string& line) {
  // Counted already: one line for each thing that is missing.
  if (line.ends_with(")") && line.find(kFirst) != std::string::npos) return line;
  const std::string mark = "warning: ";
  const std::size_t place = line.find(mark);
  std::string kind;
  bool quoted = false;
  for (std::size_t i = place == std::string::npos ? 0 : place + mark.size(); i < line.size(); ++i) {
    const char c = line[i];
    if (c == '\'') quoted = !quoted;
    if (!quoted && std::isdigit(static_cast<unsigned char>(c)) == 0) kind += c;
  }
  return kind;
}

class Collector {
 public:
  explicit Collector(const LoadOptions& options) : options_(options) {}
  void add(const std::string& line) { lines_.push_back(line); }
  void flush() {
    std::map<std::string, int> counts;
    for (const std::string& line : lines_) ++counts[kindOf(line)];
    std::map<std::string, int> shown;
    for (const std::string& line : lines_) {
      const std::string kind = kindOf(line);
      const int more = counts[kind] - kShown;
      // One more is no shorter as a number.
      if (more > 1 && shown[kind] >= kShown) continue;
      const bool last = ++shown[kind] == kShown && more > 1;
      options_.warn(last ? line + " (and " + std::to_string(more) + " more of this kind)" : line);
    }
    lines_.clear();
  }

 private:
  const LoadOptions& options_;
  std::vector<std::string> lines_;
};

}  // namespace

void WarningKinds::add(int line, const std::string& one, const std::string& kind) {
  if (source_.options().everyWarning) return source_.warn(line, one);
  const auto known = std::ranges::find(entries_, kind, &Entry::kind);
  if (known == entries_.end())
    entries_.push_back({kind, one, line, 1});
  else
    ++known->count;
}

void WarningKinds::flush() {
  for (const Entry& entry : entries_) {
    if (entry.count == 1) {
      source_.warn(entry.line, entry.one);
      continue;
    }
    std::string text = entry.kind;
    if (const std::size_t hash = text.find('#'); hash != std::string::npos)
      text.replace(hash, 1, std::to_string(entry.count));
    source_.warn(entry.line, text + kFirst + std::to_string(entry.line) + ")");
  }
  entries_.clear();
}

void withFewWarnings(const LoadOptions& options,
                     const std::function<void(const LoadOptions&)>& action) {
  if (!options.warn || options.everyWarning) return action(options);
  Collector collector(options);
  LoadOptions kept = options;
  kept.warn = [&collector](const std::string& line) { collector.add(line); };
  try {
    action(kept);
  } catch (...) {
    collector.flush();
    throw;
  }
  collector.flush();
}

}  // namespace swept::detail
