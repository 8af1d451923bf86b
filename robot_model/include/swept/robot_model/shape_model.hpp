// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swept/core/enclosing_shapes.hpp"
#include "swept/core/enclosing_spheres.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/sphere_model.hpp"

/// Models of a robot or a scene that consist of few capsules, boxes or convex hulls, beside those
/// of spheres.
namespace swept {

/// The shapes of one link, or of another body.
struct LinkShapes {
  std::string link;                ///< its name
  std::vector<PosedShape> shapes;  ///< in the link's frame
};

/// Shapes for the links of a robot, or for other bodies.
struct ShapeModel {
  std::vector<LinkShapes> links;  ///< each link once
  /// Null if it has none for the link.
  const LinkShapes* find(std::string_view link) const;
  /// Of all links.
  std::size_t count() const;
};

/// The same spheres as shapes.
ShapeModel shapeModelOf(const SphereModel& model);
/// The shapes as spheres; none if one of them is no sphere.
std::optional<SphereModel> sphereModelOf(const ShapeModel& model);

/// How a model is searched for. Exactly one of `shapes` and `excess` is set.
struct ShapeModelOptions {
  EnclosingKind kind = EnclosingKind::Box;  ///< of all shapes
  /// Of all links together; at least one for each link with collision geometry. They are divided so
  /// that the largest reach of all links (EnclosingShapes::reach) is small.
  std::optional<int> shapes;
  std::optional<double> excess;   ///< m; each link gets as many as this reach needs
  EnclosingShapesOptions search;  ///< for each link
  unsigned threads = 0;           ///< 0: as many as processors. The result does not depend on it
  std::stop_token stop = {};      ///< ends the search soon: SearchStopped
};

/// Shapes for each link with collision geometry, which together contain all of it: proven, rounding
/// included (EnclosingShapes). Throws std::invalid_argument for options out of range, and
/// UsageError if there are fewer shapes than links with geometry.
ShapeModel enclosingShapeModel(const Robot& robot, const ShapeModelOptions& options);
/// Shapes for each of the bodies, likewise. Throws for them as enclosingSphereModel().
ShapeModel enclosingShapeModel(std::span<const NamedBody> bodies, const ShapeModelOptions& options);

/// Judges each link with collision geometry, in the order of the robot. The excess is that of the
/// shapes grown by `outside.upper` if that is above 0 (outsideShapes()).
std::vector<LinkSphereReport> judgeShapeModel(const Robot& robot, const ShapeModel& model,
                                              const OutsideSpheresOptions& options = {},
                                              unsigned threads = 0);
/// Judges each of the bodies, in their order. Throws for them as enclosingSphereModel().
std::vector<LinkSphereReport> judgeShapeModel(std::span<const NamedBody> bodies,
                                              const ShapeModel& model,
                                              const OutsideSpheresOptions& options = {},
                                              unsigned threads = 0);

/// Reads shapes for the robot's links: from the files that readSphereModel() reads, of which
/// `.json` may have what shapeModelJson() writes, or be a file for VAMP's generator, whose `urdf`
/// is read, and `.urdf` any collision geometry that outsideShapes() takes. A cylinder with two
/// spheres of its radius at its ends is read as a capsule. Throws InputError.
ShapeModel readShapeModel(const std::filesystem::path& file, const Robot& robot,
                          const LoadOptions& options = {});

/// A URDF with the meshes that it names.
struct ShapedUrdf {
  std::string text;                                         ///< of the URDF
  std::vector<std::pair<std::string, std::string>> meshes;  ///< file name and text (OBJ)
};

/// The URDF keeps all of `urdfText` but the `<collision>` elements, which become those of the
/// model: a capsule is a cylinder and two spheres; a hull is a mesh, whose name begins with
/// `prefix`. Throws InputError, which calls the text `name`, if it is no URDF, and
/// std::invalid_argument for a shape that is neither sphere, box, cylinder, capsule nor hull.
ShapedUrdf urdfWithShapes(const ShapeModel& model, const std::string& urdfText,
                          const std::string& name, const std::string& prefix);

/// `links`, each with `link`, the figures of its report, and `shapes`: `type` (`sphere`, `box`,
/// `cylinder`, `capsule`, `convex`), `radius`, `length` (of a capsule between its centres), `size`
/// (full), `vertices`, in m, `faces` (three indices of vertices, counterclockwise from outside),
/// and `pose` (x, y, z and a quaternion x, y, z, w) in the link's frame. `reports`: for each link
/// of the model.
std::string shapeModelJson(const ShapeModel& model, const std::string& robot,
                           const std::vector<LinkSphereReport>& reports);

///@{
/// Texts for planners. `xrdfSpheres`: the geometry of an XRDF file (cuMotion), with collision and
/// self_collision that name it; the limits of the joints are not in a URDF, so it has no cspace.
/// `vampConfiguration`: the JSON file for VAMP's generator (cricket) beside `urdf`; `srdf`: empty:
/// none. File names are relative to the folder of the JSON file, or absolute.
std::string xrdfSpheres(const SphereModel& model);
std::string vampConfiguration(const Robot& robot, const std::string& urdf, const std::string& srdf);
///@}

}  // namespace swept
