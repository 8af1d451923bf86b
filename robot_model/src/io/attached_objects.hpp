// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/scene_frames.hpp"
#include "io/scene_objects.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

namespace swept::detail {

/// Reads a list of moveit_msgs/AttachedCollisionObject, as MoveIt's
/// PlanningScene::processAttachedCollisionObjectMsg does.
class AttachedObjects {
 public:
  /// `frames` knows the robot's links at the state in which the objects are attached, and learns
  /// the objects'. All arguments must outlive this.
  AttachedObjects(const Robot& robot, SceneFrames& frames, SceneObjects& objects)
      : robot_(robot), frames_(frames), objects_(objects) {}

  /// Those with geometry. Throws InputError, as the others do.
  void read(const YamlPlace& list);
  /// Takes those without geometry out of the world: they are there by their ids.
  void takeFrom(World& world);

  const std::vector<AttachedBody>& bodies() const { return bodies_; }
  /// One with geometry: the world can have none of this id.
  bool has(const std::string& id) const;
  /// Pairs of attached bodies of which one has the other among its touch links. Warns of touch
  /// links that nothing is called.
  std::vector<std::pair<std::string, std::string>> touchingBodies() const;

 private:
  struct Touch {
    std::string body;
    YamlPlace name;  ///< of no link
  };
  struct Waiting {
    YamlPlace entry;
    std::string id;
  };
  void readOne(const YamlPlace& unnamed);
  AttachedBody begin(const YamlPlace& entry, const std::string& id);
  void addPart(const YamlPlace& entry, AttachedBody::Part part, AttachedBody& body) const;

  const Robot& robot_;
  SceneFrames& frames_;
  SceneObjects& objects_;
  std::vector<AttachedBody> bodies_;
  std::set<std::string> ids_;  ///< of those that wait, too
  std::vector<Touch> touches_;
  std::vector<Waiting> waiting_;
};

}  // namespace swept::detail
