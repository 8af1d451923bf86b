// SPDX-License-Identifier: BSD-3-Clause
#include "workloads.hpp"

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>

#include "motion_lists.hpp"

namespace swept::instructions {
namespace {

using Sites = std::vector<std::unique_ptr<Site>>;

Workload motionWorkload(Sites sites, MotionQuery query) {
  Workload workload;
  for (const auto& site : sites) workload.items += site->motions.size();
  workload.sites = std::move(sites);
  workload.run = [query](Site& site) {
    for (const Motion& motion : site.motions)
      site.checker.certifyMotion(motion.from, motion.to, site.workspace, query);
  };
  return workload;
}

/// States along the motions of the site, evenly spread.
void addStates(Site& site) {
  constexpr int kStates = 8;  // per motion
  for (const Motion& motion : site.motions) {
    for (int i = 0; i < kStates; ++i) {
      const Eigen::VectorXd q =
          site.checker.interpolate(motion.from, motion.to, i / double{kStates - 1});
      site.states.insert(site.states.end(), q.begin(), q.end());
      site.verdicts.push_back(Verdict::Undecided);
    }
  }
}

Workload stateWorkload(Sites sites, void (*ask)(Site&)) {
  Workload workload;
  for (const auto& site : sites) {
    addStates(*site);
    workload.items += site->verdicts.size();
  }
  workload.sites = std::move(sites);
  workload.run = ask;
  return workload;
}

void askOneByOne(Site& site) {
  const std::span<const double> states = site.states;
  const auto dimension = static_cast<std::size_t>(site.checker.dimension());
  for (std::size_t i = 0; i < site.verdicts.size(); ++i)
    site.verdicts[i] =
        site.checker.checkState(states.subspan(i * dimension, dimension), site.workspace);
}

void askTogether(Site& site) {
  site.checker.checkStates(site.states, site.verdicts, site.workspace);
}

Workload verdictWorkload(Models& models, Verdict verdict, MotionQuery query) {
  Sites sites = armSites(models);
  keepVerdict(sites, verdict);
  return motionWorkload(std::move(sites), query);
}

Workload grazingMotions(Models& models) {
  Sites sites = armSites(models);
  cutAtContact(sites);
  return motionWorkload(std::move(sites), MotionQuery::VerdictOnly);
}

/// A planar base: x and y in metres, theta in radians; the rest is rook6.
Workload cartMotions(Models& models) {
  constexpr double kPi = 3.14159265358979;
  const std::array ranges{Range{0, 2, -1.5, 1.5}, Range{2, 1, -kPi, kPi}, Range{3, 1, -kPi, kPi},
                          Range{8, 1, -kPi, kPi}};
  return motionWorkload(
      randomSite(models, "rook6_cart", "whole_body", "narrow_slot", ranges, 60, 5),
      MotionQuery::VerdictOnly);
}

/// A floating base: a position in metres and a quaternion, which need not be of unit length.
Sites drifterSite(Models& models) {
  const std::array ranges{Range{0, 2, -1.0, 1.0}, Range{2, 1, 0.0, 1.0}, Range{3, 4, -1.0, 1.0}};
  return randomSite(models, "drifter", "body", "table_objects", ranges, 60, 7);
}

Workload drifterMotions(Models& models) {
  return motionWorkload(drifterSite(models), MotionQuery::VerdictOnly);
}

/// The same motions, 0.6 s each, under a box that goes to and fro and tumbles: each passes one of
/// its 400 waypoints.
Workload obstacleMotions(Models& models) {
  const Sites still = drifterSite(models);
  MovingObstacle shuttle{.name = "shuttle",
                         .parts = {{makeBox({0.2, 0.1, 0.1}), Eigen::Isometry3d::Identity()}}};
  for (int i = 0; i < 400; ++i) {
    const Eigen::AngleAxisd turn(0.5 * i, Eigen::Vector3d::UnitX());
    const Eigen::Translation3d place(i % 2 == 0 ? -1.0 : 1.0, 0.0, 2.0);
    shuttle.waypoints.push_back({0.5 * i, Eigen::Isometry3d(place * turn)});
  }
  Sites sites;
  sites.push_back(std::make_unique<Site>(still.front()->checker.withObstacle(std::move(shuttle))));
  double time = 0.2;
  for (Motion motion : still.front()->motions) {
    motion.from.push_back(time);
    motion.to.push_back(time + 0.6);
    sites.front()->motions.push_back(std::move(motion));
    time += 3.0;
  }
  return motionWorkload(std::move(sites), MotionQuery::VerdictOnly);
}

struct Named {
  const char* name;
  std::function<Workload(Models&)> make;
};

const std::vector<Named>& catalogue() {
  static const std::vector<Named> all{
      {"free_motions",
       [](Models& models) {
         return verdictWorkload(models, Verdict::Free, MotionQuery::VerdictOnly);
       }},
      {"colliding_motions",
       [](Models& models) {
         return verdictWorkload(models, Verdict::Collision, MotionQuery::VerdictOnly);
       }},
      {"first_contacts",
       [](Models& models) {
         return verdictWorkload(models, Verdict::Collision, MotionQuery::FirstContact);
       }},
      {"grazing_motions", grazingMotions},
      {"states", [](Models& models) { return stateWorkload(armSites(models), askOneByOne); }},
      {"state_batches",
       [](Models& models) { return stateWorkload(armSites(models), askTogether); }},
      {"cart_motions", cartMotions},
      {"drifter_motions", drifterMotions},
      {"obstacle_motions", obstacleMotions}};
  return all;
}

}  // namespace

std::vector<std::string> workloadNames() {
  std::vector<std::string> names;
  for (const Named& named : catalogue()) names.emplace_back(named.name);
  return names;
}

Workload makeWorkload(std::string_view name, Models& models) {
  for (const Named& named : catalogue()) {
    if (name != named.name) continue;
    Workload workload = named.make(models);
    workload.name = named.name;
    return workload;
  }
  throw std::invalid_argument("no workload '" + std::string(name) + "'");
}

}  // namespace swept::instructions
