// SPDX-License-Identifier: BSD-3-Clause
#include "io/made_mesh.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>
#include <utility>

#include "io/point_faces.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

/// The tolerance for corners, along each axis, in the file's unit. Corners that the writing program
/// held equal, or a corner and the edge that it lies on, may be this far apart. Coordinates are off
/// by up to half of the last place that they are rounded to, in single precision or with six
/// decimals, and two of them by twice that. For a mesh that is small in its unit six decimals are
/// few: the tolerance is no more than 1e-4 of its size.
double roundingOf(const MeshFileContent& content) {
  constexpr double kDecimals = 2e-6;
  constexpr double kUsualWidths = 10.0;
  double largest = 0.0;
  for (const Eigen::Vector3d& vertex : content.vertices)
    largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
  return std::max(
      2.0 * largest * std::numeric_limits<float>::epsilon(),
      std::min(kDecimals, kUsualWidths * TriangleMesh::usualCrackWidth(content.vertices)));
}

void addCover(MadeMesh& made, CoverCache& covers) {
  const auto start = std::chrono::steady_clock::now();
  made.cover = covers.coverOf(*made.mesh);
  made.coverSeconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

MadeMesh made(MeshFileContent content, const Eigen::Vector3d& scale, CoverCache* covers) {
  MadeMesh result;
  const double rounding = roundingOf(content);
  for (Eigen::Vector3d& vertex : content.vertices) vertex = vertex.cwiseProduct(scale);
  refuseLonePoints(content.vertices, content.triangles);
  const double crackWidth = std::max(rounding * scale.cwiseAbs().minCoeff(),
                                     TriangleMesh::usualCrackWidth(content.vertices));
  result.mesh =
      TriangleMesh::build(content.vertices, content.triangles, MeshInterior::Solid, crackWidth)
          .withSourceError(content.error * scale.cwiseAbs().maxCoeff())
          .withEnclosingParts();
  result.rounding = rounding * scale.cwiseAbs().maxCoeff();
  result.opening = result.mesh->opening();
  if (covers != nullptr) addCover(result, *covers);
  return result;
}

}  // namespace

MadeMesh unusable(const MeshFileError& error) {
  MadeMesh result;
  result.problem = std::string(" ") + error.what();
  return result;
}

MadeMesh makeMesh(MeshFileContent content, const Eigen::Vector3d& scale,
                  CoverCache* covers) noexcept {
  try {
    return made(std::move(content), scale, covers);
  } catch (const MeshFileError& error) {
    return unusable(error);
  } catch (const std::invalid_argument& error) {
    MadeMesh result;
    result.problem = std::string(": ") + error.what();
    return result;
  } catch (...) {
    MadeMesh result;
    result.failure = std::current_exception();
    return result;
  }
}

}  // namespace swept::detail
