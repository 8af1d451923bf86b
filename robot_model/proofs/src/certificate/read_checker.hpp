// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <string>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// CheckerOptions::constraints of a path file: the reverse of constraintsJson(). `robot`: the one
/// that the file is for. Throws verify::Refusal for what is none.
TaskConstraint constraintsOf(const Json& list, const Robot& robot);

/// Makes checkers from path files alone that hold their robot and world (`model`): for pages. A
/// file whose proof holds has all that they need. Shapes that several paths have are made once.
///
/// The robot has one group, that of the path, and no limits of joints outside of it; joints that
/// mimic one of those are joints by themselves. Shapes are made of the vertices in the file. A
/// convex one that the file says to be rounded has that as a padding.
class CheckerReader {
 public:
  /// Throws verify::Refusal for what a file with a proof that holds does not have, and if another
  /// pair would be left out than the file says.
  std::shared_ptr<const Checker> read(const Json& path);

 private:
  struct ReadShape {
    Shape shape;
    std::shared_ptr<const SphereCover> cover;  ///< of a link
    double error = 0.0;                        ///< m
  };
  std::shared_ptr<const Robot> robotOf(const Json& path);
  void addWorld(const Json& model, World& world);
  MovingObstacle obstacleOf(const Json& body);
  void addAttached(const Json& model, CheckerOptions& options);
  ReadShape& shapeOf(const Json& json);

  std::map<std::string, ReadShape> shapes_;  ///< by their JSON, without poses
};

}  // namespace swept
