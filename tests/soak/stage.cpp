// SPDX-License-Identifier: BSD-3-Clause
#include "stage.hpp"

#include "swept/ompl_bridge/state_space.hpp"

namespace soak {

Stage::Stage(const ScenarioFiles& files, std::uint64_t seed, double margin)
    : files_(files),
      name_(files.robot.stem().string()),
      margin_(margin),
      base_(loadScenario(files, {.margin = margin})),
      space_(swept::makeStateSpace(base_.checker->robot(), base_.checker->group())) {
  for (int form = 0; form < kForms; ++form) forms_.push_back(makeClutter(kForms * seed + form));
}

swept::World Stage::worldOf(const WorldKey& key) const {
  swept::World world;
  for (const Choice& choice : key) world.add(body(choice));
  return world;
}

Scenario Stage::judged(const WorldKey& key, const swept::Checker& checker) const {
  std::vector<oracle::Body> twins;
  for (const Choice& choice : key) twins.push_back(forms_[choice.form].twins[choice.place]);
  Scenario scenario;
  scenario.robot = base_.robot;
  scenario.srdf = base_.srdf;
  scenario.group = base_.group;
  scenario.place = base_.place;
  scenario.checker = std::make_unique<swept::Checker>(checker);
  scenario.oracle =
      std::make_unique<oracle::Oracle>(base_.oracle->arm(), std::move(twins), base_.group);
  return scenario;
}

void Stage::displaceTwins(const Eigen::Vector3d& metres) {
  for (Clutter& clutter : forms_)
    for (oracle::Body& body : clutter.twins)
      for (oracle::Piece& piece : body.pieces) piece.body_from_piece.pretranslate(metres);
}

}  // namespace soak
