// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "swept/core/shapes.hpp"
#include "swept/robot_model/input.hpp"

/// What a robot looks like. Only pictures use it; no check does.
namespace swept {

/// sRGB colour as in files, and opacity; each from 0 to 1.
struct Colour {
  double red = 0.0;    ///< 0 to 1
  double green = 0.0;  ///< 0 to 1
  double blue = 0.0;   ///< 0 to 1
  double alpha = 1.0;  ///< opacity; 0: invisible
  /// Exactly the same numbers.
  bool operator==(const Colour&) const = default;
};

/// Triangles for display only; they have no inside.
struct VisualMesh {
  std::vector<Eigen::Vector3f> vertices;   ///< m, scaled as the URDF says
  std::vector<Eigen::Vector3i> triangles;  ///< indices into `vertices`
  std::size_t trianglesOfFile = 0;         ///< if more than in `triangles`, the mesh was simplified
};

/// A piece of a link's visual geometry, of one colour.
struct Visual {
  /// In its own frame, m.
  std::variant<Sphere, Box, Cylinder, Capsule, std::shared_ptr<const VisualMesh>> shape;
  /// Pose of the shape in the link's frame.
  Eigen::Isometry3d link_from_shape = Eigen::Isometry3d::Identity();
  std::optional<Colour> colour;  ///< of the mesh file, else of the URDF's material; or none
  std::string source;            ///< mesh file as in the URDF, or the primitive's name
};

/// The visual geometry of one link.
struct LinkVisuals {
  std::string link;             ///< its name
  std::vector<Visual> visuals;  ///< in the order of the file
  /// The colour that the URDF's materials give all `<visual>`s of the link, left out or not; none
  /// if they differ or one has none.
  std::optional<Colour> colour;
  std::size_t leftOut = 0;  ///< number of `<visual>`s that are missing in `visuals`
};

/// How much of the meshes is kept.
struct VisualLimits {
  /// Triangles in all meshes together. If there are more, meshes are simplified, the largest first:
  /// corners in one cell of a grid become one.
  std::size_t triangles = 150'000;
};

/// The `<visual>` elements of a URDF and their materials, which Robot does not read.
///
/// A `<visual>` never makes the whole fail: an element, a mesh or a material that cannot be used is
/// left out, with one warning per kind. Meshes are read like those of `<collision>`, within the
/// same limits for a file. A COLLADA file's own colours win over those of the URDF; textures are
/// not read.
struct VisualModel {
  std::vector<LinkVisuals> links;   ///< those with a `<visual>`, in the order of the file
  std::size_t triangles = 0;        ///< of all meshes, each counted once
  std::size_t trianglesOfFile = 0;  ///< the same, before any was simplified
  std::size_t leftOut = 0;          ///< number of missing `<visual>`s of all links

  /// The visuals of a link. Null: it has no `<visual>`.
  const LinkVisuals* find(std::string_view link) const;

  /// Reads the visuals of a URDF. Throws InputError for a file that cannot be read, or is no XML
  /// with the root `<robot>`.
  static VisualModel load(const std::filesystem::path& urdf, const LoadOptions& options = {},
                          const VisualLimits& limits = {});
  /// The same from text. Messages call the text `urdfName`, and relative meshes are searched beside
  /// it.
  static VisualModel parse(const std::string& urdfText, const std::string& urdfName,
                           const LoadOptions& options = {}, const VisualLimits& limits = {});
};

}  // namespace swept
