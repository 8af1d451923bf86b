// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

#include "certificate/certificate.hpp"
#include "output/clearance_text.hpp"
#include "output/text_output.hpp"
#include "swept/core/verdict.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace swept {

/// What a path file says of a segment.
struct SegmentRecord {
  Verdict verdict = Verdict::Undecided;
  double clearance = 0.0;  ///< m, proven lower bound; infinity: no pairs
  Clearances clearances;   ///< likewise
};

/// The entries of a path file besides those of its checker and its proof.
struct PathRecord {
  Json maker = Json::object();  ///< who has made the path: `planner`, `seed`
  std::span<const std::vector<double>> states;
  std::vector<SegmentRecord> segments;
  Json inputs;                        ///< what its checker was made from; null: nobody says
  std::vector<std::string> warnings;  ///< on what is not checked
  /// That the states are the points of, if they are.
  const JointTrajectory* trajectory = nullptr;
  double clock = 0.0;          ///< s, of moving obstacles, at the trajectory's time 0
  Json lines = Json::array();  ///< that a tool follows: see linesJson()
};

/// A path whose segments were certified, as files have it.
struct ProvenPath {
  std::vector<std::vector<double>> states;  ///< two at least: of one state, it twice
  std::vector<SegmentRecord> segments;

  std::vector<double> clearances() const;  ///< m, of the segments
};
/// Throws std::invalid_argument for a certificate of another path, or without clearances.
ProvenPath provenPath(const ConfigurationList& states, const PathCertificate& certificate);

/// The points of a trajectory as a path. Each segment has the clearance of the whole curve. Throws
/// std::invalid_argument for a certificate of another trajectory, or without clearances.
ProvenPath provenPath(const JointTrajectory& trajectory, const TrajectoryCertificate& certificate);

/// The path file that robot_model/verify and readPath() read. `embed`: with the robot and the
/// world. Throws UsageError, beginning with `where`, for names that are not UTF-8.
Json pathJson(const Checker& checker, const PathRecord& record, const Certificate& certificate,
              bool embed, const std::string& where);

/// Its text, in lines that are short enough to read and to compare.
std::string pathLines(const Json& path);
/// The same. Throws UsageError, beginning with `where`, for a file larger than the reader accepts.
std::string pathText(const Json& path, const std::string& where);

}  // namespace swept
