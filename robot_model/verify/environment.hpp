// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace swept::verify {

/// Calls `work` in the default floating-point environment, of which the terms for rounding speak:
/// to nearest, and denormals are what they are. The caller's environment comes back afterwards,
/// also after an exception.
void inDefaultEnvironment(const std::function<void()>& work);

}  // namespace swept::verify
