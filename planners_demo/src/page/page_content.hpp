// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// What a subcommand wants to be seen.
struct PageContent {
  /// How the headline is coloured.
  enum class Tone { Good, Bad, Unsure, Plain };
  struct Motion {
    std::string label;
    std::vector<double> from, to;
    MotionCertificate certificate;
  };
  Tone tone = Tone::Plain;
  std::string headline;
  std::vector<std::pair<std::string, std::string>> facts;  ///< name and value
  std::vector<LabelledState> states;  ///< shown one at a time, where there are no motions
  std::vector<Motion> motions;        ///< played one after the other
};

PageContent::Tone toneOf(Verdict verdict);

/// Computes and writes the page of --html, and says so on stdout unless that is JSON.
void writePage(const Arguments& args, const Robot& robot, const World& world,
               const Checker* checker, const PageContent& content);

/// Everything a page shows, computed: what planners_demo/page/data.js reads. `checker` may be null;
/// then nothing is judged, and there may be states of the robot's first group, but no motions.
Json pageJson(const Arguments& args, const Robot& robot, const World& world, const Checker* checker,
              const PageContent& content);

/// The whole file. Text of `data` cannot end the element it is in, whatever it is.
std::string htmlOf(const Json& data);

}  // namespace swept
