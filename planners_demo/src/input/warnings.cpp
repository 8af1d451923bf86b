// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "input/task.hpp"
#include "output/terminal_text.hpp"

namespace swept {

bool Warnings::isNew(const std::string& line) {
  if (std::ranges::find(seen_, line) != seen_.end()) return false;
  seen_.push_back(line);
  return true;
}

void Warnings::give(const std::string& line) const {
  if (taker_)
    taker_(line);
  else
    printMessage(line);
}

void Warnings::operator()(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (!quiet_ && isNew(line)) give(line);
}

void Warnings::ofUnchecked(const std::string& line) {
  const std::lock_guard lock(mutex_);
  if (!isNew(line)) return;
  unchecked_.push_back(line);
  give(line);
}

std::vector<std::string> Warnings::unchecked() const {
  const std::lock_guard lock(mutex_);
  return unchecked_;
}

}  // namespace swept
