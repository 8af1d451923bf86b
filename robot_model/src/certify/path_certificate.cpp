// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/path_certificate.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <string>
#include <thread>

#include "certify/work_limits.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "threads/for_each_index.hpp"

namespace swept {

namespace {

/// Segments between two calls of PathQuery::progress.
constexpr std::size_t kBetween = 256;

CertifiedSegment certified(const Checker& checker, ConfigurationView from, ConfigurationView to,
                           bool clearance, Workspace& workspace) {
  CertifiedSegment segment{.certificate = checker.certifyMotion(from, to, workspace),
                           .clearance = {}};
  if (clearance && segment.certificate.verdict != Verdict::Collision) {
    const double accuracy = detail::clearanceAccuracy(checker.options().tolerance);
    segment.clearance = checker.motionClearance(from, to, accuracy, workspace);
  }
  return segment;
}

}  // namespace

Verdict PathCertificate::verdict() const {
  if (count(Verdict::Violation) > 0) return Verdict::Violation;
  if (count(Verdict::Collision) > 0) return Verdict::Collision;
  return count(Verdict::Free) == segments.size() ? Verdict::Free : Verdict::Undecided;
}

std::size_t PathCertificate::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count_if(
      segments,
      [&](const CertifiedSegment& segment) { return segment.certificate.verdict == verdict; }));
}

PathCertificate certifyPath(const Checker& checker, const ConfigurationList& states,
                            const PathQuery& query) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return certifyPath(checker, states, query); });
  }
  if (states.empty()) throw std::invalid_argument("a path has one state at least");
  for (const ConfigurationView& q : states)
    if (std::ssize(q) != checker.dimension())
      throw std::invalid_argument("a state of group '" + checker.group().name + "' has " +
                                  std::to_string(checker.dimension()) + " values, not " +
                                  std::to_string(q.size()));
  PathCertificate path;
  path.segments.resize(std::max<std::size_t>(states.size() - 1, 1));
  const std::size_t threads = std::min<std::size_t>(
      query.threads > 0 ? query.threads : std::max(std::thread::hardware_concurrency(), 1U),
      path.segments.size());
  for (std::size_t begin = 0; begin < path.segments.size(); begin += kBetween) {
    const std::size_t end = std::min(begin + kBetween, path.segments.size());
    std::atomic<std::size_t> next = begin;
    detail::forEachIndex(threads, query.threads, [&](std::size_t) {
      Workspace workspace(checker);
      for (std::size_t i = next++; i < end; i = next++)
        path.segments[i] = certified(checker, states[i], states[std::min(i + 1, states.size() - 1)],
                                     query.clearances, workspace);
    });
    if (query.progress) query.progress(end);
  }
  return path;
}

}  // namespace swept
