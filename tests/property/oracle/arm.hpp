// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "piece.hpp"

namespace oracle {

struct ArmVariable {
  std::string name;
  double lower, upper;  ///< rad or m
  bool cyclic = false;
};

struct ArmJoint {
  std::string name, type;
  int parent = -1, child = -1;  ///< links; parent -1 is the model frame
  Isometry3d parent_from_joint = Isometry3d::Identity();
  Vector3d axis = Vector3d::UnitX();
  double lower = 0, upper = 0;
  std::string mimics;  ///< joint followed, or empty
  double multiplier = 1, offset = 0;
  int variable = -1;  ///< first of its own, or of the joint followed in the end
};

/// A robot as its files say; trusts its input.
class Arm {
 public:
  Arm(const std::filesystem::path& urdf, const std::filesystem::path& srdf);

  const std::vector<Body>& links() const { return links_; }
  const std::vector<ArmJoint>& joints() const { return joints_; }  ///< parents first
  const std::vector<ArmVariable>& variables() const { return variables_; }
  bool disabled(const std::string& a, const std::string& b) const;
  /// Names of the variables of a group.
  std::set<std::string> groupVariables(const std::string& group) const;
  /// All variables: zero where allowed, else the middle; identity orientations.
  std::vector<double> home() const;

  /// model_from_link for each link.
  void poses(const std::vector<double>& q, std::vector<Isometry3d>& model_from_link) const;
  /// The state at t between two states: shorter way round, shorter arc.
  std::vector<double> between(const std::vector<double>& a, const std::vector<double>& b,
                              double t) const;
  /// Largest change of any joint between two states, mimicking ones included; rad or m.
  double largestChange(const std::vector<double>& a, const std::vector<double>& b) const;
  int link(const std::string& name) const;  ///< throws when there is none

 private:
  void readUrdf(const std::filesystem::path& file);
  void readSrdf(const std::filesystem::path& file);
  void addVariables();
  Isometry3d motion(const ArmJoint& joint, const std::vector<double>& q) const;

  std::vector<Body> links_;
  std::vector<ArmJoint> joints_;
  std::vector<ArmVariable> variables_;
  std::set<std::pair<std::string, std::string>> disabled_;
  std::map<std::string, std::set<std::string>> groups_;  ///< names of joints
};

}  // namespace oracle
