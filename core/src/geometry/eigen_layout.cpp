// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/eigen_layout.hpp"

namespace swept::detail {

template <int alignment, bool mallocAligned>
void libraryAlignsEigenTypesTo() {}

template void
libraryAlignsEigenTypesTo<EIGEN_MAX_STATIC_ALIGN_BYTES, (EIGEN_MALLOC_ALREADY_ALIGNED != 0)>();

}  // namespace swept::detail
