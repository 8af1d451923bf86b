// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "spheres/named_bodies.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/sphere_model.hpp"
#include "threads/for_each_index.hpp"

namespace swept {
namespace {

/// Bodies (links), and how many spheres each has.
class SphereShares {
 public:
  SphereShares(std::span<const NamedBody> bodies, const SphereModelOptions& options)
      : options_(options), links_(bodies) {
    searches_.resize(links_.size());
    found_.resize(links_.size());
    forLinks([&](std::size_t i) {
      searches_[i] =
          std::make_unique<EnclosingSpheresSearch>(links_[i].shapes, options_.search, isOver_);
    });
  }

  void findWithin(double excess) {
    forLinks([&](std::size_t i) { found_[i] = searches_[i]->within(excess, isOver_); });
  }

  void findAtMost(int spheres) {
    std::vector<int> counts = countsFor(spheres);
    forLinks([&](std::size_t i) { found_[i] = searches_[i]->atMost(counts[i], isOver_); });
    giveRest(spheres, counts);
    exchange(counts);
    searchAgain(counts);
  }

  SphereModel model() && {
    SphereModel model;
    for (std::size_t i = 0; i < links_.size(); ++i)
      model.links.push_back({links_[i].name, std::move(found_[i].spheres)});
    return model;
  }

 private:
  void forLinks(const std::function<void(std::size_t)>& work) {
    detail::forEachIndex(links_.size(), options_.threads, [&](std::size_t i) {
      if (isOver_()) throw SearchStopped();
      work(i);
    });
  }

  /// One reach for all links: nearly the least that so many spheres allow.
  std::vector<int> countsFor(int spheres) {
    std::vector<int> best(links_.size(), 1);
    double low = 0.0;
    double high = 0.0;
    for (const NamedBody& link : links_)
      for (const PosedShape& posed : link.shapes)
        high = std::max(high, 2.0 * boundingSphere(posed.shape).radius);
    for (int step = 0; step < 12 && high > 0.0; ++step) {
      const double reach =
          step < 6 ? std::sqrt(std::max(low, 1e-3 * high) * high) : 0.5 * (low + high);
      std::vector<int> counts(links_.size());
      forLinks([&](std::size_t i) { counts[i] = std::max(1, searches_[i]->countFor(reach)); });
      if (std::accumulate(counts.begin(), counts.end(), 0) <= spheres) {
        best = std::move(counts);
        high = reach;
      } else {
        low = reach;
      }
    }
    return best;
  }

  /// To those links that reach farthest, several at a time.
  void giveRest(int spheres, std::vector<int>& counts) {
    std::vector<bool> isFull(links_.size(), false);
    for (;;) {
      const auto rest =
          static_cast<std::size_t>(spheres - std::accumulate(counts.begin(), counts.end(), 0));
      std::vector<std::size_t> takers;
      for (std::size_t i = 0; i < links_.size(); ++i)
        if (!isFull[i]) takers.push_back(i);
      std::ranges::stable_sort(takers, std::ranges::greater{},
                               [&](std::size_t i) { return found_[i].reach; });
      takers.resize(std::min({takers.size(), rest, links_.size() / 4 + 1}));
      if (takers.empty()) return;
      detail::forEachIndex(takers.size(), options_.threads, [&](std::size_t k) {
        const std::size_t i = takers[k];
        EnclosingSpheres more = searches_[i]->atMost(counts[i] + 1, isOver_);
        if (more.reach < found_[i].reach) found_[i] = std::move(more);
      });
      for (const std::size_t i : takers) {
        ++counts[i];
        isFull[i] = static_cast<int>(found_[i].spheres.size()) + 1 < counts[i];
      }
    }
  }

  /// From the link that would reach least without one of its spheres to the one that reaches
  /// farthest, while the farther of both comes nearer.
  void exchange(std::vector<int>& counts) {
    constexpr int kMostExchanges = 12;
    std::vector<std::optional<EnclosingSpheres>> fewer(links_.size());
    for (int step = 0; step < kMostExchanges && links_.size() > 1; ++step) {
      forLinks([&](std::size_t i) {
        if (counts[i] > 1 && !fewer[i]) fewer[i] = searches_[i]->atMost(counts[i] - 1, isOver_);
      });
      std::size_t to = 0;
      for (std::size_t i = 1; i < links_.size(); ++i)
        if (found_[i].reach > found_[to].reach) to = i;
      std::optional<std::size_t> from;
      for (std::size_t i = 0; i < links_.size(); ++i)
        if (i != to && fewer[i] && (!from || fewer[i]->reach < fewer[*from]->reach)) from = i;
      if (!from || !(fewer[*from]->reach < found_[to].reach)) return;
      EnclosingSpheres more = searches_[to]->atMost(counts[to] + 1, isOver_);
      if (!(more.reach < found_[to].reach)) return;
      found_[to] = std::move(more);
      found_[*from] = std::move(*fewer[*from]);
      ++counts[to];
      --counts[*from];
      fewer[to].reset();
      fewer[*from].reset();
    }
  }

