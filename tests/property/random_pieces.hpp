// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "../core/split_mix.hpp"
#include "swept/core/shapes.hpp"

/// A shape on a body, and the words that a URDF has for it (empty: it has none).
struct RandomPiece {
  swept::Shape shape;
  Eigen::Isometry3d body_from_shape = Eigen::Isometry3d::Identity();
  std::string urdf = {};
};

/// Shapes of some centimetres. Meshes of links are files in a folder.
class RandomPieces {
 public:
  RandomPieces(swept::test::SplitMix& random, std::filesystem::path folder)
      : random_(random), folder_(std::move(folder)) {}

  /// Ball, box, cylinder, capsule or mesh.
  RandomPiece ofLink();
  /// These, and a hull or a cone.
  RandomPiece bounded();
  /// These, and a cloud.
  RandomPiece ofWorld();

  Eigen::Isometry3d turned(const Eigen::Vector3d& place);
  /// m. Anywhere between two distances from the origin.
  Eigen::Vector3d away(double least, double most);

 private:
  double length() { return random_.uniform(0.01, 0.15); }
  std::vector<Eigen::Vector3d> corners();
  RandomPiece mesh();

  swept::test::SplitMix& random_;
  std::filesystem::path folder_;
  int files_ = 0;
};

/// As a URDF has it, to the last bit.
std::string urdfText(const Eigen::Vector3d& v);
/// `<origin .../>`; the pose becomes what its angles stand for.
std::string urdfOrigin(const Eigen::Vector3d& place, const Eigen::Vector3d& rpy);
Eigen::Matrix3d turnOf(const Eigen::Vector3d& rpy);
