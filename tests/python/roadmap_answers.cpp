// SPDX-License-Identifier: BSD-3-Clause
// A roadmap, and the same with a crate in the world: roadmaps_test.py has the same. A question has
// a start, a goal, the numbers of states and neighbours, the seed, and where the crate is.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "answer.hpp"
#include "swept/ompl_bridge/certified_roadmap.hpp"

namespace swept::test {
namespace {

void addGraph(Answer& answer, const ProvenGraph& graph) {
  answer << static_cast<double>(graph.states()) << static_cast<double>(graph.motions());
  for (std::size_t i = 0; i < graph.states(); ++i)
    for (const double value : graph.state(i)) answer << value;
  for (std::size_t i = 0; i < graph.motions(); ++i)
    answer << static_cast<double>(graph.motion(i).from) << static_cast<double>(graph.motion(i).to);
  for (std::size_t i = 0; i < graph.motions(); ++i) answer << static_cast<double>(graph.verdict(i));
}

void addPath(Answer& answer, const CertifiedRoadmap& roadmap, ConfigurationView start,
             ConfigurationView goal) {
  Workspace workspace(*roadmap.graph().checker());
  const auto path = roadmap.path(start, goal, workspace);
  answer << static_cast<double>(roadmap.freeMotions()) << static_cast<double>(roadmap.components())
         << static_cast<double>(path ? path->size() : 0);
  if (!path) return;
  for (const std::vector<double>& q : *path)
    for (const double value : q) answer << value;
}

void addChange(Answer& answer, const ProvenGraph::Change& change) {
  for (const std::size_t count :
       {change.bodiesGone, change.bodiesNew, change.byArithmetic, change.asked, change.motionsAsked,
        change.freed, change.blocked, static_cast<std::size_t>(change.everything)})
    answer << static_cast<double>(count);
}

}  // namespace

bool askRoadmaps(Answer& answer, const std::string& question, const Checker& checker,
                 ConfigurationView q, std::span<const double> more) {
  if (question != "roadmap") return false;
  const ConfigurationView goal = more.first(q.size());
  const std::span<const double> numbers = more.subspan(q.size());
  CertifiedRoadmap roadmap(std::make_shared<const Checker>(checker),
                           {.states = static_cast<std::size_t>(numbers[0]),
                            .neighbours = static_cast<std::size_t>(numbers[1]),
                            .seed = static_cast<std::uint32_t>(numbers[2])});
  addGraph(answer, roadmap.graph());
  addPath(answer, roadmap, q, goal);
  const Eigen::Isometry3d place(Eigen::Translation3d(numbers[3], numbers[4], numbers[5]));
  addChange(answer, roadmap.update(std::make_shared<const Checker>(
                        checker.withBody("crate", makeBox({0.2, 0.2, 0.2}), place))));
  addGraph(answer, roadmap.graph());
  addPath(answer, roadmap, q, goal);
  return true;
}

}  // namespace swept::test
