// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <ios>
#include <span>
#include <sstream>
#include <string>
#include <string_view>

#include "swept/robot_model/body_name.hpp"
#include "swept/robot_model/checker.hpp"

/// What oracle.cpp answers, and the topics that have files of their own.
namespace swept::test {

/// Words and numbers, which are hexadecimal: bit for bit.
class Answer {
 public:
  Answer() { text_ << std::hexfloat; }
  Answer& operator<<(double value) {
    text_ << value << ' ';
    return *this;
  }
  Answer& operator<<(std::string_view word) {
    text_ << word << ' ';
    return *this;
  }
  Answer& operator<<(const Eigen::Vector3d& point) {
    return *this << point.x() << point.y() << point.z();
  }
  Answer& operator<<(const char* word) { return *this << std::string_view(word); }
  Answer& operator<<(const BodyName& name) {
    return *this << std::string_view(name.empty() ? "None" : name.str());
  }
  std::string str() const { return text_.str(); }

 private:
  std::ostringstream text_;
};

/// Schedules of the two halves of the checker's group. False: the question is another.
bool askSchedules(Answer& answer, const std::string& question, const Checker& checker,
                  ConfigurationView q, std::span<const double> more);
/// Likewise, roadmaps.
bool askRoadmaps(Answer& answer, const std::string& question, const Checker& checker,
                 ConfigurationView q, std::span<const double> more);
/// Likewise, shapes around a link.
bool askShapes(Answer& answer, const std::string& question, const Checker& checker,
               std::span<const double> more);

}  // namespace swept::test
