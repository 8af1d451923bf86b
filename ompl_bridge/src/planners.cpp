// SPDX-License-Identifier: BSD-3-Clause
#include "swept/ompl_bridge/planners.hpp"

#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/cforest/CForest.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/est/ProjEST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/BKPIECE1.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/kpiece/LBKPIECE1.h>
#include <ompl/geometric/planners/pdst/PDST.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/prm/SPARS.h>
#include <ompl/geometric/planners/prm/SPARStwo.h>
#include <ompl/geometric/planners/rlrt/BiRLRT.h>
#include <ompl/geometric/planners/rlrt/RLRT.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyLBTRRT.h>
#include <ompl/geometric/planners/rrt/LazyRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/rrt/pRRT.h>
#include <ompl/geometric/planners/sbl/SBL.h>
#include <ompl/geometric/planners/sbl/pSBL.h>
#include <ompl/geometric/planners/sst/SST.h>
#include <ompl/geometric/planners/stride/STRIDE.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "swept/ompl_bridge/certified_connect.hpp"
#include "swept/ompl_bridge/nearest_states.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

namespace og = ompl::geometric;

using Maker = ompl::base::PlannerPtr (*)(const ompl::base::SpaceInformationPtr&);

template <typename Planner>
ompl::base::PlannerPtr make(const ompl::base::SpaceInformationPtr& si) {
  return std::make_shared<Planner>(si);
}

struct Entry {
  std::string_view name;
  Maker maker;
  /// Whether it draws samples with OMPL's PathLengthDirectInfSampler, which exists for a few
  /// spaces.
  bool informed = false;
};

// CertifiedConnect, and every geometric planner of OMPL that needs nothing but the space. TSRRT,
// VFRRT, XXL, QRRT, Lightning and Thunder need a task space, a vector field, a decomposition, a
// sequence of spaces or a store of earlier paths, which a name does not give.
constexpr std::array kPlanners = {
    Entry{"ABITstar", make<og::ABITstar>, true},
    Entry{"AITstar", make<og::AITstar>, true},
    Entry{"AnytimePathShortening", make<og::AnytimePathShortening>},
    Entry{"BFMT", make<og::BFMT>},
    Entry{"BITstar", make<og::BITstar>, true},
    Entry{"BKPIECE1", make<og::BKPIECE1>},
    Entry{"BiEST", make<og::BiEST>},
    Entry{"BiRLRT", make<og::BiRLRT>},
    Entry{"BiTRRT", make<og::BiTRRT>},
    Entry{"CForest", make<og::CForest>, true},
    Entry{"CertifiedConnect", make<CertifiedConnect>},
    Entry{"EST", make<og::EST>},
    Entry{"FMT", make<og::FMT>},
    Entry{"InformedRRTstar", make<og::InformedRRTstar>, true},
    Entry{"KPIECE1", make<og::KPIECE1>},
    Entry{"LBKPIECE1", make<og::LBKPIECE1>},
    Entry{"LBTRRT", make<og::LBTRRT>},
    Entry{"LazyLBTRRT", make<og::LazyLBTRRT>},
    Entry{"LazyPRM", make<og::LazyPRM>},
    Entry{"LazyPRMstar", make<og::LazyPRMstar>},
    Entry{"LazyRRT", make<og::LazyRRT>},
    Entry{"PDST", make<og::PDST>},
    Entry{"PRM", make<og::PRM>},
    Entry{"PRMstar", make<og::PRMstar>},
    Entry{"ProjEST", make<og::ProjEST>},
    Entry{"RLRT", make<og::RLRT>},
    Entry{"RRT", make<og::RRT>},
    Entry{"RRTConnect", make<og::RRTConnect>},
    Entry{"RRTXstatic", make<og::RRTXstatic>},
    Entry{"RRTsharp", make<og::RRTsharp>},
    Entry{"RRTstar", make<og::RRTstar>},
    Entry{"SBL", make<og::SBL>},
    Entry{"SORRTstar", make<og::SORRTstar>, true},
    Entry{"SPARS", make<og::SPARS>},
    Entry{"SPARStwo", make<og::SPARStwo>},
    Entry{"SST", make<og::SST>},
    Entry{"STRIDE", make<og::STRIDE>},
    Entry{"TRRT", make<og::TRRT>},
    Entry{"pRRT", make<og::pRRT>},
    Entry{"pSBL", make<og::pSBL>},
};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

/// OMPL says so only once it plans. CForest plans in threads of its own, where an exception ends
/// the process.
void requireInformedSamples(std::string_view planner, const ompl::base::StateSpace& space) {
  namespace ob = ompl::base;
  const int type = space.getType();
  if (type == ob::STATE_SPACE_REAL_VECTOR || type == ob::STATE_SPACE_SE2 ||
      type == ob::STATE_SPACE_SE3)
    return;
  throw UsageError(
      "planner " + std::string(planner) + " cannot plan in space '" + space.getName() +
      "': OMPL's informed samples are of joints with limits alone, or of one planar or "
      "floating joint; allowed there: planners that draw none, such as RRTstar");
}

}  // namespace

std::vector<std::string> plannerNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kPlanners) names.emplace_back(entry.name);
  std::ranges::sort(names, {}, [](const std::string& name) { return lower(name); });
  return names;
}

std::string plannerName(std::string_view anyCase) {
  for (const Entry& entry : kPlanners)
    if (lower(entry.name) == lower(anyCase)) return std::string(entry.name);
  const std::vector<std::string> names = plannerNames();
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  throw UsageError("no planner '" + std::string(anyCase) + "'; there are " + list +
                   didYouMean(std::string(anyCase), names));
}

ompl::base::PlannerPtr makePlanner(std::string_view name,
                                   const ompl::base::SpaceInformationPtr& si) {
  const auto* entry = std::ranges::find(kPlanners, name, &Entry::name);
  if (entry == kPlanners.end()) throw UsageError("no planner '" + std::string(name) + "'");
  if (entry->informed) requireInformedSamples(name, *si->getStateSpace());
  const ompl::base::PlannerPtr planner = entry->maker(si);
  useNearestStates(*planner);
  return planner;
}

}  // namespace swept
