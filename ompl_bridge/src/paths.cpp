// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/paths.hpp"

#include <ompl/geometric/PathSimplifier.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "number_text.hpp"
#include "preconditions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/state_space.hpp"

namespace swept {

std::vector<std::vector<double>> configurationsOf(const ompl::geometric::PathGeometric& path,
                                                  const Checker& checker) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return configurationsOf(path, checker); });
  }
  detail::requireSpaceOf(checker, *path.getSpaceInformation()->getStateSpace());
  const StateConversion conversion(checker.robot(), checker.group());
  std::vector<std::vector<double>> states(path.getStateCount(),
                                          std::vector<double>(conversion.dimension()));
  for (std::size_t i = 0; i < states.size(); ++i)
    conversion.toConfiguration(path.getState(static_cast<unsigned int>(i)), states[i]);
  return states;
}

std::vector<MotionCertificate> certifyPath(const ompl::geometric::PathGeometric& path,
                                           const Checker& checker) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return certifyPath(path, checker); });
  }
  const std::vector<std::vector<double>> states = configurationsOf(path, checker);
  std::vector<MotionCertificate> certificates;
  Workspace workspace(checker);
  for (std::size_t i = 1; i < states.size(); ++i)
    certificates.push_back(checker.certifyMotion(states[i - 1], states[i], workspace));
  return certificates;
}

std::vector<MotionCertificate> simplifyPath(ompl::geometric::PathGeometric& path,
                                            const Checker& checker, double time,
                                            const ompl::base::GoalPtr& goal) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, time] { return simplifyPath(path, checker, time, goal); });
  }
  if (!(time > 0.0) || !std::isfinite(time)) {
    throw std::invalid_argument("simplifyPath: time " + detail::numberText(time) +
                                " s must be a finite number greater than zero");
  }
  std::vector<MotionCertificate> before = certifyPath(path, checker);
  if (before.empty()) return before;
  ompl::geometric::PathGeometric simpler(path);
  ompl::geometric::PathSimplifier(path.getSpaceInformation(), goal).simplify(simpler, time);
  std::vector<MotionCertificate> after = certifyPath(simpler, checker);
  const bool proven = std::ranges::all_of(after, [](const MotionCertificate& certificate) {
    return certificate.verdict == Verdict::Free;
  });
  if (!proven || simpler.length() > path.length()) return before;
  path = simpler;
  return after;
}

unsigned certifyEdges(ompl::base::PlannerData& data, const Checker& checker) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return certifyEdges(data, checker); });
  }
  detail::requireSpaceOf(checker, *data.getSpaceInformation()->getStateSpace());
  const StateConversion conversion(checker.robot(), checker.group());
  Workspace workspace(checker);
  std::vector<double> from(conversion.dimension()), to(conversion.dimension());
  std::vector<unsigned int> neighbours;
  unsigned proven = 0;
  for (unsigned int v = 0; v < data.numVertices(); ++v) {
    conversion.toConfiguration(data.getVertex(v).getState(), from);
    data.getEdges(v, neighbours);
    for (const unsigned int other : neighbours) {
      conversion.toConfiguration(data.getVertex(other).getState(), to);
      const CertifiedEdge edge(checker.certifyMotion(from, to, workspace));
      ompl::base::Cost weight;
      data.getEdgeWeight(v, other, &weight);
      data.removeEdge(v, other);
      data.addEdge(v, other, edge, weight);
      proven += edge.certificate().verdict == Verdict::Free;
    }
  }
  return proven;
}

}  // namespace swept
