// SPDX-License-Identifier: BSD-3-Clause
// Eight floats as a value, for the instruction set of the including source. Included once per
// instruction set.
#if defined(SWEPT_SIMD_F8) == defined(HWY_TARGET_TOGGLE)
#ifdef SWEPT_SIMD_F8
#undef SWEPT_SIMD_F8
#else
#define SWEPT_SIMD_F8
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "simd/compile/row.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Part = hn::CappedTag<float, kLanes>;
inline constexpr int kParts = kLanes / static_cast<int>(hn::MaxLanes(Part()));
inline constexpr std::ptrdiff_t kPartLanes = kLanes / kParts;

struct F8 {
  hn::Vec<Part> part[kParts];
};

/// A bit per lane.
using Lanes = std::uint32_t;

HWY_INLINE F8 set(float value) {
  F8 r;
  for (int i = 0; i < kParts; ++i) r.part[i] = hn::Set(Part(), value);
  return r;
}
HWY_INLINE F8 load(const Row& row) {
  F8 r;
  for (int i = 0; i < kParts; ++i) r.part[i] = hn::Load(Part(), row.lane + i * kPartLanes);
  return r;
}
HWY_INLINE void store(const F8& a, Row& row) {
  for (int i = 0; i < kParts; ++i) hn::Store(a.part[i], Part(), row.lane + i * kPartLanes);
}

#define SWEPT_F8_BINARY(name, function)                                              \
  HWY_INLINE F8 name(const F8& a, const F8& b) {                                     \
    F8 r;                                                                            \
    for (int i = 0; i < kParts; ++i) r.part[i] = hn::function(a.part[i], b.part[i]); \
    return r;                                                                        \
  }
SWEPT_F8_BINARY(operator+, Add)
SWEPT_F8_BINARY(operator-, Sub)
SWEPT_F8_BINARY(operator*, Mul)
SWEPT_F8_BINARY(operator/, Div)
// The larger and the smaller of two numbers; b if either is NaN, or if they are equal. x86-64's
// instructions do this. Those of others drop a NaN, and so could a proof that no number supports.
#if HWY_ARCH_X86 && HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
SWEPT_F8_BINARY(larger, Max)
SWEPT_F8_BINARY(smaller, Min)
#else
HWY_INLINE F8 larger(const F8& a, const F8& b) {
  F8 r;
  for (int i = 0; i < kParts; ++i)
    r.part[i] = hn::IfThenElse(hn::Gt(a.part[i], b.part[i]), a.part[i], b.part[i]);
  return r;
}
HWY_INLINE F8 smaller(const F8& a, const F8& b) {
  F8 r;
  for (int i = 0; i < kParts; ++i)
    r.part[i] = hn::IfThenElse(hn::Lt(a.part[i], b.part[i]), a.part[i], b.part[i]);
  return r;
}
#endif
#undef SWEPT_F8_BINARY

#define SWEPT_F8_UNARY(name, function)                                    \
  HWY_INLINE F8 name(const F8& a) {                                       \
    F8 r;                                                                 \
    for (int i = 0; i < kParts; ++i) r.part[i] = hn::function(a.part[i]); \
    return r;                                                             \
  }
SWEPT_F8_UNARY(absolute, Abs)
SWEPT_F8_UNARY(root, Sqrt)
SWEPT_F8_UNARY(nearest, Round)
SWEPT_F8_UNARY(operator-, Neg)
#undef SWEPT_F8_UNARY

/// a * b + c and c - a * b.
HWY_INLINE F8 multiplyAdd(const F8& a, const F8& b, const F8& c) {
  F8 r;
  for (int i = 0; i < kParts; ++i) r.part[i] = hn::MulAdd(a.part[i], b.part[i], c.part[i]);
  return r;
}
HWY_INLINE F8 subtractProduct(const F8& c, const F8& a, const F8& b) {
  F8 r;
  for (int i = 0; i < kParts; ++i) r.part[i] = hn::NegMulAdd(a.part[i], b.part[i], c.part[i]);
  return r;
}

