// SPDX-License-Identifier: BSD-3-Clause
#include "world_line.hpp"

#include <algorithm>
#include <utility>

namespace soak {

namespace {

// Between these many bodies a good share of queries is free, and a good share is not.
constexpr int kFewest = 3;
constexpr int kMost = 10;

bool taken(const WorldKey& key, int place) {
  return std::ranges::count(key, place, &Choice::place) > 0;
}

}  // namespace

Version::Version(const Stage& stageOf, WorldKey keyOf, const swept::Checker& checkerOf)
    : stage(stageOf),
      key(std::move(keyOf)),
      checker(std::make_shared<const swept::Checker>(checkerOf)),
      information(std::make_shared<ompl::base::SpaceInformation>(stage.space())),
      validity(information, checker),
      motions(information, checker) {}

WorldLine::WorldLine(const Stage& stage, std::uint64_t seed) : stage_(stage), random_(seed) {
  for (Earlier& earlier : earlier_) {
    while (static_cast<int>(earlier.key.size()) < (kFewest + kMost) / 2) {
      const Choice choice{uniform(stage.places()), uniform(Stage::kForms)};
      if (!taken(earlier.key, choice.place)) earlier.key.push_back(choice);
    }
    earlier.world = std::make_shared<const swept::World>(stage.worldOf(earlier.key));
  }
  publish(earlier_[0].key, stage.empty().withWorld(earlier_[0].world));
}

std::shared_ptr<const Version> WorldLine::current() const {
  const std::lock_guard lock(mutex_);
  return current_;
}

void WorldLine::publish(WorldKey key, const swept::Checker& checker) {
  std::shared_ptr<const Version> next =
      std::make_shared<const Version>(stage_, std::move(key), checker);
  const std::lock_guard lock(mutex_);
  current_.swap(next);  // the last one may end its life outside of the lock
}

void WorldLine::update() {
  const std::shared_ptr<const Version> from = current();
  const int bodies = static_cast<int>(from->key.size());
  const int kind = uniform(10);
  if (kind < 3 && bodies < kMost)
    add(*from);
  else if (kind < 6 && bodies > kFewest)
    remove(*from);
  else if (kind < 9)
    replace(*from);
  else
    goBack(*from);
  if (uniform(16) != 0) return;
  const std::shared_ptr<const Version> now = current();
  earlier_[uniform(static_cast<int>(earlier_.size()))] = {
      now->key, std::make_shared<const swept::World>(now->checker->world())};
}

void WorldLine::add(const Version& from) {
  Choice choice{uniform(stage_.places()), uniform(Stage::kForms)};
  while (taken(from.key, choice.place)) choice.place = (choice.place + 1) % stage_.places();
  WorldKey key = from.key;
  key.push_back(choice);
  publish(std::move(key), from.checker->withBody(stage_.body(choice)));
  ++counts_.added;
}

void WorldLine::remove(const Version& from) {
  WorldKey key = from.key;
  const int i = uniform(static_cast<int>(key.size()));
  const std::string& name = stage_.body(key[i]).name;
  key.erase(key.begin() + i);
  publish(std::move(key), from.checker->withoutBody(name));
  ++counts_.removed;
}

void WorldLine::replace(const Version& from) {
  WorldKey key = from.key;
  Choice& choice = key[uniform(static_cast<int>(key.size()))];
  choice.form = (choice.form + 1 + uniform(Stage::kForms - 1)) % Stage::kForms;
  const swept::WorldBody& body = stage_.body(choice);
  publish(std::move(key), from.checker->withReplaced(body));
  ++counts_.replaced;
}

/// From the version so far, or from that of the empty world: the answers have to be the same.
void WorldLine::goBack(const Version& from) {
  const Earlier& earlier = earlier_[uniform(static_cast<int>(earlier_.size()))];
  const swept::Checker& base = uniform(2) == 0 ? *from.checker : stage_.empty();
  publish(earlier.key, base.withWorld(earlier.world));
  ++counts_.returned;
}

}  // namespace soak
