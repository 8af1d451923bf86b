// SPDX-License-Identifier: BSD-3-Clause
#include <string>
#include <vector>

#include "page/pages.hpp"
#include "page/program_page.hpp"

namespace swept {

void showTrajectories(PageContent& content, const std::vector<ShownTrajectory>& trajectories) {
  std::vector<Finding> findings;
  for (const ShownTrajectory& shown : trajectories) {
    const Finding finding = findingOf(shown.certificate);
    findings.push_back(finding);
    content.paths.push_back({.label = shown.label, .tone = toneOf(finding.verdict)});
    content.trajectories.push_back({.label = shown.label,
                                    .curve = shown.curve,
                                    .query = shown.query,
                                    .certificate = shown.certificate,
                                    .polyline = shown.points});
  }
  content.tone = toneOf(worst(findings).verdict);
  content.headline = countsText("trajectory", findings, "trajectories");
  sayIfLimitsAreLeft(content);
}

void writeTrajectoryPage(const Arguments& args, const Model& model, const Checker& checker,
                         const std::vector<ShownTrajectory>& trajectories) {
  if (args.page.file.empty()) return;
  PageContent content;
  showTrajectories(content, trajectories);
  sayIfNothingIsChecked(content, checker);
  writePage(args, model, &checker, content);
}

}  // namespace swept
