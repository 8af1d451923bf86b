// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/text_output.hpp"
#include "swept/core/sphere_cover.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/visual_model.hpp"

namespace swept {

/// What a page shows of a robot and its world: bodies with the shapes that are checked.
struct PageBody {
  enum class Kind { Link, Attached, World, Drawing };
  struct Part {
    Shape shape;                               ///< scaled as the rules say
    Eigen::Isometry3d body_from_shape;         ///< of World that stands: model_from_shape
    std::shared_ptr<const SphereCover> cover;  ///< of links and attached bodies; null: none
  };
  std::string name;
  Kind kind = Kind::Link;
  int link = -1;  ///< whose frame the body moves with; -1: it stands in the model frame
  const MovingObstacle* moving = nullptr;  ///< of World: how it moves; null: it stands
  std::vector<Part> parts;
  std::optional<Colour> colour;  ///< of a link; none: the page's own
  double padding = 0.0;          ///< m
  double opacity = 1.0;
};

/// Links with collision geometry, attached bodies, bodies of the world, in this order. Those that
/// move point into `world`. A null `checker` means no rules and no attached bodies. Null `visuals`
/// mean no colours.
std::vector<PageBody> pageBodies(const Robot& robot, const World& world, const Checker* checker,
                                 const VisualModel* visuals);

/// The geometries and covers of a page: its `geometries` and `covers`. A shape that several bodies
/// share is stored once.
class PageGeometries {
 public:
  /// `parts` of a body, which name geometries and covers by their index.
  Json partsJson(const PageBody& body);
  Json geometriesJson() const { return geometries_; }
  Json coversJson() const { return covers_; }
  ///@{
  /// Of a geometry that is in the page from then on.
  int indexOf(const Shape& shape);
  int indexOf(const std::shared_ptr<const VisualMesh>& mesh);
  ///@}

 private:
  int coverIndex(const SphereCover& cover);
  Json geometries_ = Json::array();
  Json covers_ = Json::array();
  std::vector<std::pair<const void*, int>> shared_;  ///< meshes, hulls, clouds, covers by address
  ///@{
  /// Keep those addresses from being used anew.
  std::vector<Shape> kept_;
  std::vector<std::shared_ptr<const VisualMesh>> keptMeshes_;
  ///@}
};

}  // namespace swept
