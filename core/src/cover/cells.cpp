// SPDX-License-Identifier: BSD-3-Clause
#include "cover/cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "cover/clip.hpp"
#include "swept/core/bv/aabb.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

Vector3d cornerOf(const Cell& cell, int index) {
  return {(index & 1 ? cell.upper : cell.lower).x(), (index & 2 ? cell.upper : cell.lower).y(),
          (index & 4 ? cell.upper : cell.lower).z()};
}

/// Bit 2 i: the lower side across axis i, bit 2 i + 1: the upper one.
std::uint32_t sidesOf(int corner) {
  std::uint32_t sides = 0;
  for (int axis = 0; axis < 3; ++axis) sides |= 1u << (2 * axis + (corner >> axis & 1));
  return sides;
}

/// Points in one cube of a coarse grid become one point; its blur is their distance from it.
double thinOut(std::vector<Vector3d>& points) {
  constexpr std::size_t kGrid = 4;
  const auto [lower, upper] = Aabb::fit(points);
  struct Box {
    Vector3d lower, upper;
    bool used = false;
  };
  std::array<Box, kGrid * kGrid * kGrid> boxes;
  const double step = std::max((upper - lower).maxCoeff() / kGrid, 1e-300);
  for (const Vector3d& point : points) {
    std::array<std::size_t, 3> at;
    for (int axis = 0; axis < 3; ++axis) {
      at[axis] = std::min(static_cast<std::size_t>((point[axis] - lower[axis]) / step), kGrid - 1);
    }
    Box& box = boxes[(at[2] * kGrid + at[1]) * kGrid + at[0]];
    box.lower = box.used ? box.lower.cwiseMin(point) : point;
    box.upper = box.used ? box.upper.cwiseMax(point) : point;
    box.used = true;
  }
  points.clear();
  double blur = 0.0;
  for (const Box& box : boxes) {
    if (!box.used) continue;
    points.push_back(0.5 * (box.lower + box.upper));
    blur = std::max(blur, 0.5 * (box.upper - box.lower).norm());
  }
  return blur;
}

/// The corners at the other ends of edges that the surface does not meet. An edge lies in two sides
/// of the box, and a patch that meets it, cut a margin m beyond both, has a corner within two
/// margins of both. With y and z inward from the two sides, y >= -m and z >= -m on the patch and y
/// + z <= 0 at some corner, so y <= m and z <= m there, up to the rounding of the cuts.
std::uint32_t freeNeighbours(std::span<const std::uint32_t> touched, int corner) {
  std::uint32_t free = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t sides = sidesOf(corner) & ~(3u << (2 * axis));
    const bool meets = std::any_of(touched.begin(), touched.end(), [sides](std::uint32_t touches) {
      return (touches & sides) == sides;
    });
    if (!meets) free |= 1u << (corner ^ (1 << axis));
  }
  return free;
}

/// The extremes first: a ball that does not contain all of them fails early.
void extremesFirst(std::vector<Vector3d>& points) {
  std::size_t front = 0;
  for (int axis = 0; axis < 3 && front + 2 <= points.size(); ++axis) {
    const auto [low, high] = std::minmax_element(
        points.begin() + static_cast<std::ptrdiff_t>(front), points.end(),
        [axis](const Vector3d& a, const Vector3d& b) { return a[axis] < b[axis]; });
    const auto highest = static_cast<std::size_t>(high - points.begin());
    std::swap(points[front++], *low);
    // The first swap may have moved the other one.
    const std::size_t other =
        highest == front - 1 ? static_cast<std::size_t>(low - points.begin()) : highest;
    if (other >= front) std::swap(points[front++], points[other]);
  }
}

/// Adds the part of a patch that clipPolygon() leaves. Most patches are on one side.
void addPart(std::span<const Vector3d> polygon, int triangle, int axis, double at, double side,
             Cell& half) {
  const auto kept = static_cast<std::size_t>(
      std::count_if(polygon.begin(), polygon.end(),
                    [&](const Vector3d& corner) { return side * (corner[axis] - at) <= 0.0; }));
  if (kept == 0) return;
  const std::size_t before = half.corners.size();
  if (kept == polygon.size()) {
    half.corners.insert(half.corners.end(), polygon.begin(), polygon.end());
  } else {
    clipPolygon(polygon, axis, at, side,
                [&](const Vector3d& corner) { half.corners.push_back(corner); });
  }
  half.patches.push_back({static_cast<int>(half.corners.size() - before), triangle});
}

}  // namespace

bool Cell::isIn(const Vector3d& center, double radius) const {
  const double squared = (middle - center).squaredNorm();
  const double inner = radius - reach;
  if (inner >= 0.0 && squared <= inner * inner) return true;
  const double outer = radius + reach;
  if (!(squared <= outer * outer)) return false;
  const double least = radius - blur;
  if (!(least >= 0.0)) return false;
  for (const Vector3d& point : content) {
    if (!((point - center).squaredNorm() <= least * least)) return false;
  }
  return true;
}

double Cell::farthest(const Vector3d& center) const {
  double squared = 0.0;
  for (const Vector3d& point : content) {
    squared = std::max(squared, (point - center).squaredNorm());
  }
  return std::sqrt(squared) + blur;
}

double Cell::nearest() const {
  double squared = std::numeric_limits<double>::infinity();
  for (const Vector3d& corner : corners) {
    squared = std::min(squared, (corner - middle).squaredNorm());
  }
  return std::sqrt(squared);
}

Cells::Cells(const Solid& solid) : solid_(solid), margin_(1e-12 * solid.scale()) {}

