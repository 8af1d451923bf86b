// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "swept/robot_model/input.hpp"

namespace swept {

/// Points that a sensor saw, and the position of the sensor.
struct SensedPoints {
  std::vector<Eigen::Vector3d> points;               ///< m, the file's frame, in its order
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< m, the same frame; 0 if the file has none
};

/// Reads a sensed cloud. The extension, in upper or lower case, gives the format:
///
/// * `.pcd`: PCD 0.5 to 0.7, ascii, binary or binary_compressed. VIEWPOINT is the sensor's
/// position.
/// * `.ply`: the x, y and z of the element `vertex`, ascii or binary in either byte order. The
/// sensor is at `view_px`, `view_py` and `view_pz` of the element `camera`, as the Point Cloud
/// Library writes it.
/// * `.xyz`: a line per point, with numbers separated by blanks, commas or semicolons. Values after
/// the third, empty lines and lines that begin with `#` are ignored.
///
/// Points are used as written: neither a VIEWPOINT nor a camera moves them, and one that is not at
/// the origin gives a remark. Points with a non-finite coordinate (which a depth camera writes
/// where it saw nothing) are left out, with one remark for the file. Throws InputError for a file
/// that does not match its header, has no finite point, more than 2 GiB or more than 50 million
/// points. The size of the file bounds the memory, whatever its header says.
SensedPoints loadSensedPoints(const std::filesystem::path& file, const LoadOptions& options = {});

/// The points of loadSensedPoints() alone. To find the space that they hide from a sensor
/// (occludedBalls()), use loadSensedPoints().
std::vector<Eigen::Vector3d> loadPoints(const std::filesystem::path& file,
                                        const LoadOptions& options = {});

/// The occupied space of an OctoMap.
struct OccupancyMap {
  /// An occupied leaf of the map's tree.
  struct Cube {
    Eigen::Vector3d center;  ///< m, the map's frame
    double side;             ///< m, along its axes: resolution times a power of 2
  };
  double resolution;           ///< m, side of the smallest cubes
  std::vector<Cube> occupied;  ///< they do not overlap; empty for an empty map
};

/// Reads the files that OctoMap writes, of an `OcTree` or a `ColorOcTree`: `.bt`, which says for
/// each cube whether it is occupied, and `.ot`, where cubes with log odds of at least 0 are
/// occupied (OctoMap's default: a probability of at least 0.5). Unknown space is not occupied. If a
/// `.bt` has only a root, it is occupied, as in OctoMap. Throws InputError for another kind of
/// tree, a file that does not match its header, one of more than 2 GiB, and more than 50 million
/// occupied cubes.
OccupancyMap loadOctomap(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace swept
