// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/deforming_refit.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>

#include "continuous/deforming_data.hpp"
#include "threads/crew.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Points that one thread takes at a time: some 50 us of work.
constexpr std::size_t kPoints = 8192;

/// Three stages, each of which needs all of the one before. The result of a piece depends only on
/// the piece. Sums are formed afterwards, in the order of the pieces. The second stage is the first
/// that changes anything.
///
/// It works by subtrees, not by levels of the tree: levels in pieces take as long, with one more
/// wait per level.
class Refit {
 public:
  Refit(DeformingMesh::Data& data, std::span<const Vector3d> vertices)
      : data_(data), vertices_(vertices) {}

  double run(Crew& crew) {
    crew.forPieces(vertices_.size(), kPoints, [this](std::size_t first, std::size_t last) {
      reachTo(largestCoordinate(vertices_.subspan(first, last - first)));
    });
    if (!std::isfinite(reach_))
      throw std::invalid_argument("DeformingMesh: a vertex is not finite");
    crew.forPieces(data_.order.vertexOf.size(), kPoints,
                   [this](std::size_t first, std::size_t last) {
                     data_.copyVertices(vertices_, first, last, data_.start);
                   });
    crew.forPieces(data_.areas.size(), 1, [this](std::size_t subtree, std::size_t) {
      data_.areas[subtree] = followSubtree(data_.order, data_.points, subtree, data_.start);
    });
    data_.start.reach = reach_;
    return data_.finish(data_.start);
  }

 private:
  void reachTo(double reach) {
    if (!std::isfinite(reach)) reach = std::numeric_limits<double>::infinity();
    double known = reach_;
    while (known < reach && !reach_.compare_exchange_weak(known, reach)) {
    }
  }

  DeformingMesh::Data& data_;
  std::span<const Vector3d> vertices_;
  std::atomic<double> reach_{0.0};
};

/// For each thread. Measured on two cores shared with other programs: with a second thread a step
/// took 1.2 to 1.6 times as long with 19 thousand triangles, 0.9 to 1.2 with 38, 0.6 to 1.1 with
/// 77, 0.6 with 259 and 0.55 with 1600. To start one and wait for it takes up to 0.1 ms, which is
/// the time of 12 thousand.
constexpr std::size_t kLeastTriangles = 30000;

}  // namespace

double refit(DeformingMesh::Data& data, std::span<const Vector3d> vertices, unsigned threads) {
  Crew crew(static_cast<unsigned>(std::clamp<std::size_t>(threads, 1, data.areas.size())));
  return Refit(data, vertices).run(crew);
}

unsigned usefulThreads(unsigned threads, std::size_t triangles) {
  const std::size_t most = triangles / kLeastTriangles;
  if (threads == 1 || most < 2) return 1;
  const unsigned wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
  return static_cast<unsigned>(std::min<std::size_t>(wanted, most));
}

}  // namespace swept::detail
