// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

/// Counts what the program takes from the heap: replaces its operators new and delete. For one
/// source of a program.
namespace swept::test {

inline std::atomic<long> allocations{0};
inline std::atomic<long> heldBytes{0};  ///< by whoever has not given it back

inline void* counted(std::size_t size, std::size_t alignment) {
  void* memory = nullptr;
  if (posix_memalign(&memory, std::max(alignment, sizeof(void*)), std::max<std::size_t>(size, 1)))
    throw std::bad_alloc();
  ++allocations;
  heldBytes += static_cast<long>(malloc_usable_size(memory));
  return memory;
}

inline void release(void* memory) {
  heldBytes -= static_cast<long>(malloc_usable_size(memory));
  std::free(memory);
}

}  // namespace swept::test

void* operator new(std::size_t size) {
  return swept::test::counted(size, alignof(std::max_align_t));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return swept::test::counted(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* memory) noexcept {
  swept::test::release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  swept::test::release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  swept::test::release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  swept::test::release(memory);
}
