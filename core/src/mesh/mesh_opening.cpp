// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "geometry/point_text.hpp"
#include "geometry/weld.hpp"
#include "mesh/mesh_components.hpp"
#include "mesh/mesh_cracks.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {
namespace {

/// m. The longest side of the box around points.
double longestSide(std::span<const Eigen::Vector3d> points) {
  Eigen::Array3d lower = Eigen::Array3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Array3d upper = -lower;
  for (const Eigen::Vector3d& point : points) {
    lower = lower.min(point.array());
    upper = upper.max(point.array());
  }
  // Also for boxes that span more than half of the range of doubles.
  return points.empty() ? 0.0 : 2.0 * (0.5 * upper - 0.5 * lower).maxCoeff();
}

}  // namespace

double TriangleMesh::usualCrackWidth(std::span<const Eigen::Vector3d> vertices) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([vertices] { return usualCrackWidth(vertices); });
  }
  // A coordinate of six digits is off by up to 5e-6 of itself, and two copies of it differ by twice
  // that.
  constexpr double kOfSide = 1e-5;
  constexpr double kTwoSteps = 2.0 * std::numeric_limits<float>::epsilon();
  double largest = 0.0;
  for (const Eigen::Vector3d& vertex : vertices) {
    if (!vertex.allFinite()) {
      throw std::invalid_argument("mesh vertex is " + detail::pointText(vertex) +
                                  "; allowed: finite coordinates");
    }
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
  }
  const double width = std::max(kOfSide * longestSide(vertices), kTwoSteps * largest);
  return std::min(width, std::numeric_limits<double>::max());
}

double TriangleMesh::opening() const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return opening(); });
  }
  if (isClosed()) return 0.0;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<Triangle> withArea;
  for (const Triangle& triangle : triangles())
    if (detail::hasDistinctCorners(triangle)) withArea.push_back(triangle);
  // Nothing closes a line.
  if (withArea.size() < triangles().size()) return kInfinity;
  const detail::OpenParts parts(vertices(), detail::ComponentFinder(withArea).result());
  const double most = 0.1 * longestSide(vertices());
  int halved = 0;
  if (!(most > 0.0) || !parts.areClosedBy(most)) return kInfinity;
  // Widths are `most`, halved repeatedly. The last one that closes everything is between these two.
  int tooOften = 40;
  while (tooOften - halved > 1) {
    const int middle = (halved + tooOften) / 2;
    (parts.areClosedBy(std::ldexp(most, -middle)) ? halved : tooOften) = middle;
  }
  return std::ldexp(most, -halved);
}

}  // namespace swept
