// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/visual_model.hpp"

namespace swept {

/// What a page shows and says.
struct PageContent {
  /// How the headline is coloured.
  enum class Tone { Good, Bad, Unsure, Plain };
  /// Configurations are those that the checker takes: beside moving obstacles with their time.
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
  /// One of several paths that are shown in turn.
  struct Path {
    std::string label;
    Tone tone = Tone::Plain;
  };
  /// A curve that is played in real time.
  struct Trajectory {
    std::string label;
    PiecewisePolynomial curve;
    TrajectoryQuery query;
    TrajectoryCertificate certificate;
    std::vector<std::vector<double>> polyline;  ///< configurations that are shown beside it
  };
  /// What else is drawn with a link: it is not checked, and no number is about it.
  struct Drawing {
    std::string name;                                         ///< in the list of bodies
    int link = 0;                                             ///< whose frame it moves with
    std::vector<std::pair<Shape, Eigen::Isometry3d>> shapes;  ///< and link_from_shape
    Colour colour;
    double opacity = 1.0;
  };
  std::string title;    ///< stands above the headline: `swept check`
  std::string command;  ///< that makes the page again; empty: none does
  Tone tone = Tone::Plain;
  std::string headline;
  std::string reason;  ///< the whole of what the headline says in short; may be empty
  std::vector<std::pair<std::string, std::string>> facts;  ///< name and value
  std::vector<Drawing> drawings;
  std::vector<State> states;    ///< shown one at a time, where there are no motions
  std::vector<Motion> motions;  ///< played one after the other
  std::vector<Path> paths;      ///< that the motions are of; empty: of one
  /// Shown in turn, where there are no motions; `paths` has an entry for each.
  std::vector<Trajectory> trajectories;
  /// Index of the state that the page opens at, with the camera at its contacts. None: at the
  /// first, with the camera at everything.
  std::optional<std::size_t> opensAt;
};

PageContent::Tone toneOf(Verdict verdict);
/// `good`, `bad`, `unsure` or `plain`.
std::string_view toString(PageContent::Tone tone);

/// The verdict on a state, a motion or a path.
struct Finding {
  Verdict verdict = Verdict::Free;
  bool apart = false;  ///< in Collision: no two bodies touch that are within their margin
};
Finding findingOf(const MotionCertificate& certificate);
Finding findingOf(const TrajectoryCertificate& certificate);

/// The worst finding: Collision before Undecided before Free. Among collisions, one in which bodies
/// touch comes before one in which they are only within their margin.
Finding worst(const std::vector<Finding>& findings);
/// `3 motions: 1 free, 2 in collision`, of `what` = `motion`. `several`: its plural; default: with
/// an s.
std::string countsText(const std::string& what, const std::vector<Finding>& findings,
                       const std::string& several = {});

/// Where nothing is checked, green would say too much. So the tone and the headline say it.
void sayIfNothingIsChecked(PageContent& content, const Checker& checker);
/// The same where a trajectory leaves limits, which its verdict does not say.
void sayIfLimitsAreLeft(PageContent& content);

/// Judges states, to be shown one at a time.
PageContent statesContent(const Checker& checker, std::vector<PageContent::State> states);

/// Everything that a page shows, computed: what robot_model/pages/page/data.js reads. `checker` may
/// be null. Then nothing is judged, and the page may show states of the robot's first group, but no
/// motions.
Json pageJson(const Robot& robot, const World& world, const Checker* checker,
              const PageContent& content, const VisualModel& visuals);

/// The whole file. No text in `data` can end the element that holds it.
std::string htmlOf(const Json& data);

/// The whole file of a task: what robot_model/pages/page/task.js reads, but for the page of a
/// phase, which is added.
std::string taskHtmlOf(Json task);

}  // namespace swept
