// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "swept/core/enclosing_spheres.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

/// Models of a robot or a scene that consist of spheres, as fast planners check them: made with
/// proof, read and judged.
namespace swept {

/// A rigid body that a model contains: a link of a robot, a body of a scene, or any other.
struct NamedBody {
  std::string name;                ///< no other body of the model has it
  std::vector<PosedShape> shapes;  ///< in the body's frame; at least one, no plane, no half-space
};

/// The collision geometry of a link, in its frame.
std::vector<PosedShape> bodyOf(const Link& link);
/// The links with collision geometry, in the order of the robot.
std::vector<NamedBody> bodiesOf(const Robot& robot);
/// The bodies with geometry, in the model frame, then the moving obstacles, each in its own frame.
std::vector<NamedBody> bodiesOf(const World& world);

/// The spheres of one link, or of another body.
struct LinkSpheres {
  std::string link;                      ///< its name
  std::vector<EnclosingSphere> spheres;  ///< in the link's frame
};

/// Spheres for the links of a robot, or for other bodies.
struct SphereModel {
  std::vector<LinkSpheres> links;  ///< each link once
  /// Null if it has none for the link.
  const LinkSpheres* find(std::string_view link) const;
  /// Of all links.
  std::size_t count() const;
};

/// How a sphere model is searched for. Exactly one of `spheres` and `excess` is set.
struct SphereModelOptions {
  /// Of all links together; at least one for each link with collision geometry. They are divided so
  /// that the largest reach of all links (EnclosingSpheres::reach) is small.
  std::optional<int> spheres;
  std::optional<double> excess;    ///< m; each link gets as many as this reach needs
  EnclosingSpheresOptions search;  ///< for each link
  unsigned threads = 0;            ///< 0: as many as processors. The result does not depend on it
  std::stop_token stop = {};       ///< ends the search soon: SearchStopped
};

/// Spheres for each link with collision geometry, which together contain all of it: proven,
/// rounding included (EnclosingSpheres). Closed meshes are contained with their inside. Throws
/// std::invalid_argument for options out of range, and UsageError if there are fewer spheres than
/// links with geometry.
SphereModel enclosingSphereModel(const Robot& robot, const SphereModelOptions& options);
/// Spheres for each of the bodies, likewise. Also throws UsageError for a body with a plane or a
/// half-space, which nothing contains, and std::invalid_argument for one without shapes and for two
/// of one name.
SphereModel enclosingSphereModel(std::span<const NamedBody> bodies,
                                 const SphereModelOptions& options);

/// What is to be said about one link of a sphere model, or another body.
struct LinkSphereReport {
  std::string link;         ///< its name
  std::size_t spheres = 0;  ///< how many it has
  OutsideSpheres outside;   ///< what of the link is in no sphere; infinite without spheres
  SphereExcess excess;      ///< of the spheres, grown by `outside.upper` if that is above 0
};

/// Judges each link with collision geometry, in the order of the robot.
std::vector<LinkSphereReport> judgeSphereModel(const Robot& robot, const SphereModel& model,
                                               const OutsideSpheresOptions& options = {},
                                               unsigned threads = 0);
/// Judges each of the bodies, in their order. Throws for them as enclosingSphereModel().
std::vector<LinkSphereReport> judgeSphereModel(std::span<const NamedBody> bodies,
                                               const SphereModel& model,
                                               const OutsideSpheresOptions& options = {},
                                               unsigned threads = 0);

/// Reads spheres for the robot's links from one of these files, by their ending:
///
/// * `.json`: what sphereModelJson writes: `links`, each with `link` and `spheres` of
///   `[x, y, z, radius]`; other keys are ignored. Or a file for VAMP's generator, whose `urdf` is
///   read.
/// * `.yaml`, `.yml`: `collision_spheres` of cuRobo, at the top, or in `robot_cfg` and
///   `kinematics`: per link a list of `center` and `radius`. cuRobo leaves spheres with a negative
///   radius out, and so does this.
/// * `.xrdf`, and YAML with `format: xrdf`: the spheres of the geometry that `collision` (or
///   `world_collision`) names.
/// * `.srdf`: MoveIt's `<link_sphere_approximation>`.
/// * `.urdf`: the collision geometry of a robot with the same links, all spheres.
///
/// Lengths are in m, in the frames of the links. Throws InputError for a file that cannot be used:
/// one of another ending, a link that the robot lacks, and geometry that is no sphere.
SphereModel readSphereModel(const std::filesystem::path& file, const Robot& robot,
                            const LoadOptions& options = {});

///@{
/// The text of a file with the model. Numbers read back to the same, also in single precision.
///
/// The URDF keeps all of `urdfText` but the `<collision>` elements, which become those of the
/// model; VAMP's generator takes it. The SRDF keeps all of `srdfText` but the sphere approximations
/// of links; empty: a new one. Both throw InputError, which calls the text `name`, if it is no such
/// file.
std::string spherizedUrdf(const SphereModel& model, const std::string& urdfText,
                          const std::string& name);
std::string sphereApproximationSrdf(const SphereModel& model, const std::string& robot,
                                    const std::string& srdfText, const std::string& name);
std::string curoboSpheres(const SphereModel& model, const std::string& robot);
/// `reports`: for each link of the model.
std::string sphereModelJson(const SphereModel& model, const std::string& robot,
                            const std::vector<LinkSphereReport>& reports);
///@}

///@{
/// Robots to cover something else: one whose links have their `<visual>` geometry as `<collision>`
/// (throws InputError), and one whose only link, of the file's stem, is a mesh in metres.
std::string urdfWithVisualsAsCollision(const std::string& urdfText, const std::string& name);
std::string urdfOfMesh(const std::filesystem::path& mesh);
///@}

}  // namespace swept
