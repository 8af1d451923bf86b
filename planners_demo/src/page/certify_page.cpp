// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "output/clearance_text.hpp"
#include "page/pages.hpp"
#include "page/program_page.hpp"

namespace swept {

void writeCertifyPage(const Arguments& args, const Model& model, const Task& task,
                      const PathCertificate& path) {
  if (args.page.file.empty()) return;
  PageContent content;
  std::vector<Finding> findings;
  std::optional<Clearances> least;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const CertifiedSegment& segment = path.segments[i];
    content.motions.push_back({.label = "segment " + std::to_string(i + 1),
                               .from = task.states[i].q,
                               .to = task.states[i + 1].q,
                               .certificate = segment.certificate});
    findings.push_back(findingOf(segment.certificate));
    if (!segment.clearance) continue;
    const Clearances own = clearancesOf(*segment.clearance);
    if (!least) least = own;
    takeLeast(own, *least);
  }
  content.tone = toneOf(worst(findings).verdict);
  content.headline = countsText("segment", findings);
  sayIfNothingIsChecked(content, *task.checker);
  if (least && path.verdict() == Verdict::Free) {
    content.facts = {{"clearance from the world", clearanceText(least->world.clearance)},
                     {"clearance from itself", clearanceText(least->self.clearance)}};
  }
  writePage(args, model, task.checker.get(), content);
}

}  // namespace swept
