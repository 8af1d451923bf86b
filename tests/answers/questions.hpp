// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>

#include "answer.hpp"
#include "site.hpp"

namespace swept::answers {

/// What a kind of question is asked about.
enum class About : std::uint8_t {
  Scene,      ///< a share of all questions
  SceneOnce,  ///< once in each scene
  RobotOnce,  ///< once for each robot
};

/// Questions of one kind.
struct Kind {
  const char* name;
  double share;  ///< of all questions; those of all kinds are 1 together
  About about;
  bool motions;  ///< its verdicts are of motions
  void (*ask)(const Site& site, Workspace* workspace, Random& random, Answer& answer);
};

std::span<const Kind> kinds();

/// Asks; what is thrown is an answer, too. `workspace`: null for a site without a checker.
Answer ask(const Kind& kind, const Site& site, Workspace* workspace, Random random,
           std::ostream* text = nullptr);

}  // namespace swept::answers