  /// The links that reach farthest, as long as that brings them nearer.
  void searchAgain(const std::vector<int>& counts) {
    const std::size_t most = std::min<std::size_t>(links_.size(), 6);
    for (std::size_t step = 0; step < most; ++step) {
      std::size_t worst = 0;
      for (std::size_t i = 1; i < links_.size(); ++i)
        if (found_[i].reach > found_[worst].reach) worst = i;
      EnclosingSpheres again = searches_[worst]->atMost(counts[worst], isOver_);
      if (!(again.reach < found_[worst].reach)) return;
      found_[worst] = std::move(again);
    }
  }

  const SphereModelOptions& options_;
  StopQuestion isOver_ = [this] { return options_.stop.stop_requested(); };
  std::span<const NamedBody> links_;
  std::vector<std::unique_ptr<EnclosingSpheresSearch>> searches_;
  std::vector<EnclosingSpheres> found_;
};

}  // namespace

const LinkSpheres* SphereModel::find(std::string_view link) const {
  const auto found = std::ranges::find(links, link, &LinkSpheres::link);
  return found == links.end() ? nullptr : &*found;
}

std::size_t SphereModel::count() const {
  std::size_t count = 0;
  for (const LinkSpheres& link : links) count += link.spheres.size();
  return count;
}

SphereModel enclosingSphereModel(const Robot& robot, const SphereModelOptions& options) {
  const std::vector<NamedBody> bodies = bodiesOf(robot);
  if (!options.excess && options.spheres.value_or(0) > 0)
    detail::requireEnough(options.spheres, "spheres", robot, bodies.size());
  return enclosingSphereModel(bodies, options);
}

SphereModel enclosingSphereModel(std::span<const NamedBody> bodies,
                                 const SphereModelOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return enclosingSphereModel(bodies, options); });
  if (options.spheres.has_value() == options.excess.has_value())
    throw std::invalid_argument("a sphere model takes a number of spheres or an excess");
  if (options.spheres && *options.spheres < 1)
    throw std::invalid_argument("a sphere model has " + std::to_string(*options.spheres) +
                                " spheres; allowed: at least 1");
  if (options.excess && !(*options.excess > 0.0))
    throw std::invalid_argument("a sphere model has an excess of " +
                                std::to_string(*options.excess) + "; allowed: above 0");
  detail::requireBodies(bodies);
  detail::requireEnough(options.spheres, "spheres", bodies.size());
  SphereShares shares(bodies, options);
  if (options.excess)
    shares.findWithin(*options.excess);
  else
    shares.findAtMost(*options.spheres);
  return std::move(shares).model();
}

std::vector<LinkSphereReport> judgeSphereModel(const Robot& robot, const SphereModel& model,
                                               const OutsideSpheresOptions& options,
                                               unsigned threads) {
  return judgeSphereModel(bodiesOf(robot), model, options, threads);
}

std::vector<LinkSphereReport> judgeSphereModel(std::span<const NamedBody> bodies,
                                               const SphereModel& model,
                                               const OutsideSpheresOptions& options,
                                               unsigned threads) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return judgeSphereModel(bodies, model, options, threads); });
  detail::requireBodies(bodies);
  std::vector<LinkSphereReport> reports(bodies.size());
  detail::forEachIndex(bodies.size(), threads, [&](std::size_t i) {
    if (options.stop && options.stop()) throw SearchStopped();
    LinkSphereReport& report = reports[i];
    report.link = bodies[i].name;
    const std::vector<PosedShape>& body = bodies[i].shapes;
    const LinkSpheres* own = model.find(report.link);
    std::vector<EnclosingSphere> spheres;
    if (own != nullptr) spheres = own->spheres;
    report.spheres = spheres.size();
    report.outside = outsideSpheres(body, spheres, options);
    for (EnclosingSphere& sphere : spheres) sphere.radius += std::max(0.0, report.outside.upper);
    report.excess = sphereExcess(body, spheres, {.stop = options.stop});
  });
  return reports;
}

}  // namespace swept
