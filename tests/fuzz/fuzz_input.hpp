// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "swept/robot_model/input.hpp"

/// What the fuzz targets have in common. Each defines LLVMFuzzerTestOneInput.
namespace swept::fuzz {

/// A folder of the process, for readers that want files; in memory where the system has such.
class Files {
 public:
  Files() {
    const std::filesystem::path memory = "/dev/shm";
    const auto parent =
        std::filesystem::is_directory(memory) ? memory : std::filesystem::temp_directory_path();
    folder_ = parent / ("swept-fuzz-" + std::to_string(getpid()));
    std::filesystem::create_directory(folder_);
  }
  ~Files() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::filesystem::path file = folder_ / name;
    std::ofstream(file, std::ios::binary)
        .write(text.data(), static_cast<std::streamsize>(text.size()));
    return file;
  }

 private:
  std::filesystem::path folder_;
};

inline const Files& files() {
  static const Files kFiles;
  return kFiles;
}

inline std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Ends the process: what the fuzzer is to find.
[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "fuzz: %s\n", what.c_str());
  std::abort();
}

/// Reading may refuse the input, and says so by InputError with a message. Anything else that is
/// thrown is a find.
template <typename Read>
void mayRefuse(const Read& read) {
  try {
    read();
  } catch (const InputError& error) {
    if (error.message().empty()) fail("an error without a message");
  } catch (const std::exception& error) {
    fail(std::string("threw ") + error.what());
  }
}

/// Numbers from bytes; zeros when there are no more.
class Numbers {
 public:
  Numbers(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  int signedByte() {
    const int value = byte();
    return value < 128 ? value : value - 256;
  }
  /// In [-1, 1], with 0, 1 and numbers near them among few bytes.
  double unit() {
    const int high = signedByte();
    const int low = signedByte();
    const double coarse = high == -128 ? -1.0 : high / 127.0;
    return std::min(
        1.0,
        std::max(-1.0,
                 coarse + (low % 16 == 0 ? 0.0 : std::ldexp(low, -2 * (std::abs(low) % 28) - 10))));
  }
  /// Between 1e-3 and 1e3 for most bytes, up to 1e-9 and 1e9 for some.
  double size() {
    const int exponent = signedByte();
    const double digits = 1.0 + byte() / 64.0;
    return digits * std::pow(10.0, exponent % 8 == 7 ? exponent / 15.0 : exponent / 50.0);
  }
  bool isEmpty() const { return bytes_.empty(); }

 private:
  std::span<const std::uint8_t> bytes_;
};

}  // namespace swept::fuzz
