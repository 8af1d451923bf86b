// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <malloc.h>

#include <Eigen/Core>  // clang's intrinsics, which declare posix_memalign without noexcept
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

#include "sanitizers.hpp"

/// Counts what the program takes from the heap, whether with new or, as Eigen does, with malloc:
/// replaces the C library's functions, which operator new calls. For one source of a program.
namespace swept::test {

inline std::atomic<long> allocations{0};
inline std::atomic<long> heldBytes{0};  ///< by whoever has not given it back

inline void* taken(void* memory) {
  if (memory == nullptr) return memory;
  ++allocations;
  heldBytes += static_cast<long>(malloc_usable_size(memory));
  return memory;
}

inline void givenBack(void* memory) {
  heldBytes -= static_cast<long>(malloc_usable_size(memory));
}

}  // namespace swept::test

#if defined(SWEPT_TEST_ADDRESS_SANITIZER) || defined(SWEPT_TEST_THREAD_SANITIZER)
// A sanitizer has replaced them already, and tells.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*,
                                                                  std::size_t),
                                                         void (*)(const volatile void*));
namespace swept::test {
inline const int hooks = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void* memory, std::size_t) { taken(const_cast<void*>(memory)); },
    [](const volatile void* memory) { givenBack(const_cast<void*>(memory)); });
}  // namespace swept::test
#else
// Glibc's own names; a program may define each of these functions once.
// NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming,misc-definitions-in-headers)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) noexcept {
  return swept::test::taken(__libc_malloc(size));
}
void* calloc(std::size_t count, std::size_t size) noexcept {
  return swept::test::taken(__libc_calloc(count, size));
}
void* realloc(void* memory, std::size_t size) noexcept {
  swept::test::givenBack(memory);
  return swept::test::taken(__libc_realloc(memory, size));
}
void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return swept::test::taken(__libc_memalign(alignment, size));
}
void* memalign(std::size_t alignment, std::size_t size) noexcept {
  return swept::test::taken(__libc_memalign(alignment, size));
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) noexcept {
  *memory = swept::test::taken(__libc_memalign(alignment, size));
  return *memory == nullptr ? ENOMEM : 0;
}
void free(void* memory) noexcept {
  swept::test::givenBack(memory);
  __libc_free(memory);
}
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming,misc-definitions-in-headers)
#endif
