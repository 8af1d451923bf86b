// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "io/child_process.hpp"

namespace swept::test {

/// What `work` returns in a child that is made for it.
inline std::string runInChild(const std::function<std::string()>& work,
                              const detail::ChildLimits& limits) {
  return detail::ChildProcess([&](std::string_view) { return work(); }).ask({}, limits);
}

}  // namespace swept::test
