// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "models.hpp"

inline void PrintTo(const Model& model, std::ostream* out) {
  *out << model.name;
}

inline auto modelsUnderTest() {
  return testing::ValuesIn(kModels);
}

inline std::string modelName(const testing::TestParamInfo<Model>& tested) {
  return tested.param.name;
}
