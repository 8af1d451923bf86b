// SPDX-License-Identifier: BSD-3-Clause
#include "batch/digest.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "swept/robot_model/input.hpp"

namespace swept {

std::string Digest::text() const {
  std::array<char, 17> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%016llx", static_cast<unsigned long long>(value_));
  return buffer.data();
}

std::string fileDigest(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(file, 0, "file cannot be read");
  Digest digest;
  digest.add(bytes);
  return digest.text();
}

}  // namespace swept
