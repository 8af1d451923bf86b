// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "output/whole_file.hpp"
#include "page/page_content.hpp"
#include "page/page_data.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/pages/page.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {

namespace {

std::vector<double> checkedValues(const Checker& checker, const std::string& label,
                                  std::span<const double> state, bool withTime) {
  const std::size_t variables = checker.group().variables.size();
  if (state.size() != variables + (withTime ? 1 : 0))
    throw std::invalid_argument("'" + label + "' has " + std::to_string(state.size()) +
                                " values; group '" + checker.group().name + "' has " +
                                std::to_string(variables) + " variables" +
                                (withTime ? ", and the time of what moves comes after them" : ""));
  if (!std::ranges::all_of(state, [](double value) { return std::isfinite(value); }))
    throw std::invalid_argument("'" + label + "' has a value that is not finite");
  return {state.begin(), state.end()};
}

/// A configuration as the checker takes it.
std::vector<double> checkedState(const Checker& checker, const std::string& label,
                                 std::span<const double> state) {
  return checkedValues(checker, label, state, !checker.world().obstacles().empty());
}

void requireSizeOf(const Checker& checker, const std::string& label,
                   const PiecewisePolynomial& curve) {
  const Eigen::VectorXd begin = curve.position(curve.begin());
  static_cast<void>(
      checkedValues(checker, label, {begin.data(), std::size_t(begin.size())}, false));
}

/// Orientations have to be some.
void requireDrawable(const Checker& checker, const std::string& label,
                     const PiecewisePolynomial& curve) {
  for (const int index : checker.group().joints) {
    const Joint& joint = checker.robot().joints()[static_cast<std::size_t>(index)];
    if (joint.type != JointType::Floating) continue;
    const auto found = std::ranges::find(checker.group().variables, joint.firstVariable);
    const auto first = found - checker.group().variables.begin() + 3;
    for (std::size_t piece = 0; piece < curve.pieces(); ++piece) {
      const auto orientations = curve.coefficients(piece).middleRows(first, 4);
      for (Eigen::Index k = 0; k < orientations.cols(); ++k)
        if (!(orientations.col(k).norm() > 1e-6))
          throw std::invalid_argument("'" + label + "': the quaternion of joint '" + joint.name +
                                      "' has no direction in piece " + std::to_string(piece));
    }
  }
}

}  // namespace

Finding Page::Data::addMotion(const std::string& label, const std::vector<double>& from,
                              const std::vector<double>& to) {
  Workspace workspace(*checker);
  content.motions.push_back({.label = label,
                             .from = from,
                             .to = to,
                             .certificate = checker->certifyMotion(from, to, workspace),
                             .path = static_cast<int>(content.paths.size())});
  return findingOf(content.motions.back().certificate);
}

PageContent Page::Data::judged() const {
  PageContent all;
  if (kind == Kind::Nothing) throw std::invalid_argument("a page of nothing");
  if (kind == Kind::States) {
    all = statesContent(*checker, content.states);
  } else {
    all = content;
    all.tone = toneOf(worst(findings).verdict);
    all.headline = kind == Kind::Trajectories
                       ? countsText("trajectory", findings, "trajectories")
                       : countsText(kind == Kind::Paths ? "path" : "motion", findings);
    sayIfNothingIsChecked(all, *checker);
    sayIfLimitsAreLeft(all);
  }
  all.title = options.title;
  all.facts = options.facts;
  if (!options.headline.empty()) all.headline = options.headline;
  return all;
}

Json Page::Data::json() const {
  return pageJson(checker->robot(), checker->world(), checker.get(), judged(), options.visuals);
}

Page::Page(std::shared_ptr<const Checker> checker, PageOptions options)
    : data_(std::make_unique<Data>()) {
  if (checker == nullptr) throw std::invalid_argument("a page without a checker");
  data_->checker = std::move(checker);
  data_->options = std::move(options);
}
Page::~Page() = default;
Page::Page(Page&&) noexcept = default;
Page& Page::operator=(Page&&) noexcept = default;

void Page::addState(const std::string& label, std::span<const double> state) {
  std::vector<double> q = checkedState(*data_->checker, label, state);
  data_->require(Data::Kind::States);
  data_->content.states.push_back({.label = label, .q = std::move(q)});
}

void Page::addMotion(const std::string& label, std::span<const double> from,
                     std::span<const double> to) {
  const std::vector<double> start = checkedState(*data_->checker, label, from);
  const std::vector<double> end = checkedState(*data_->checker, label, to);
  data_->require(Data::Kind::Motions);
  data_->findings.push_back(data_->addMotion(label, start, end));
}

void Page::addPath(const std::string& label, std::span<const std::vector<double>> states) {
  if (states.empty()) throw std::invalid_argument("path '" + label + "' has no state");
  for (const std::vector<double>& state : states)
    static_cast<void>(checkedState(*data_->checker, label, state));
  data_->require(Data::Kind::Paths);
  std::vector<Finding> segments;
  const std::size_t count = std::max<std::size_t>(1, states.size() - 1);
  for (std::size_t i = 0; i < count; ++i)
    segments.push_back(data_->addMotion("segment " + std::to_string(i + 1), states[i],
                                        states[std::min(i + 1, states.size() - 1)]));
  data_->findings.push_back(worst(segments));
  data_->content.paths.push_back({.label = label, .tone = toneOf(data_->findings.back().verdict)});
}

void Page::addTrajectory(const std::string& label, const PiecewisePolynomial& curve,
                         const TrajectoryQuery& query,
                         std::span<const std::vector<double>> polyline) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, polyline] { addTrajectory(label, curve, query, polyline); });
  }
  const Checker& checker = *data_->checker;
  requireSizeOf(checker, label, curve);
  requireDrawable(checker, label, curve);
  for (const std::vector<double>& state : polyline)
    static_cast<void>(checkedValues(checker, "polyline of " + label, state, false));
  TrajectoryQuery asked = query;
  asked.clearances = false;  // the parts have them
  Workspace workspace(checker);
  TrajectoryCertificate certificate = checker.certifyTrajectory(curve, workspace, asked);
  data_->require(Data::Kind::Trajectories);
  data_->findings.push_back(findingOf(certificate));
  data_->content.paths.push_back({.label = label, .tone = toneOf(certificate.verdict)});
  data_->content.trajectories.push_back({.label = label,
                                         .curve = curve,
                                         .query = query,
                                         .certificate = std::move(certificate),
                                         .polyline = {polyline.begin(), polyline.end()}});
}

std::string Page::html() const {
  if (detail::inForeignEnvironment()) return inDefaultEnvironment([&] { return html(); });
  return htmlOf(data_->json());
}

void Page::write(const std::filesystem::path& file) const {
  const std::string name = file.string();
  if (file.extension() != ".html" && file.extension() != ".htm")
    throw UsageError("'" + name + "': a page ends in .html or .htm");
  requireWritable(file);
  writeWholeFile(name, html());
}

}  // namespace swept
