// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/cloud_file.hpp"

#include <string>

#include "io/point_file.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

std::vector<Eigen::Vector3d> loadPoints(const std::filesystem::path& file,
                                        const LoadOptions& options) {
  return loadSensedPoints(file, options).points;
}

SensedPoints loadSensedPoints(const std::filesystem::path& file, const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return loadSensedPoints(file, options); });
  }
  const std::string ending = detail::lowerEnding(file);
  using Reader = SensedPoints (*)(const detail::PointFile&);
  Reader read = nullptr;
  if (ending == ".pcd") read = detail::readPcd;
  if (ending == ".ply") read = detail::readPly;
  if (ending == ".xyz") read = detail::readXyz;
  if (read == nullptr) {
    throw InputError(file.string(), 0,
                     "unknown ending '" + file.extension().string() +
                         "' of a file of points; allowed are .pcd, .ply and .xyz");
  }
  return read(detail::PointFile(file, options));
}

}  // namespace swept