HWY_INLINE Lanes bitsOf(const hn::Mask<Part>& mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Part(), mask, bits);
  return bits[0];
}
/// Lanes in which a > b; none if either is NaN.
HWY_INLINE Lanes above(const F8& a, const F8& b) {
  Lanes lanes = 0;
  for (int i = 0; i < kParts; ++i)
    lanes |= bitsOf(hn::Gt(a.part[i], b.part[i])) << (i * kPartLanes);
  return lanes;
}
HWY_INLINE Lanes below(const F8& a, const F8& b) {
  return above(b, a);
}

/// The least and the largest of all lanes.
HWY_INLINE float leastLane(const F8& a) {
  auto least = a.part[0];
  for (int i = 1; i < kParts; ++i) least = hn::Min(least, a.part[i]);
  return hn::GetLane(hn::MinOfLanes(Part(), least));
}
HWY_INLINE float largestLane(const F8& a) {
  auto largest = a.part[0];
  for (int i = 1; i < kParts; ++i) largest = hn::Max(largest, a.part[i]);
  return hn::GetLane(hn::MaxOfLanes(Part(), largest));
}

struct V3 {
  F8 x, y, z;
};
HWY_INLINE V3 load3(const Row (&rows)[3]) {
  return {load(rows[0]), load(rows[1]), load(rows[2])};
}
HWY_INLINE void store3(const V3& a, Row (&rows)[3]) {
  store(a.x, rows[0]);
  store(a.y, rows[1]);
  store(a.z, rows[2]);
}
HWY_INLINE V3 set3(const float (&v)[3]) {
  return {set(v[0]), set(v[1]), set(v[2])};
}
HWY_INLINE V3 operator+(const V3& a, const V3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
HWY_INLINE V3 operator-(const V3& a, const V3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
HWY_INLINE V3 operator*(const F8& s, const V3& a) {
  return {s * a.x, s * a.y, s * a.z};
}
HWY_INLINE F8 dot(const V3& a, const V3& b) {
  return multiplyAdd(a.x, b.x, multiplyAdd(a.y, b.y, a.z * b.z));
}
/// a + s b
HWY_INLINE V3 along(const V3& a, const F8& s, const V3& b) {
  return {multiplyAdd(s, b.x, a.x), multiplyAdd(s, b.y, a.y), multiplyAdd(s, b.z, a.z)};
}
/// a + b x c
HWY_INLINE V3 addCross(const V3& a, const V3& b, const V3& c) {
  return {multiplyAdd(b.y, c.z, subtractProduct(a.x, b.z, c.y)),
          multiplyAdd(b.z, c.x, subtractProduct(a.y, b.x, c.z)),
          multiplyAdd(b.x, c.y, subtractProduct(a.z, b.y, c.x))};
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {subtractProduct(a.y * b.z, a.z, b.y), subtractProduct(a.z * b.x, a.x, b.z),
          subtractProduct(a.x * b.y, a.y, b.x)};
}
/// Row-major matrix times vector, plus a.
HWY_INLINE V3 addRotated(const V3& a, const Row (&m)[9], const V3& v) {
  return {
      multiplyAdd(load(m[0]), v.x, multiplyAdd(load(m[1]), v.y, multiplyAdd(load(m[2]), v.z, a.x))),
      multiplyAdd(load(m[3]), v.x, multiplyAdd(load(m[4]), v.y, multiplyAdd(load(m[5]), v.z, a.y))),
      multiplyAdd(load(m[6]), v.x,
                  multiplyAdd(load(m[7]), v.y, multiplyAdd(load(m[8]), v.z, a.z)))};
}

/// Transpose of a row-major matrix times a vector.
HWY_INLINE V3 turnedBack(const Row (&m)[9], const V3& v) {
  return {multiplyAdd(load(m[0]), v.x, multiplyAdd(load(m[3]), v.y, load(m[6]) * v.z)),
          multiplyAdd(load(m[1]), v.x, multiplyAdd(load(m[4]), v.y, load(m[7]) * v.z)),
          multiplyAdd(load(m[2]), v.x, multiplyAdd(load(m[5]), v.y, load(m[8]) * v.z))};
}

}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
