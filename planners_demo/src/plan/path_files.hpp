// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "certificate/certificate.hpp"
#include "certificate/path_json.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Where a path goes and in which format; made before planning, so that a name that cannot work is
/// refused at once.
class PathFile {
 public:
  /// Throws UsageError for an unknown ending, a folder that is missing or not writable, a name that
  /// is a folder, for a group that the format cannot hold, and for names of the robot that
  /// are not UTF-8, where the format has to be.
  PathFile(const std::string& file, const Robot& robot, const Group& group);

  /// Whether it holds a proof: the format has a place for one.
  bool holdsProof() const;
  /// The file appears whole or not at all. All but the states is for what holds a proof. Throws
  /// UsageError naming file and reason: also for other names that are not UTF-8.
  void write(const Checker& checker, const PathRecord& record, const Certificate& certificate,
             bool embed) const;

 private:
  std::filesystem::path file_;
};

}  // namespace swept