Cell Cells::root() const {
  Cell cell;
  cell.lower = cell.upper = solid_.vertices().front();
  for (const Vector3d& vertex : solid_.vertices()) {
    cell.lower = cell.lower.cwiseMin(vertex);
    cell.upper = cell.upper.cwiseMax(vertex);
  }
  if (solid_.triangles().empty()) {
    for (const Vector3d& vertex : solid_.vertices()) {
      cell.corners.push_back(vertex);
      cell.patches.push_back({1, -1});
    }
  }
  for (std::size_t i = 0; i < solid_.triangles().size(); ++i) {
    for (const int corner : solid_.triangles()[i])
      cell.corners.push_back(solid_.vertices()[corner]);
    cell.patches.push_back({3, static_cast<int>(i)});
  }
  return cell;
}

void Cells::split(const Cell& cell, std::vector<Cell>& out) {
  ++splits_;
  int axis = 0;
  (cell.upper - cell.lower).maxCoeff(&axis);
  const double at = 0.5 * (cell.lower[axis] + cell.upper[axis]);
  std::array<Cell, 2> halves;
  for (Cell& half : halves) {
    half.lower = cell.lower;
    half.upper = cell.upper;
    half.corners.reserve(cell.corners.size() / 2 + 8);
    half.patches.reserve(cell.patches.size() / 2 + 2);
  }
  halves[0].upper[axis] = halves[1].lower[axis] = at;
  std::span<const Vector3d> rest = cell.corners;
  for (const Cell::Patch& patch : cell.patches) {
    const auto polygon = rest.first(static_cast<std::size_t>(patch.count));
    rest = rest.subspan(polygon.size());
    addPart(polygon, patch.triangle, axis, at + margin_, 1.0, halves[0]);
    addPart(polygon, patch.triangle, axis, at - margin_, -1.0, halves[1]);
  }
  for (Cell& half : halves)
    if (!half.isSolid() || cell.isSolid() || middleIsSolid(half)) out.push_back(std::move(half));
}

void Cells::gather(Cell& cell) {
  constexpr std::size_t kMostPoints = 40;
  cell.content = cell.corners;
  const std::uint32_t inside = cell.isSolid() ? 0xff : cornersInside(cell);
  for (int i = 0; i < 8; ++i) {
    if (inside >> i & 1) cell.content.push_back(cornerOf(cell, i));
  }
  cell.blur = 0.0;
  if (cell.content.size() > kMostPoints) {
    cell.blur = thinOut(cell.content);
  }
  cell.middle = Aabb::fit(cell.content).center();
  cell.reach = cell.farthest(cell.middle);
  extremesFirst(cell.content);
}

std::size_t Cells::Hash::operator()(const Key& key) const {
  std::uint64_t hash = 0;
  for (const double coordinate : key) {
    hash = (hash ^ std::bit_cast<std::uint64_t>(coordinate)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return hash;
}

/// Bit i: corner i is in the solid; clear for one that the surface passes within two margins,
/// beside which there is a patch's corner in the content, and for which rays are of no use. Along
/// an edge that the surface does not meet, none or all of it is; so few rays are needed.
std::uint32_t Cells::cornersInside(const Cell& cell) {
  if (!solid_.hasInside()) return 0;
  std::vector<std::uint32_t> touched;  // by corners of patches: the sides, if several
  for (const Vector3d& corner : cell.corners) {
    std::uint32_t touches = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (corner[axis] <= cell.lower[axis] + 2.0 * margin_) touches |= 1u << (2 * axis);
      if (corner[axis] >= cell.upper[axis] - 2.0 * margin_) touches |= 2u << (2 * axis);
    }
    if ((touches & (touches - 1)) == 0) continue;
    if (std::find(touched.begin(), touched.end(), touches) == touched.end()) {
      touched.push_back(touches);
    }
  }
  std::array<bool*, 8> answers{};
  std::uint32_t known = 0;
  std::uint32_t inside = 0;
  std::uint32_t told = 0;  // have passed their result on
  for (int i = 0; i < 8; ++i) {
    const std::uint32_t sides = sidesOf(i);
    if (std::any_of(touched.begin(), touched.end(),
                    [sides](std::uint32_t touches) { return (touches & sides) == sides; })) {
      told |= 1u << i;
      known |= 1u << i;
      continue;
    }
    const Vector3d at = cornerOf(cell, i);
    const auto [entry, isNew] = corners_.try_emplace({at.x(), at.y(), at.z()}, false);
    answers[i] = &entry->second;
    if (isNew) continue;
    known |= 1u << i;
    if (entry->second) inside |= 1u << i;
  }
  while (told != 0xff) {
    if ((known & ~told) == 0) {
      const int asked = std::countr_one(known);
      known |= 1u << asked;
      if (solid_.encloses(cornerOf(cell, asked))) inside |= 1u << asked;
    }
    const int from = std::countr_zero(known & ~told);
    told |= 1u << from;
    const std::uint32_t learn = freeNeighbours(touched, from) & ~known;
    known |= learn;
    if (inside >> from & 1) inside |= learn;
  }
  for (int i = 0; i < 8; ++i) {
    if (answers[i] != nullptr) *answers[i] = inside >> i & 1;
  }
  return inside;
}

bool Cells::middleIsSolid(const Cell& cell) {
  // There is no surface between the middle and the corners.
  for (int i = 0; i < 8; ++i) {
    const Vector3d corner = cornerOf(cell, i);
    const auto known = corners_.find({corner.x(), corner.y(), corner.z()});
    if (known != corners_.end()) return known->second;
  }
  return solid_.encloses(0.5 * (cell.lower + cell.upper));
}

}  // namespace swept::detail
