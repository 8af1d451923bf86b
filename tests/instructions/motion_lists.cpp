// SPDX-License-Identifier: BSD-3-Clause
#include "motion_lists.hpp"

#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "swept/robot_model/problems.hpp"

namespace swept::instructions {
namespace {

/// Where the group's variables stand in a list that is in the order of `names`.
std::vector<std::size_t> placesOfGroup(const Checker& checker,
                                       const std::vector<std::string>& names) {
  std::vector<std::size_t> places;
  for (const int variable : checker.group().variables) {
    const std::string& name = checker.robot().variables()[static_cast<std::size_t>(variable)].name;
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) throw std::invalid_argument("the problems lack joint " + name);
    places.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return places;
}

/// A line of models/edges.csv: set,index,from0,..,to0,..,length.
struct Edge {
  std::string set;
  int index = 0;
  std::vector<double> values;  ///< from, to
};

std::vector<Edge> readEdges(const std::filesystem::path& csv) {
  std::ifstream file(csv);
  std::vector<Edge> edges;
  std::string line;
  std::getline(file, line);  // the header
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    Edge edge;
    std::string cell;
    std::getline(cells, edge.set, ',');
    std::getline(cells, cell, ',');
    edge.index = std::stoi(cell);
    while (std::getline(cells, cell, ',')) edge.values.push_back(std::stod(cell));
    edge.values.pop_back();  // the length
    edges.push_back(std::move(edge));
  }
  if (edges.empty()) throw std::invalid_argument(csv.string() + " has no motions");
  return edges;
}

Motion motionOf(const Edge& edge, const std::vector<std::size_t>& places) {
  Motion motion;
  const std::size_t half = edge.values.size() / 2;
  for (const std::size_t place : places) {
    motion.from.push_back(edge.values.at(place));
    motion.to.push_back(edge.values.at(half + place));
  }
  return motion;
}

/// In [0, 1). The standard leaves open how its own distributions draw.
double uniform(std::mt19937_64& engine) {
  return static_cast<double>(engine() >> 11) * 0x1p-53;
}

std::vector<double> randomConfiguration(const Checker& checker, std::span<const Range> ranges,
                                        std::mt19937_64& engine) {
  std::vector<double> q;
  for (int i = 0; i < checker.dimension(); ++i) {
    const int variable = checker.group().variables[static_cast<std::size_t>(i)];
    const Variable& known = checker.robot().variables()[static_cast<std::size_t>(variable)];
    double lower = known.lower;
    double upper = known.upper;
    for (const Range& range : ranges) {
      if (i < range.first || i >= range.first + range.count) continue;
      lower = range.lower;
      upper = range.upper;
    }
    q.push_back(lower + uniform(engine) * (upper - lower));
  }
  return q;
}

/// The state at t is proven free.
bool freeAt(Site& site, const Motion& motion, double t) {
  const Eigen::VectorXd q = site.checker.interpolate(motion.from, motion.to, t);
  return site.checker.checkState(q, site.workspace) == Verdict::Free;
}

}  // namespace

std::shared_ptr<const Robot> Models::load(const std::string& robot) const {
  const std::filesystem::path stem = folder_ / "robots" / robot / robot;
  return Robot::load(stem.string() + ".urdf", stem.string() + ".srdf");
}

const Checker& Models::arm() {
  if (!arm_) arm_.emplace(load("rook7"), "arm", std::make_shared<const World>());
  return *arm_;
}

std::vector<std::unique_ptr<Site>> armSites(Models& models) {
  const ProblemFile problems = ProblemFile::load(models.folder() / "problems.json");
  const std::vector<Edge> edges = readEdges(models.folder() / "edges.csv");
  std::vector<std::unique_ptr<Site>> sites;
  for (const std::string& set : problems.sets()) {
    for (const int index : problems.indices(set)) {
      const PlanningProblem problem = problems.problem(set, index);
      const auto world = std::make_shared<const World>(problem.world);
      sites.push_back(std::make_unique<Site>(models.arm().withWorld(world)));
      Site& site = *sites.back();
      const auto places = placesOfGroup(site.checker, problem.jointNames);
      for (const Edge& edge : edges)
        if (edge.set == set && edge.index == index) site.motions.push_back(motionOf(edge, places));
    }
  }
  return sites;
}

std::vector<std::unique_ptr<Site>> randomSite(const Models& models, const std::string& robot,
                                              const std::string& group, const std::string& scene,
                                              std::span<const Range> ranges, int count,
                                              std::uint64_t seed) {
  const auto world =
      std::make_shared<const World>(World::load(models.folder() / "scenes" / (scene + ".yaml")));
  std::vector<std::unique_ptr<Site>> sites;
  sites.push_back(std::make_unique<Site>(Checker(models.load(robot), group, world)));
  Site& site = *sites.back();
  std::mt19937_64 engine(seed);
  for (int i = 0; i < count; ++i) {
    Motion motion;
    motion.from = randomConfiguration(site.checker, ranges, engine);
    const auto far = randomConfiguration(site.checker, ranges, engine);
    const Eigen::VectorXd end = site.checker.interpolate(motion.from, far, 0.25);
    motion.to.assign(end.begin(), end.end());
    site.motions.push_back(std::move(motion));
  }
  return sites;
}

void keepVerdict(std::vector<std::unique_ptr<Site>>& sites, Verdict verdict) {
  for (const auto& site : sites) {
    std::erase_if(site->motions, [&](const Motion& motion) {
      return site->checker
                 .certifyMotion(motion.from, motion.to, site->workspace, MotionQuery::VerdictOnly)
                 .verdict != verdict;
    });
  }
}

void cutAtContact(std::vector<std::unique_ptr<Site>>& sites) {
  constexpr int kSamples = 100;
  constexpr int kHalvings = 3;
  for (const auto& site : sites) {
    std::vector<Motion> cut;
    for (const Motion& motion : site->motions) {
      int sample = 0;
      while (sample <= kSamples && freeAt(*site, motion, sample / double{kSamples})) ++sample;
      if (sample == 0 || sample > kSamples) continue;
      double free = (sample - 1) / double{kSamples};
      double contact = sample / double{kSamples};
      for (int i = 0; i < kHalvings; ++i) {
        const double middle = 0.5 * (free + contact);
        (freeAt(*site, motion, middle) ? free : contact) = middle;
      }
      const Eigen::VectorXd end = site->checker.interpolate(motion.from, motion.to, free);
      cut.push_back({motion.from, {end.begin(), end.end()}});
    }
    site->motions = std::move(cut);
  }
}

}  // namespace swept::instructions
