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

/// The header of each request.
struct RequestHead {
  std::uint64_t seconds;  ///< of processor time, from now on
  std::uint64_t memory;   ///< bytes, more than the parent had
  std::uint64_t size;     ///< bytes of the request
};

/// Bytes of address space in use; 0: unknown, or it cannot be limited. Call it before the fork: a
/// child of a process with threads must not read /proc.
std::uint64_t addressSpace();

/// Exit codes of a child that could not send its whole answer, and of one that ran out of memory
/// for it.
inline constexpr int kUnfinished = 17, kNoMemory = 18;

/// The main loop of a child. It answers requests, each of which is its size and the text, until the
/// other end of the socket closes. It does not return, so the child repeats nothing that the parent
/// does at its end. `parentMemory` is the parent's addressSpace().
[[noreturn]] void liveAsChild(int socket, pid_t parent, const ChildWork& work,
                              std::uint64_t parentMemory);

}  // namespace swept::detail
