// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <stdexcept>
#include <string>

#include "io/input_source.hpp"
#include "io/mesh_store.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/mesh_file.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

void requireFactors(const Eigen::Vector3d& scale) {
  if (scale.allFinite() && scale.cwiseAbs().minCoeff() > 0.0) return;
  std::string text;
  for (const double factor : scale)
    text += (text.empty() ? "" : ", ") + detail::formatNumber(factor);
  throw std::invalid_argument("loadMesh: scale " + text + " must be finite factors other than 0");
}

/// Messages about a file that others refer to name both; here the file itself is the input.
InputError aboutItself(const InputError& error, const std::string& name) {
  const std::string& message = error.message();
  if (!message.starts_with(name)) return error;
  return {error.file(), error.line(), "mesh" + message.substr(name.size())};
}

}  // namespace

TriangleMesh loadMesh(const std::filesystem::path& file, double scale, const LoadOptions& options) {
  return loadMesh(file, Eigen::Vector3d(scale, scale, scale), options);
}

TriangleMesh loadMesh(const std::filesystem::path& file, const Eigen::Vector3d& scale,
                      const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return loadMesh(file, scale, options); });
  }
  requireFactors(scale);
  const detail::InputSource source(file.string(), options);
  const std::string reference = file.filename().string(), owner = "the program";
  try {
    detail::MeshStore store(source);
    return *store.get({.reference = reference, .line = 0, .owner = owner, .scale = scale}).mesh;
  } catch (const InputError& error) {
    throw aboutItself(error, "mesh '" + reference + "' of " + owner);
  }
}

}  // namespace swept
