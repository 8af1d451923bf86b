// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

/// Hilbert's curve in space, by its states (Hamilton, Rau-Chaplin 2008, "Compact Hilbert indices:
/// space-filling curves for domains with unequal side lengths", sections 2.1 to 2.4): consecutive
/// cells have a face in common.
namespace swept::detail {

/// Two levels of the curve at a time: 6 bits of the cell give 6 of the index.
class HilbertCurve {
 public:
  static constexpr int kMostBits = 16;  ///< of each coordinate

  /// The bits of a cell's coordinates, below 2^kMostBits, side by side.
  static std::uint64_t cell(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return spread(x) | spread(y) << 1 | spread(z) << 2;
  }

  /// Indices of cells among 2^(3 bits), with `bits` even and coordinates below 2^bits. For several
  /// cells at once, since each step for one cell waits for the step before.
  template <std::size_t N>
  static std::array<std::uint64_t, N> indices(const std::array<std::uint64_t, N>& cells, int bits) {
    std::array<std::uint64_t, N> found{};
    std::array<std::uint32_t, N> state{};
    for (int at = 3 * bits - 6; at >= 0; at -= 6) {
      for (std::size_t i = 0; i < N; ++i) {
        const Step step = kSteps[state[i] * 64 + ((cells[i] >> at) & 63U)];
        found[i] = found[i] << 6 | step.index;
        state[i] = step.state;
      }
    }
    return found;
  }

 private:
  struct Step {
    std::uint8_t index;
    std::uint8_t state;
  };

  /// Bit i to bit 3 i.
  static std::uint64_t spread(std::uint64_t v) {
    v = (v | v << 16) & 0x00FF0000FFU;
    v = (v | v << 8) & 0xF00F00F00FU;
    v = (v | v << 4) & 0xC30C30C30C3U;
    return (v | v << 2) & 0x249249249249U;
  }

  /// Entry corner and direction of a subcurve: `entry` + 8 * `axis`.
  static constexpr std::uint32_t gray(std::uint32_t i) { return i ^ i >> 1; }
  static constexpr std::uint32_t rotatedRight(std::uint32_t v, std::uint32_t by) {
    by %= 3;
    return (v >> by | v << (3 - by)) & 7U;
  }
  static constexpr std::uint32_t rotatedLeft(std::uint32_t v, std::uint32_t by) {
    return rotatedRight(v, 3 - by % 3);
  }
  static constexpr std::uint32_t ungray(std::uint32_t v) { return v ^ v >> 1 ^ v >> 2; }
  static constexpr std::uint32_t entryOf(std::uint32_t i) {
    return i == 0 ? 0 : gray((i - 1) / 2 * 2);
  }
  static constexpr std::uint32_t axisOf(std::uint32_t i) {
    if (i == 0) return 0;
    const std::uint32_t odd = i % 2 == 0 ? i - 1 : i;
    return static_cast<std::uint32_t>(std::countr_one(odd)) % 3;
  }

  /// One level: bits of the cell, and the state that it is entered in.
  static constexpr Step step(std::uint32_t state, std::uint32_t cell) {
    const std::uint32_t entry = state % 8;
    const std::uint32_t axis = state / 8;
    const std::uint32_t i = ungray(rotatedRight(cell ^ entry, axis + 1));
    const std::uint32_t nextEntry = entry ^ rotatedLeft(entryOf(i), axis + 1);
    const std::uint32_t nextAxis = (axis + axisOf(i) + 1) % 3;
    return {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(nextEntry + 8 * nextAxis)};
  }

  /// Of 24 states, the 64 cells of two levels each.
  using Steps = std::array<Step, 1536>;

  static constexpr Steps makeSteps() {
    Steps steps{};
    for (std::uint32_t state = 0; state < 24; ++state) {
      for (std::uint32_t cells = 0; cells < 64; ++cells) {
        const Step first = step(state, cells >> 3);
        const Step second = step(first.state, cells & 7U);
        steps[state * 64 + cells] = {static_cast<std::uint8_t>(first.index << 3 | second.index),
                                     second.state};
      }
    }
    return steps;
  }

  static const Steps kSteps;
};

inline constexpr HilbertCurve::Steps HilbertCurve::kSteps = makeSteps();

}  // namespace swept::detail
