// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/shape_model.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "spheres/named_bodies.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "threads/for_each_index.hpp"

namespace swept {
namespace {

/// Bodies (links), and how many shapes each has: a search has the answer for every number.
class ShapeShares {
 public:
  ShapeShares(std::span<const NamedBody> bodies, const ShapeModelOptions& options)
      : options_(options), links_(bodies) {
    searches_.resize(links_.size());
    found_.resize(links_.size());
    forLinks([&](std::size_t i) {
      searches_[i] = std::make_unique<EnclosingShapesSearch>(links_[i].shapes, options_.kind,
                                                             options_.search, isOver_);
    });
  }

  void findWithin(double excess) {
    forLinks([&](std::size_t i) { found_[i] = searches_[i]->within(excess, isOver_); });
  }

  void findAtMost(int shapes) {
    const std::vector<int> counts = countsFor(shapes);
    forLinks([&](std::size_t i) { found_[i] = searches_[i]->atMost(counts[i], isOver_); });
  }

  ShapeModel model() && {
    ShapeModel model;
    for (std::size_t i = 0; i < links_.size(); ++i)
      model.links.push_back({links_[i].name, std::move(found_[i].shapes)});
    return model;
  }

 private:
  void forLinks(const std::function<void(std::size_t)>& work) {
    detail::forEachIndex(links_.size(), options_.threads, [&](std::size_t i) {
      if (isOver_()) throw SearchStopped();
      work(i);
    });
  }

  /// One more at a time, for the link that reaches farthest, unless that does not bring it nearer
  /// however many are left.
  std::vector<int> countsFor(int shapes) const {
    std::vector<int> counts(links_.size(), 1);
    std::vector<double> reaches(links_.size());
    for (std::size_t i = 0; i < links_.size(); ++i) reaches[i] = searches_[i]->reachFor(1);
    std::vector<bool> isFull(links_.size(), false);
    int left = shapes - static_cast<int>(links_.size());
    while (left > 0) {
      std::size_t worst = links_.size();
      for (std::size_t i = 0; i < links_.size(); ++i)
        if (!isFull[i] && (worst == links_.size() || reaches[i] > reaches[worst])) worst = i;
      if (worst == links_.size()) break;
      const auto [more, reach] = nearer(worst, counts[worst], reaches[worst], left);
      isFull[worst] = more == 0;
      counts[worst] += more;
      left -= more;
      reaches[worst] = reach;
    }
    return counts;
  }

  /// How many more shapes bring the link nearer, and how near; 0: none of so many.
  std::pair<int, double> nearer(std::size_t link, int count, double reach, int most) const {
    constexpr int kMostMore = 16;
    for (int more = 1; more <= std::min(most, kMostMore); ++more)
      if (const double now = searches_[link]->reachFor(count + more); now < reach)
        return {more, now};
    return {0, reach};
  }

  const ShapeModelOptions& options_;
  StopQuestion isOver_ = [this] { return options_.stop.stop_requested(); };
  std::span<const NamedBody> links_;
  std::vector<std::unique_ptr<EnclosingShapesSearch>> searches_;
  std::vector<EnclosingShapes> found_;
};

}  // namespace

const LinkShapes* ShapeModel::find(std::string_view link) const {
  const auto found = std::ranges::find(links, link, &LinkShapes::link);
  return found == links.end() ? nullptr : &*found;
}

std::size_t ShapeModel::count() const {
  std::size_t count = 0;
  for (const LinkShapes& link : links) count += link.shapes.size();
  return count;
}

ShapeModel shapeModelOf(const SphereModel& model) {
  ShapeModel shapes;
  for (const LinkSpheres& link : model.links) {
    LinkShapes& own = shapes.links.emplace_back(LinkShapes{link.link, {}});
    for (const EnclosingSphere& sphere : link.spheres)
      own.shapes.push_back(
          {Sphere{sphere.radius}, Eigen::Isometry3d(Eigen::Translation3d(sphere.center))});
  }
  return shapes;
}

std::optional<SphereModel> sphereModelOf(const ShapeModel& model) {
  SphereModel spheres;
  for (const LinkShapes& link : model.links) {
    LinkSpheres& own = spheres.links.emplace_back(LinkSpheres{link.link, {}});
    for (const PosedShape& posed : link.shapes) {
      const auto* sphere = std::get_if<Sphere>(&posed.shape);
      if (sphere == nullptr) return {};
      own.spheres.push_back({posed.body_from_shape.translation(), sphere->radius});
    }
  }
  return spheres;
}

ShapeModel enclosingShapeModel(const Robot& robot, const ShapeModelOptions& options) {
  const std::vector<NamedBody> bodies = bodiesOf(robot);
  if (!options.excess && options.shapes.value_or(0) > 0)
    detail::requireEnough(options.shapes, "shapes", robot, bodies.size());
  return enclosingShapeModel(bodies, options);
}

ShapeModel enclosingShapeModel(std::span<const NamedBody> bodies,
                               const ShapeModelOptions& options) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return enclosingShapeModel(bodies, options); });
  if (options.shapes.has_value() == options.excess.has_value())
    throw std::invalid_argument("a model takes a number of shapes or an excess");
  if (options.shapes && *options.shapes < 1)
    throw std::invalid_argument("a model has " + std::to_string(*options.shapes) +
                                " shapes; allowed: at least 1");
  if (options.excess && !(*options.excess > 0.0))
    throw std::invalid_argument("a model has an excess of " + std::to_string(*options.excess) +
                                "; allowed: above 0");
  detail::requireBodies(bodies);
  detail::requireEnough(options.shapes, "shapes", bodies.size());
  ShapeShares shares(bodies, options);
  if (options.excess)
    shares.findWithin(*options.excess);
  else
    shares.findAtMost(*options.shapes);
  return std::move(shares).model();
}

std::vector<LinkSphereReport> judgeShapeModel(const Robot& robot, const ShapeModel& model,
                                              const OutsideSpheresOptions& options,
                                              unsigned threads) {
  return judgeShapeModel(bodiesOf(robot), model, options, threads);
}

std::vector<LinkSphereReport> judgeShapeModel(std::span<const NamedBody> bodies,
                                              const ShapeModel& model,
                                              const OutsideSpheresOptions& options,
                                              unsigned threads) {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return judgeShapeModel(bodies, model, options, threads); });
  detail::requireBodies(bodies);
  std::vector<LinkSphereReport> reports(bodies.size());
  detail::forEachIndex(bodies.size(), threads, [&](std::size_t i) {
    if (options.stop && options.stop()) throw SearchStopped();
    LinkSphereReport& report = reports[i];
    report.link = bodies[i].name;
    const std::vector<PosedShape>& body = bodies[i].shapes;
    std::vector<PosedShape> shapes;
    if (const LinkShapes* own = model.find(report.link)) shapes = own->shapes;
    report.spheres = shapes.size();
    report.outside = outsideShapes(body, shapes, options);
    const double growth = shapes.empty() ? 0.0 : std::max(0.0, report.outside.upper);
    // Shapes without an inside grow to no size that contains anything.
    report.excess = std::isfinite(growth)
                        ? shapesExcess(body, shapes, growth, {.stop = options.stop})
                        : SphereExcess{growth, growth, growth, growth};
  });
  return reports;
}

}  // namespace swept
