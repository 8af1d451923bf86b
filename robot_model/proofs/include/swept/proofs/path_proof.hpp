// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/path_certificate.hpp"

/// Proofs of paths in files that others can check: with `swept verify`, or with verifyProof(). Both
/// are the code of robot_model/verify, which shares nothing with what has found the proof.
namespace swept {

/// What came of writing a proof.
struct WrittenProof {
  /// Where no separating planes were found: `segment 3, forearm - shelf`. Then there is no file.
  /// Empty: the file is written.
  std::string missing;

  bool isWritten() const { return missing.empty(); }  ///< there is the file
};

/// Looks for planes that keep all pairs of bodies apart during the motions between `states`, and
/// writes them with the path, the robot and the world, bit for bit, to a `.json` file that needs no
/// other file to be checked. The file appears whole or not at all. `certificate`: what
/// certifyPath() says about the same states, clearances included. `warnings`: lines on what is not
/// checked, which whoever reads the file is told again (LoadOptions::warnOfUnchecked).
///
/// Throws UsageError for a path that is not Free, beside moving obstacles, for names that are not
/// UTF-8, a file that cannot be written or has another ending, and a proof that is larger than
/// files that are read (kMaxTextBytes); std::invalid_argument for a certificate of another number
/// of segments, or without clearances.
WrittenProof writeProof(const std::filesystem::path& file, const Checker& checker,
                        const ConfigurationList& states, const PathCertificate& certificate,
                        const std::vector<std::string>& warnings = {});

/// What came of checking a proof.
struct CheckedProof {
  /// The first place where it does not hold, or what was changed; empty: it holds, and the rest is
  /// of account.
  std::string refusal;
  std::size_t segments = 0;   ///< of the path
  std::size_t pairs = 0;      ///< of bodies that have to keep apart
  std::size_t intervals = 0;  ///< of all pairs and segments
  std::size_t planes = 0;     ///< likewise
  ///@{
  /// m. What every pair keeps more than, and those with the world and of the robot's own bodies;
  /// infinity: there are none.
  double clearance = 0.0, clearanceWorld = 0.0, clearanceSelf = 0.0;
  ///@}
  /// Pairs that may touch and were not looked at (`a - b`), by who says so.
  std::map<std::string, std::vector<std::string>> notChecked;

  bool holds() const { return refusal.empty(); }  ///< what the file says is proven
};

/// Checks the proof of a path file against the robot and the world that are in it: of writeProof(),
/// or of `swept plan --embed` and `swept certify --embed`. Throws InputError for a file that is no
/// path with a proof, or has no robot and world.
CheckedProof verifyProof(const std::filesystem::path& file);

/// The same, and that these are the robot, the world and the rules of `checker`: of any path file
/// with a proof. Throws UsageError beside moving obstacles.
CheckedProof verifyProof(const std::filesystem::path& file, const Checker& checker);

}  // namespace swept
