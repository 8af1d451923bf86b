// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/visual_model.hpp"

namespace swept {

/// What is to be seen, and what is said of it.
struct PageContent {
  /// How the headline is coloured.
  enum class Tone { Good, Bad, Unsure, Plain };
  struct Motion {
    std::string label;
    std::vector<double> from, to;
    MotionCertificate certificate;
    int path = 0;  ///< index into `paths`, where there are several
  };
  struct State {
    std::string label;
    std::vector<double> q;
  };
  /// One of several that are shown in turn.
  struct Path {
    std::string label;
    Tone tone = Tone::Plain;
  };
  std::string title;    ///< stands above the headline: `swept check`
  std::string command;  ///< that makes the page again; empty: none does
  Tone tone = Tone::Plain;
  std::string headline;
  std::string reason;  ///< the whole of what the headline says in short; may be empty
  std::vector<std::pair<std::string, std::string>> facts;  ///< name and value
  std::vector<State> states;    ///< shown one at a time, where there are no motions
  std::vector<Motion> motions;  ///< played one after the other
  std::vector<Path> paths;      ///< that the motions are of; empty: of one
  /// Index of the state that the page opens at, with the camera at its contacts. None: at the
  /// first, with the camera at everything.
  std::optional<std::size_t> opensAt;
};

PageContent::Tone toneOf(Verdict verdict);

/// What is said of a state, a motion or a path.
struct Finding {
  Verdict verdict = Verdict::Free;
  bool apart = false;  ///< in Collision: no two bodies touch that are within their margin
};
Finding findingOf(const MotionCertificate& certificate);

/// One in Collision if there is one, that touches before that which does not; else one that is
/// Undecided if there is one; else Free.
Finding worst(const std::vector<Finding>& findings);
/// `3 motions: 1 free, 2 in collision`, of `what` = `motion`.
std::string countsText(const std::string& what, const std::vector<Finding>& findings);

/// Where nothing is checked green would say too much: in the tone, and in the headline.
void sayIfNothingIsChecked(PageContent& content, const Checker& checker);

/// Judges states, to be shown one at a time.
PageContent statesContent(const Checker& checker, std::vector<PageContent::State> states);

/// Everything a page shows, computed: what robot_model/pages/page/data.js reads. `checker` may be
/// null; then nothing is judged, and there may be states of the robot's first group, but no
/// motions.
Json pageJson(const Robot& robot, const World& world, const Checker* checker,
              const PageContent& content, const VisualModel& visuals);

/// The whole file. Text of `data` cannot end the element it is in, whatever it is.
std::string htmlOf(const Json& data);

}  // namespace swept
