// SPDX-License-Identifier: BSD-3-Clause
#include "io/lzf.hpp"

#include <cstring>

namespace swept::detail {

namespace {

constexpr unsigned kFirstRepetition = 32;  ///< control bytes below it are lengths of runs, less 1
constexpr std::size_t kLongLength = 7;     ///< of a repetition: another byte is added to it

/// The two may overlap: then the copy repeats itself.
void repeat(char* to, std::size_t distance, std::size_t length) {
  const char* from = to - distance;
  if (distance >= length) {
    std::memcpy(to, from, length);
    return;
  }
  for (std::size_t i = 0; i < length; ++i) to[i] = from[i];
}

}  // namespace

std::optional<LzfFault> expandLzf(std::span<const char> data, std::span<char> output) {
  const auto byteAt = [&](std::size_t i) { return static_cast<unsigned char>(data[i]); };
  const auto tooMany = [&](std::size_t at) {
    return LzfFault{at, "they expand to more than " + std::to_string(output.size()) + " bytes"};
  };
  std::size_t in = 0;
  std::size_t out = 0;
  while (in < data.size()) {
    const std::size_t start = in;
    const unsigned control = byteAt(in++);
    if (control < kFirstRepetition) {
      const std::size_t length = control + 1;
      if (length > data.size() - in) return LzfFault{start, "a run goes beyond their end"};
      if (length > output.size() - out) return tooMany(start);
      std::memcpy(output.data() + out, data.data() + in, length);
      in += length;
      out += length;
      continue;
    }
    std::size_t length = control >> 5;
    if (data.size() - in < (length == kLongLength ? 2 : 1)) {
      return LzfFault{start, "they end within a repetition"};
    }
    if (length == kLongLength) length += byteAt(in++);
    length += 2;
    const std::size_t distance = ((control & 0x1fu) << 8 | byteAt(in++)) + 1;
    if (distance > out) return LzfFault{start, "a repetition goes back beyond their beginning"};
    if (length > output.size() - out) return tooMany(start);
    repeat(output.data() + out, distance, length);
    out += length;
  }
  if (out < output.size()) {
    return LzfFault{in, "they expand to " + std::to_string(out) + " bytes instead of " +
                            std::to_string(output.size())};
  }
  return std::nullopt;
}

}  // namespace swept::detail
