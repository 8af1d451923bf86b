// SPDX-License-Identifier: BSD-3-Clause
#include "models_dir.hpp"

std::string modelsDir() {
  return SWEPT_MODELS_DIR;
}
