// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace swept::verify {

/// Calls `work` in the default floating-point environment, which the rounding terms assume:
/// rounding to nearest, with denormal numbers. The caller's environment is restored afterwards,
/// also after an exception.
void inDefaultEnvironment(const std::function<void()>& work);

}  // namespace swept::verify
