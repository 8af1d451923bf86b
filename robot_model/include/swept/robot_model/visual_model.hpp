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

/// What a robot looks like. No check knows of it: it is for pictures alone.
namespace swept {

/// sRGB, as files have it, and how opaque it is: each from 0 to 1.
struct Colour {
  double red = 0.0;    ///< 0 to 1
  double green = 0.0;  ///< 0 to 1
  double blue = 0.0;   ///< 0 to 1
  double alpha = 1.0;  ///< 0: is not seen
  /// Exactly the same numbers.
  bool operator==(const Colour&) const = default;
};

/// Triangles to look at; what they enclose, if anything, is not known.
struct VisualMesh {
  std::vector<Eigen::Vector3f> vertices;   ///< m, scaled as the URDF says
  std::vector<Eigen::Vector3i> triangles;  ///< indices into `vertices`
  std::size_t trianglesOfFile = 0;         ///< more than `triangles` has: it was made coarser
};

/// A piece of what a link looks like, of one colour.
struct Visual {
  /// In its own frame, m.
  std::variant<Sphere, Box, Cylinder, Capsule, std::shared_ptr<const VisualMesh>> shape;
  /// Pose of the shape in the link's frame.
  Eigen::Isometry3d link_from_shape = Eigen::Isometry3d::Identity();
  std::optional<Colour> colour;  ///< of the mesh file, else of the URDF's material; none: neither
  std::string source;            ///< mesh file as the URDF has it, or the primitive's name
};

/// What one link looks like.
struct LinkVisuals {
  std::string link;             ///< its name
  std::vector<Visual> visuals;  ///< in the order of the file
  /// The colour that the URDF's materials give all `<visual>`s of the link, left out or not; none
  /// where they differ or one has none.
  std::optional<Colour> colour;
  std::size_t leftOut = 0;  ///< `<visual>`s that are missing from `visuals`
};

/// How much is kept of meshes.
struct VisualLimits {
  /// In all meshes together. Meshes with more are made coarser, the largest first: corners in one
  /// cell of a grid become one.
  std::size_t triangles = 150'000;
};

/// The `<visual>` elements of a URDF and their materials, which Robot does not read.
///
/// Nothing about a `<visual>` costs the whole: an element, a mesh or a material that cannot be used
/// is left out, with one warning for all of a kind. Meshes are read as those of `<collision>` are,
/// within the same limits for a file. A COLLADA file's own colours count
/// before those of the URDF; pictures on surfaces are not read.
struct VisualModel {
  std::vector<LinkVisuals> links;   ///< those with a `<visual>`, in the order of the file
  std::size_t triangles = 0;        ///< of all meshes, each once
  std::size_t trianglesOfFile = 0;  ///< the same, before any was made coarser
  std::size_t leftOut = 0;          ///< `<visual>`s of all links

  /// Null: the link has no `<visual>`.
  const LinkVisuals* find(std::string_view link) const;

  /// Reads the visuals of a URDF. Throws InputError for a file that cannot be read, or is no XML
  /// with the root `<robot>`.
  static VisualModel load(const std::filesystem::path& urdf, const LoadOptions& options = {},
                          const VisualLimits& limits = {});
  /// The same from text; `urdfName` is what messages call it, and relative meshes are looked up
  /// beside it.
  static VisualModel parse(const std::string& urdfText, const std::string& urdfName,
                           const LoadOptions& options = {}, const VisualLimits& limits = {});
};

}  // namespace swept
