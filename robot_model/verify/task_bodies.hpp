// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "model.hpp"

namespace swept::verify {

/// The bodies of two phases that follow each other.
struct BodiesOfPhases {
  const Json& before;       ///< `bodies` of the first one's model
  const Json& now;          ///< likewise, of the second one's
  std::string phaseBefore;  ///< `phase 3`
  /// model_from_link, where the two join.
  std::function<Eigen::Isometry3d(const std::string& link)> poseOf;
};

/// What a phase of a task file says has changed.
class BodyChanges {
 public:
  /// `list`: objects with `body` and `change` (`attached`, `placed` or `sensed`). `where`: the
  /// phase. Throws Refusal.
  BodyChanges(const Json& list, const std::string& where);

  /// Of a first phase. Throws Refusal.
  void requireNone() const;
  /// Checks that these changes, and no others, have happened. Returns them in words. Throws
  /// Refusal.
  std::vector<std::string> check(const BodiesOfPhases& bodies) const;

 private:
  /// Empty: none was stated.
  std::string statedOf(const std::string& body) const;
  /// Of a body that is not as it was. Null: it was not there, or is not there any more.
  void checkChange(const std::string& name, const Json& before, const Json& now,
                   const BodiesOfPhases& bodies) const;
  void requireSamePlace(const std::string& name, const Json& before, const Json& now,
                        const BodiesOfPhases& bodies) const;
  [[noreturn]] void refuse(const std::string& body, const std::string& text) const;

  std::string where_;
  std::vector<std::string> order_;
  std::map<std::string, std::string> stated_;
};

}  // namespace swept::verify
