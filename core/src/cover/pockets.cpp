// SPDX-License-Identifier: BSD-3-Clause
#include "cover/pockets.hpp"

#include <algorithm>
#include <cmath>

#include "cover/clip.hpp"
#include "swept/core/bv/aabb.hpp"

namespace swept::detail {

using Eigen::Vector3d;

Pockets::Pockets(std::span<const Vector3d> vertices, std::span<const Eigen::Vector3i> triangles) {
  constexpr int kResolution = 48;
  const auto [lower, upper] = Aabb::fit(vertices);
  cell_ = (upper - lower).maxCoeff() / kResolution;
  if (!(cell_ > 0.0) || !std::isfinite(cell_)) return;
  for (int axis = 0; axis < 3; ++axis) {
    counts_[axis] = static_cast<int>((upper[axis] - lower[axis]) / cell_) + 4;
  }
  // No triangle reaches the outermost layer, whatever the rounding.
  origin_ = lower - Vector3d::Constant(1.5 * cell_);
  kinds_.assign(static_cast<std::size_t>(counts_[0]) * counts_[1] * counts_[2], Kind::Unreached);
  const Parts parts = partsOf(vertices, triangles);
  for (const Part& part : parts.list) kinds_[flat(part.cell)] = Kind::Occupied;
  walkFromOutside();
  areNone_ = std::find(kinds_.begin(), kinds_.end(), Kind::Unreached) == kinds_.end();
  if (!areNone_) peel(parts, vertices, triangles);
}

Pockets::Parts Pockets::partsOf(std::span<const Vector3d> vertices,
                                std::span<const Eigen::Vector3i> triangles) const {
  Parts parts;
  parts.list.reserve(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::array<Vector3d, 3> corners;
    Index first;
    Index last;
    for (int corner = 0; corner < 3; ++corner) corners[corner] = vertices[triangles[i][corner]];
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
      const int most = counts_[axis] - 1;
      first[axis] = std::clamp(static_cast<int>((low - origin_[axis]) / cell_), 0, most);
      last[axis] = std::clamp(static_cast<int>((high - origin_[axis]) / cell_), 0, most);
    }
    if (first == last) {
      parts.list.push_back({first, static_cast<int>(i), 0, 0});
      continue;
    }
    divide(corners, first, last, static_cast<int>(i), parts);
  }
  return parts;
}

void Pockets::divide(std::span<const Vector3d> polygon, const Index& first, const Index& last,
                     int triangle, Parts& parts) const {
  int axis = 0;
  for (int other = 1; other < 3; ++other) {
    if (last[other] - first[other] > last[axis] - first[axis]) axis = other;
  }
  if (first[axis] == last[axis]) {
    parts.list.push_back({first, triangle, parts.corners.size(), static_cast<int>(polygon.size())});
    parts.corners.insert(parts.corners.end(), polygon.begin(), polygon.end());
    return;
  }
  const int middle = (first[axis] + last[axis]) / 2;
  const double at = origin_[axis] + (middle + 1) * cell_;
  std::array<Vector3d, 9> half;
  for (const double side : {1.0, -1.0}) {
    std::size_t count = 0;
    clipPolygon(polygon, axis, at, side, [&](const Vector3d& corner) {
      if (count < half.size()) half[count++] = corner;
    });
    if (count == 0) continue;
    Index from = first;
    Index to = last;
    (side > 0.0 ? to : from)[axis] = side > 0.0 ? middle : middle + 1;
    divide(std::span(half).first(count), from, to, triangle, parts);
  }
}

/// The skin consists of whole triangles where no part is within.
void Pockets::peel(const Parts& parts, std::span<const Vector3d> vertices,
                   std::span<const Eigen::Vector3i> triangles) {
  std::vector<bool> isWithin(triangles.size(), false);
  isSkin_.assign(triangles.size(), false);
  for (const Part& part : parts.list) {
    (touchesOutside(part.cell) ? isSkin_ : isWithin)[static_cast<std::size_t>(part.triangle)] =
        true;
  }
  const auto add = [this](std::span<const Vector3d> polygon) {
    const auto base = static_cast<int>(skinVertices_.size());
    skinVertices_.insert(skinVertices_.end(), polygon.begin(), polygon.end());
    for (int i = 2; i < static_cast<int>(polygon.size()); ++i) {
      skinTriangles_.emplace_back(base, base + i - 1, base + i);
    }
  };
  auto part = parts.list.begin();
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto first = part;
    while (part != parts.list.end() && part->triangle == static_cast<int>(i)) ++part;
    if (!isSkin_[i]) continue;
    if (!isWithin[i]) {
      add(std::array{vertices[triangles[i][0]], vertices[triangles[i][1]],
                     vertices[triangles[i][2]]});
      continue;
    }
    for (auto each = first; each != part; ++each) {
      if (!touchesOutside(each->cell)) continue;
      add(std::span(parts.corners).subspan(each->first, static_cast<std::size_t>(each->count)));
    }
  }
}

bool Pockets::touchesOutside(const Index& cell) {
  Kind& kind = kinds_[flat(cell)];
  if (kind != Kind::Occupied) return kind == Kind::Skin;
  kind = Kind::Within;
  for (int i = 0; i < 27; ++i) {
    const Index near{cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1};
    bool isCell = true;
    for (int axis = 0; axis < 3; ++axis) {
      isCell = isCell && near[axis] >= 0 && near[axis] < counts_[axis];
    }
    if (isCell && kinds_[flat(near)] == Kind::Outside) kind = Kind::Skin;
  }
  return kind == Kind::Skin;
}

void Pockets::walkFromOutside() {
  std::vector<Index> pending{{0, 0, 0}};
  kinds_[0] = Kind::Outside;
  while (!pending.empty()) {
    const Index cell = pending.back();
    pending.pop_back();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Index next = cell;
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= counts_[axis]) continue;
        Kind& kind = kinds_[flat(next)];
        if (kind != Kind::Unreached) continue;
        kind = Kind::Outside;
        pending.push_back(next);
      }
    }
  }
}

Pockets::Kind Pockets::kindAt(const Vector3d& p) const {
  if (kinds_.empty()) return Kind::Outside;
  Index cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double along = (p[axis] - origin_[axis]) / cell_;
    if (!(along >= 0.0) || !(along < counts_[axis])) return Kind::Outside;
    cell[axis] = static_cast<int>(along);
  }
  return kinds_[flat(cell)];
}

bool Pockets::contain(const Vector3d& p, double toSkin) const {
  // A cell with triangles that are well away from the skin has no part outside.
  constexpr double kWellAway = 2.0;
  const Kind kind = kindAt(p);
  return kind == Kind::Unreached || (kind != Kind::Outside && toSkin > kWellAway * cell_);
}

}  // namespace swept::detail
