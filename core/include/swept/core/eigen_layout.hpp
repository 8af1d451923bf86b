// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "swept/core/arithmetic.hpp"

namespace swept::detail {

/// Defined only for the library's own settings: the alignment (bytes) of types of fixed size, and
/// whether Eigen relies on malloc's alignment for those of dynamic size.
template <int alignment, bool mallocAligned>
void libraryAlignsEigenTypesTo();

/// Eigen aligns a pose to 16 bytes, to 32 with -mavx, to 64 with AVX-512, and beyond 16 aligns
/// malloc's memory by hand. A program compiled with another -march than the library would look for
/// poses in the wrong place, and free memory that was not allocated. Such a program lacks this
/// function when it is linked. The remedy is to compile both with the same -march. If the library
/// is for every x86-64, you can also compile the program with -DEIGEN_MAX_ALIGN_BYTES=16
/// -DEIGEN_MALLOC_ALREADY_ALIGNED=1.
[[gnu::used]] static void (*const kSameAlignment)() =
    &libraryAlignsEigenTypesTo<EIGEN_MAX_STATIC_ALIGN_BYTES, (EIGEN_MALLOC_ALREADY_ALIGNED != 0)>;

}  // namespace swept::detail
