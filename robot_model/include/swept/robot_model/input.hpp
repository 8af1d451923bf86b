// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace swept {

/// A file, or a user's value, that cannot be used. what() is `file:line: error: message`, which has
/// the element, the value seen and what is allowed. The middle is left out of a word of more than
/// 512 bytes, and of a message of more than 4000.
class InputError : public std::runtime_error {
 public:
  /// line 0: the file has no lines that matter, and is named alone.
  InputError(const std::string& file, int line, const std::string& message);
  ///@{
  /// The parts of what(). `line` counts from 1; 0: the file as a whole.
  const std::string& file() const { return file_; }
  int line() const { return line_; }
  const std::string& message() const { return message_; }
  ///@}

 private:
  std::string file_;
  int line_;
  std::string message_;
};

/// Maps the start of a `package://` path to a folder: name `a` or `a/b`. The longest match wins.
struct PackageFolder {
  std::string name;              ///< without `package://`
  std::filesystem::path folder;  ///< where its files are
};

/// How files are read.
struct LoadOptions {
  /// Searched first for `package://NAME/...`. Then come: the folder whose `package.xml` names it
  /// NAME, of those that the file is in; a folder NAME beside the file or beside one of its parent
  /// folders; the same below ROS_PACKAGE_PATH; and `share/NAME` below AMENT_PREFIX_PATH.
  std::vector<PackageFolder> packages;
  /// What a file may call the robot's model frame, besides `world` and no name:
  /// Robot::modelFrame(). A frame that neither this nor the file itself places is refused.
  std::string modelFrame;
  /// Receives one line per remark (`file:line: warning: ...`, no longer than an InputError's): open
  /// meshes, entries of an SRDF that name links the robot does not have, and the like. Nothing is
  /// printed without it.
  std::function<void(const std::string&)> warn;
  /// Each remark of its own, where a robot has many of one kind. Else the first of them go to
  /// `warn`, with how many there are.
  bool everyWarning = false;
  /// Receives, instead of `warn`, the remarks without which an answer would be taken for more than
  /// it is: a link that is shown and has no collision geometry, a scene without a body. `warn`
  /// receives them where this is empty.
  std::function<void(const std::string&)> warnOfUnchecked = {};
  /// Is told, as a robot is loaded, how many of its different meshes are ready for use and how many
  /// there are: up to seconds go by where there are many triangles. Called on any thread, never on
  /// two at a time; it must not throw.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
  /// Folder that keeps the balls around a robot's meshes, which take most of the time of loading
  /// it, for the next time (README, "The cache"); empty: nothing is kept. One that cannot be used
  /// is a remark to `warn`.
  std::filesystem::path cache = {};
  /// Meshes in glTF (`.gltf`, `.glb`) are read by assimp, which is not proof against damaged or
  /// hostile files: in a child process, with bounds on time and memory. That process is made with
  /// fork(), once for all meshes of a robot or a scene, and only if one of them is glTF; it runs
  /// nothing of the host's, and what the host's other threads do meanwhile does not matter to it.
  /// But it is a copy of the host, made while these run: handlers of pthread_atfork() are called,
  /// and memory that is written meanwhile is copied.
  ///
  /// False: no process is made. Assimp reads in this one then, without bounds: a file that makes it
  /// crash ends the program, one that makes it hang is waited for. All other formats are read by
  /// swept itself, here, whatever this says.
  bool childProcess = true;
};

}  // namespace swept
