// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace swept {

/// A file, or a user's value, that cannot be used. what() is `file:line: error: message`; the
/// message has the element, the value seen and what is allowed. A word of more than 512 bytes, and
/// a message of more than 4000, lose their middle.
class InputError : public std::runtime_error {
 public:
  /// line 0: the message concerns the whole file, and only the file is named.
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
  /// Searched first for `package://NAME/...`. Then: the folder whose `package.xml` has the name
  /// NAME, among those that contain the file; a folder NAME beside the file or beside one of its
  /// parent folders; the same below ROS_PACKAGE_PATH; and `share/NAME` below AMENT_PREFIX_PATH.
  std::vector<PackageFolder> packages;
  /// A name of the robot's model frame in files, besides `world` and the empty name:
  /// Robot::modelFrame(). A frame that neither this nor the file itself defines is refused.
  std::string modelFrame;
  /// Receives one line per remark (`file:line: warning: ...`, no longer than an InputError's): open
  /// meshes, entries of an SRDF that name links the robot lacks, and so on. Without it nothing is
  /// printed.
  std::function<void(const std::string&)> warn;
  /// Report every remark. By default, of many remarks of one kind only the first go to `warn`, with
  /// their number.
  bool everyWarning = false;
  /// Receives, instead of `warn`, the remarks that an answer covers less than it seems: a link with
  /// visual but without collision geometry, a scene without a body. If it is empty, `warn` receives
  /// them.
  std::function<void(const std::string&)> warnOfUnchecked = {};
  /// Receives, while a robot is loaded, how many of its different meshes are ready and how many
  /// there are; many triangles take seconds. It is called on any thread, never on two at a time,
  /// and must not throw.
  std::function<void(std::size_t done, std::size_t total)> progress = {};
  /// Folder that keeps the balls around a robot's meshes, which take most of the loading time, for
  /// the next time (README, "The cache"); empty: nothing is kept. A folder that cannot be used
  /// gives a remark to `warn`.
  std::filesystem::path cache = {};
  /// Whether assimp, which reads meshes in glTF (`.gltf`, `.glb`), runs in a child process with
  /// bounds on time and memory, since damaged or hostile files can break it. The process is made
  /// with fork(), once for all meshes of a robot or a scene, and only if one of them is glTF. It
  /// runs none of the host's code, and the host's other threads do not affect it. But it is a copy
  /// of the host, made while these run: handlers of pthread_atfork() are called, and memory that is
  /// written meanwhile is copied.
  ///
  /// False: no process is made. Assimp then reads in this process, without bounds: a file that
  /// makes it crash ends the program, and one that makes it hang blocks it. swept itself reads all
  /// other formats, in this process in either case.
  bool childProcess = true;
};

}  // namespace swept
