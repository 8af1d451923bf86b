// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <utility>

#include "page/page_content.hpp"

namespace swept {

PageContent::Tone toneOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::Free:
      return PageContent::Tone::Good;
    case Verdict::Collision:
    case Verdict::Violation:
      return PageContent::Tone::Bad;
    case Verdict::Undecided:
      break;
  }
  return PageContent::Tone::Unsure;
}

Finding findingOf(const MotionCertificate& certificate) {
  return {.verdict = certificate.verdict,
          .apart = certificate.witness && keepsApart(*certificate.witness)};
}

Finding findingOf(const TrajectoryCertificate& certificate) {
  return {.verdict = certificate.verdict,
          .apart = certificate.contact && keepsApart(certificate.contact->witness)};
}

std::string countsText(const std::string& what, const std::vector<Finding>& findings,
                       const std::string& several) {
  static constexpr std::array<std::pair<Finding, const char*>, 5> kWords{
      {{{Verdict::Free, false}, "free"},
       {{Verdict::Collision, false}, "in collision"},
       {{Verdict::Collision, true}, "closer than the margin"},
       {{Verdict::Violation, false}, "off a constraint"},
       {{Verdict::Undecided, false}, "undecided"}}};
  std::vector<std::string> counts;
  for (const auto& [kind, word] : kWords) {
    const Finding& wanted = kind;  // clang 14 captures no structured binding
    const auto count = std::ranges::count_if(findings, [&](const Finding& other) {
      return other.verdict == wanted.verdict && other.apart == wanted.apart;
    });
    if (count == 0) continue;
    const bool all = count == std::ssize(findings);
    counts.push_back(findings.size() == 1 ? word
                                          : (all ? "all" : std::to_string(count)) + " " + word);
  }
  if (findings.size() == 1) return what + ": " + counts.front();
  return countedText(findings.size(), what, several) + ": " + joined(counts);
}

Finding worst(const std::vector<Finding>& findings) {
  const auto badness = [](const Finding& finding) {
    if (finding.verdict == Verdict::Collision) return finding.apart ? 2 : 3;
    if (finding.verdict == Verdict::Violation) return 2;
    return finding.verdict == Verdict::Undecided ? 1 : 0;
  };
  const auto found = std::ranges::max_element(findings, {}, badness);
  return found == findings.end() ? Finding{} : *found;
}

void sayIfNothingIsChecked(PageContent& content, const Checker& checker) {
  if (!checker.checksNothing() || content.tone != PageContent::Tone::Good) return;
  content.tone = PageContent::Tone::Unsure;
  content.headline += ", nothing was checked";
}

void sayIfLimitsAreLeft(PageContent& content) {
  const auto leaving = std::ranges::count_if(
      content.trajectories, [](const auto& own) { return !own.certificate.violations.empty(); });
  if (leaving == 0) return;
  if (content.tone == PageContent::Tone::Good) content.tone = PageContent::Tone::Unsure;
  const std::size_t limits = content.trajectories.front().certificate.violations.size();
  content.headline += content.trajectories.size() == 1
                          ? ", beyond " + countedText(limits, "limit")
                          : "; " + std::to_string(leaving) + " beyond limits";
}

PageContent statesContent(const Checker& checker, std::vector<PageContent::State> states) {
  PageContent content;
  Workspace workspace(checker);
  std::vector<Finding> findings;
  for (const PageContent::State& state : states) {
    Finding finding{.verdict = checker.checkState(state.q, workspace)};
    if (finding.verdict == Verdict::Collision)
      finding.apart = keepApart(checker.reportState(state.q, workspace).contacts);
    findings.push_back(finding);
  }
  content.tone = toneOf(worst(findings).verdict);
  content.headline = countsText("state", findings);
  sayIfNothingIsChecked(content, checker);
  content.states = std::move(states);
  return content;
}

}  // namespace swept
