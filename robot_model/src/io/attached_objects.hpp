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
  /// `frames` knows the robot's links at the state in which the objects are attached; the objects'
  /// frames are added to it. All arguments must outlive this.
  AttachedObjects(const Robot& robot, SceneFrames& frames, SceneObjects& objects)
      : robot_(robot), frames_(frames), objects_(objects) {}

  /// Reads the list. Objects with geometry become bodies; the others wait for takeFrom(). Throws
  /// InputError, as the other functions do.
  void read(const YamlPlace& list);
  /// Moves the geometry of the waiting objects from `world`, where their ids name it, to bodies().
  void takeFrom(World& world);

  const std::vector<AttachedBody>& bodies() const { return bodies_; }
  /// Whether bodies() has this id; then the world can have none of this id.
  bool has(const std::string& id) const;
  /// Pairs of attached bodies of which one has the other among its touch links. Warns of touch
  /// links that name nothing.
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
