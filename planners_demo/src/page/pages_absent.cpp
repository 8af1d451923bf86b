// SPDX-License-Identifier: BSD-3-Clause
#include "page/pages.hpp"

#include "command_line/commands.hpp"

/// For a program without pages. No option leads to one.
namespace swept {

void addHtmlOption(CLI::App&, Arguments&) {}

std::span<const Command* const> pageCommands() {
  return {};
}

void requirePageFile(const Arguments&) {}
void writeCheckPage(const Arguments&, const Model&, const Task&) {}
void writeMotionPage(const Arguments&, const Model&, const Task&) {}
void writeCertifyPage(const Arguments&, const Model&, const Task&, const PathCertificate&) {}
void writeTrajectoryPage(const Arguments&, const Model&, const Checker&,
                         const std::vector<ShownTrajectory>&) {}
void writePlanPage(const Arguments&, const Model&, const Task&, const PlanRequest&,
                   const PlanOutcome&, const ShownTrajectory*) {}
void writeVerifyPage(const Arguments&, const Model&, const Task&, const Json&,
                     const VerifyOutcome&) {}
void writeInfoPage(const Arguments&, const Model&, const Checker*) {}
void writeCoverPage(const Arguments&, const Model&, const Robot&, const ShapeModel&,
                    const std::vector<LinkSphereReport>&) {}

}  // namespace swept
