// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "swept/robot_model/input.hpp"

namespace swept {

/// What a sensor saw, and where it was.
struct SensedPoints {
  std::vector<Eigen::Vector3d> points;               ///< m, the file's frame, in its order
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();  ///< m, the same frame; 0: the file says none
};

/// Reads a sensed cloud. The ending, in upper or lower case, says what the file is:
///
/// * `.pcd`: PCD 0.5 to 0.7, ascii, binary or binary_compressed. The sensor is where VIEWPOINT is.
/// * `.ply`: the x, y and z of the element `vertex`, ascii or binary in either byte order. The
///   sensor is at `view_px`, `view_py` and `view_pz` of the element `camera`, as the Point Cloud
///   Library writes it.
/// * `.xyz`: a line per point, of numbers separated by blanks, or by commas, or by semicolons;
///   what follows the third, empty lines and lines that begin with `#` are ignored.
///
/// Points are where their numbers say: neither a VIEWPOINT nor a camera moves them, and one that is
/// not at the origin gives a remark. Points with a coordinate that is not finite (what a depth
/// camera writes where it saw nothing) are left out, with one remark for the file. Throws
/// InputError: for a file that is not exactly what its header says, without a finite point, of more
/// than 2 GiB or of more than 50 million points. Memory is bounded by the file's size, whatever its
/// header says.
SensedPoints loadSensedPoints(const std::filesystem::path& file, const LoadOptions& options = {});

/// The points of loadSensedPoints() alone. Space that they hide from a sensor (occludedBalls())
/// needs that, too.
std::vector<Eigen::Vector3d> loadPoints(const std::filesystem::path& file,
                                        const LoadOptions& options = {});

/// What a map of OctoMap calls occupied.
struct OccupancyMap {
  /// An occupied leaf of the map's tree.
  struct Cube {
    Eigen::Vector3d center;  ///< m, the map's frame
    double side;             ///< m, along its axes: resolution times a power of 2
  };
  double resolution;           ///< m, side of the smallest cubes
  std::vector<Cube> occupied;  ///< they do not overlap; none in a map that is empty
};

/// Reads the files that OctoMap writes, of an `OcTree` or a `ColorOcTree`: `.bt`, which says of
/// each cube whether it is occupied, and `.ot`, where those with log odds of at least 0 (OctoMap's
/// default: a probability of at least 0.5) are. Unknown space is not occupied. A `.bt` of a root
/// alone does not say what that is; it is occupied, as for OctoMap. Throws InputError for another
/// kind of tree, a file that is not exactly what its header says, one of more than 2 GiB, and more
/// than 50 million occupied cubes.
OccupancyMap loadOctomap(const std::filesystem::path& file, const LoadOptions& options = {});

}  // namespace swept
