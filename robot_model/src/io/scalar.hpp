// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace swept::detail {

/// A number type of binary files.
enum class Scalar : std::uint8_t {
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

inline bool isFloat(Scalar type) {
  return type == Scalar::Float32 || type == Scalar::Float64;
}

/// The size in bytes.
inline std::size_t sizeOf(Scalar type) {
  constexpr std::array<std::size_t, 10> kSizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

template <typename T>
T bytesAs(const char* bytes, std::endian order) {
  std::array<char, sizeof(T)> own;
  std::memcpy(own.data(), bytes, sizeof(T));
  if (order != std::endian::native) std::reverse(own.begin(), own.end());
  return std::bit_cast<T>(own);
}

/// The number at `bytes`, which must hold enough bytes.
inline double decode(Scalar type, const char* bytes, std::endian order) {
  switch (type) {
    case Scalar::Int8:
      return bytesAs<std::int8_t>(bytes, order);
    case Scalar::UInt8:
      return bytesAs<std::uint8_t>(bytes, order);
    case Scalar::Int16:
      return bytesAs<std::int16_t>(bytes, order);
    case Scalar::UInt16:
      return bytesAs<std::uint16_t>(bytes, order);
    case Scalar::Int32:
      return bytesAs<std::int32_t>(bytes, order);
    case Scalar::UInt32:
      return bytesAs<std::uint32_t>(bytes, order);
    case Scalar::Int64:
      return static_cast<double>(bytesAs<std::int64_t>(bytes, order));
    case Scalar::UInt64:
      return static_cast<double>(bytesAs<std::uint64_t>(bytes, order));
    case Scalar::Float32:
      return static_cast<double>(bytesAs<float>(bytes, order));
    case Scalar::Float64:
      break;
  }
  return bytesAs<double>(bytes, order);
}

}  // namespace swept::detail
