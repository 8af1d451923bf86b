// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_store.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <system_error>

#include "io/mesh_file.hpp"
#include "io/numbers.hpp"
#include "io/package_paths.hpp"
#include "io/point_faces.hpp"
#include "io/regular_file.hpp"

namespace swept::detail {

namespace fs = std::filesystem;

namespace {

std::string nameOf(const MeshReference& mesh) {
  return "mesh '" + mesh.reference + "' of " + mesh.owner;
}

/// The same for all names of a file; its own where the system tells none, as of an open file that
/// is in no folder any more.
fs::path oneName(const fs::path& file) {
  std::error_code error;
  const fs::path whole = fs::canonical(file, error);
  return error ? file : whole;
}

/// In the file's unit: how far apart the corners of triangles may be, along each axis, that are one
/// corner, or a corner on an edge, to the program that wrote them. Coordinates are off by up to
/// half of what they are rounded to, single precision or six decimals, and two of them by twice
/// that. Of a mesh that is small in its unit six decimals are few: no more than 1e-4 of its size.
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

void warnOfCracks(const TriangleMesh& mesh, double rounding, const std::string& name, int line,
                  const InputSource& source) {
  // Both borders of a crack may be off, along three axes.
  if (mesh.report().largestCrack <= 2.0 * rounding) return;
  source.warn(line, "mesh '" + name + "' has cracks of up to " +
                        formatNumber(mesh.report().largestCrack) +
                        " m, more than rounding explains: they are filled");
}

/// Assimp has coordinates in single precision; far from 0 that takes them where they are not.
void requirePrecise(const MeshFileContent& content, const Eigen::Vector3d& scale) {
  constexpr double kMostLost = 1e-3;  // m
  const double lost = content.loss * scale.cwiseAbs().maxCoeff();
  if (lost <= kMostLost) return;
  throw MeshFileError("has coordinates that single precision moves by " + formatNumber(lost) +
                      " m; at most " + formatNumber(kMostLost) + " m are allowed");
}

}  // namespace

MeshPlace placeOfMesh(const std::string& reference, const InputSource& source) {
  const auto candidates = candidatePaths(reference, source.folder(), source.options());
  if (candidates.empty()) return {{}, ": the scheme must be package://, model:// or file://"};
  std::string tried;
  for (const fs::path& candidate : candidates) {
    const std::string reason = whyUnreadable(candidate);
    if (reason.empty()) return {candidate, {}};
    tried += (tried.empty() ? "" : ", ") + candidate.string();
    if (reason != kNoSuchFile) tried += " (" + reason + ")";
  }
  const std::string package = packageOf(reference);
  const std::string hint = package.empty() ? ""
                                           : "; --package " + package +
                                                 "=DIR (LoadOptions::packages) tells where package "
                                                 "'" +
                                                 package + "' is";
  return {{}, " not found; looked for " + tried + hint};
}

void MeshStore::requireFound(const std::vector<MeshReference>& references) const {
  constexpr std::size_t kMost = 10;
  std::map<std::string, std::string> problems;  // of each reference, empty: none
  std::vector<const MeshReference*> missing;
  for (const MeshReference& mesh : references) {
    if (problems.contains(mesh.reference)) continue;
    const std::string problem = placeOfMesh(mesh.reference, source_).problem;
    problems.emplace(mesh.reference, problem);
    if (!problem.empty()) missing.push_back(&mesh);
  }
  if (missing.empty()) return;
  std::string text = nameOf(*missing.front()) + problems[missing.front()->reference];
  for (std::size_t i = 1; i < std::min(missing.size(), kMost); ++i)
    text += (i == 1 ? "; missing as well: '" : ", '") + missing[i]->reference + "' (line " +
            std::to_string(missing[i]->line) + ")";
  if (missing.size() > kMost) text += " and " + std::to_string(missing.size() - kMost) + " more";
  source_.fail(missing.front()->line, text);
}

TriangleMesh MeshStore::mesh(const std::string& reference, const Eigen::Vector3d& scale, int line,
                             const std::string& owner) {
  const std::string name = nameOf({reference, line, owner});
  const auto [file, problem] = placeOfMesh(reference, source_);
  if (!problem.empty()) source_.fail(line, name + problem);
  const Key key{oneName(file), {scale.x(), scale.y(), scale.z()}};
  if (const auto known = meshes_.find(key); known != meshes_.end()) return known->second;
  try {
    MeshFileContent content = files_.read(file);
    requirePrecise(content, scale);
    const double rounding = roundingOf(content);
    for (Eigen::Vector3d& vertex : content.vertices) vertex = vertex.cwiseProduct(scale);
    refuseLonePoints(content.vertices, content.triangles);
    const double crackWidth = std::max(rounding * scale.cwiseAbs().minCoeff(),
                                       TriangleMesh::usualCrackWidth(content.vertices));
    TriangleMesh mesh =
        TriangleMesh::build(content.vertices, content.triangles, MeshInterior::Solid, crackWidth);
    warnOfCracks(mesh, rounding * scale.cwiseAbs().maxCoeff(), reference, line, source_);
    warnIfOpen(mesh, reference, line, source_);
    meshes_.emplace(key, mesh);
    return mesh;
  } catch (const MeshFileError& error) {
    source_.fail(line, name + " " + error.what());
  } catch (const std::invalid_argument& error) {
    source_.fail(line, name + ": " + error.what());
  }
}

void warnIfOpen(const TriangleMesh& mesh, const std::string& name, int line,
                const InputSource& source) {
  const int open = mesh.report().openComponents;
  if (open == 0) return;
  const std::string components = std::to_string(open) + " open component" + (open == 1 ? "" : "s");
  const double opening = mesh.opening();
  const std::string width =
      std::isfinite(opening) ? ", for openings of up to " + formatNumber(opening) + " m" : "";
  if (mesh.report().closedComponents > 0)
    source.warn(line, "mesh '" + name + "' has " + components + " without an inside" + width);
  else
    source.warn(line, "mesh '" + name + "' is an open surface (" + components +
                          "): its interior is not solid" + width);
}

}  // namespace swept::detail
