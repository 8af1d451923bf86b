// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "certificate/verify_outcome.hpp"
#include "command_line/arguments.hpp"
#include "command_line/exit_code.hpp"
#include "input/task.hpp"
#include "output/text_output.hpp"
#include "planning/planning.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/shape_model.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

namespace CLI {
class App;
}

/// Pages of the subcommands: the robot, its world and the result in one HTML file. A program that
/// was built without three.js has neither the option nor the subcommand `view`.
namespace swept {

void addHtmlOption(CLI::App& app, Arguments& args);

/// Throws UsageError when the file of --html could not be written: better before the work than
/// after it. Does nothing without --html, as all that follow.
void requirePageFile(const Arguments& args);

/// They write the page and say so on stdout, unless that is JSON. Throw UsageError.
void writeCheckPage(const Arguments& args, const Model& model, const Task& task);
void writeMotionPage(const Arguments& args, const Model& model, const Task& task);
void writeCertifyPage(const Arguments& args, const Model& model, const Task& task,
                      const PathCertificate& path);
/// A trajectory of a page.
struct ShownTrajectory {
  std::string label;
  PiecewisePolynomial curve;
  TrajectoryQuery query;
  TrajectoryCertificate certificate;
  std::vector<std::vector<double>> points;  ///< configurations that straight motions are shown of
};
void writeTrajectoryPage(const Arguments& args, const Model& model, const Checker& checker,
                         const std::vector<ShownTrajectory>& trajectories);
/// `trajectory`: shown instead of the path that it was made of; null: none was made.
void writePlanPage(const Arguments& args, const Model& model, const Task& task,
                   const PlanRequest& request, const PlanOutcome& outcome,
                   const ShownTrajectory* trajectory);
/// `file`: the path's, as parsed; its states are shown.
void writeVerifyPage(const Arguments& args, const Model& model, const Task& task, const Json& file,
                     const VerifyOutcome& outcome);
/// `checker` may be null.
void writeInfoPage(const Arguments& args, const Model& model, const Checker* checker);
/// `robot`: whose links the model is of; the one of `model`, or its visuals.
void writeCoverPage(const Arguments& args, const Model& model, const Robot& robot,
                    const ShapeModel& shapes, const std::vector<LinkSphereReport>& reports);

}  // namespace swept
