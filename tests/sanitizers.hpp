// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Which sanitizer this is built with: GCC and clang say so in different ways.
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SWEPT_TEST_ADDRESS_SANITIZER
#endif
#if __has_feature(thread_sanitizer)
#define SWEPT_TEST_THREAD_SANITIZER
#endif
#endif

#if defined(__SANITIZE_ADDRESS__)
#define SWEPT_TEST_ADDRESS_SANITIZER
#endif
#if defined(__SANITIZE_THREAD__)
#define SWEPT_TEST_THREAD_SANITIZER
#endif
