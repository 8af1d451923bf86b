// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace swept::detail {

/// What a child does with a request.
using ChildWork = std::function<std::string(std::string_view)>;

/// Goes ahead of each request.
struct RequestHead {
  std::uint64_t seconds;  ///< of processor time, from now on
  std::uint64_t memory;   ///< bytes, more than the parent had
  std::uint64_t size;     ///< bytes of the request
};

/// Bytes of address space in use; 0: not known, or not to be bounded. Before the fork: reading
/// /proc is not for a child of a process with threads.
std::uint64_t addressSpace();

/// How a child ends that could not say all, and one that had too little memory for it.
inline constexpr int kUnfinished = 17, kNoMemory = 18;

/// The life of a child: it answers requests, each with its size and the text, until there is no
/// other end of the socket any more. It does not return, so that nothing of the parent is done
/// twice. `parentMemory` is the parent's addressSpace().
[[noreturn]] void liveAsChild(int socket, pid_t parent, const ChildWork& work,
                              std::uint64_t parentMemory);

}  // namespace swept::detail
