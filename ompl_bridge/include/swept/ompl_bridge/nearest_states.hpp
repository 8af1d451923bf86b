// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/State.h>
#include <ompl/datastructures/NearestNeighbors.h>
#include <ompl/datastructures/NearestNeighborsGNAT.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "swept/core/floating_point_environment.hpp"

namespace ompl::base {
class Planner;
}

namespace swept {

namespace detail {

/// States of one space of limited joints, with numbers that the caller gives them.
class JointTree {
 public:
  /// Receives the states that may be near enough.
  class Candidates {
   public:
    /// Returns the distance from which on states do not matter any more.
    virtual double consider(std::uint32_t index) = 0;

   protected:
    ~Candidates() = default;
  };

  JointTree();
  ~JointTree();

  /// Of joints, beside their weights in the distance; none: 1. Before a state is added.
  void setFactors(std::vector<double> factors);
  /// Forgets the states.
  void clear();
  /// Adds a state. Returns false, and changes nothing, for a state that is not from
  /// makeStateSpace's space of a group of limited joints, or of as many as there are factors, or
  /// from another space than the states before.
  bool add(const ompl::base::State* state, std::uint32_t index);
  /// Removes a state. Its values must be those that were added.
  void remove(const ompl::base::State* state, std::uint32_t index);
  /// Offers all states nearer than the last return value of `consider`, at first `within`, and a
  /// few more. Returns false, and offers nothing, for a state of another space.
  bool search(const ompl::base::State* state, double within, Candidates& candidates) const;
  /// Writes the states that may be the nearest, in single precision: usually one. Returns their
  /// number, 0 for a state of another space and if there are more than fit.
  std::size_t nearest(const ompl::base::State* state, std::span<std::uint32_t> nearest) const;

 private:
  class Cells;
  bool holds(const ompl::base::State* state) const;

  std::vector<double> factors_;
  std::unique_ptr<Cells> cells_;
};

}  // namespace detail

/// Nearest neighbours for OMPL's planners, several times as fast as OMPL's own for groups whose
/// joints all have limits, up to large trees. Call
///
///     swept::useNearestStates(*planner);
///
/// before the planner's tree has grown. Answers are exact: those of the planner's distance
/// function, sorted; among states that are equally near, any. For states of other spaces, and for
/// elements without a `state` (the vertices of PRM), it uses OMPL's NearestNeighborsGNAT. Several
/// threads may query at the same time while none adds or removes.
///
/// It is a k-d tree (Bentley, Multidimensional binary search trees, CACM 1975). Its leaves hold
/// many states and are scanned in SIMD lanes, in single precision with a bound on its error. The
/// distance function decides about the few that may be the nearest.
template <typename T>
class NearestStates : public ompl::NearestNeighbors<T> {
 public:
  /// Distance of two elements.
  using DistanceFunction = typename ompl::NearestNeighbors<T>::DistanceFunction;

  /// Sets the metric of the planner's space; call it before anything is added.
  void setDistanceFunction(const DistanceFunction& distance) override {
    ompl::NearestNeighbors<T>::setDistanceFunction(distance);
    if (others_) others_->setDistanceFunction(distance);
  }

  /// For a distance function that is the metric of the space with the joints' differences
  /// multiplied by these factors (> 0), one for each joint; call it before anything is added. For
  /// spaces of others it changes nothing.
  void setJointFactors(std::vector<double> factors) { tree_.setFactors(std::move(factors)); }

  /// Always true: nearest first.
  bool reportsSortedResults() const override { return true; }

  /// Forgets all elements, and the kind of their states.
  void clear() override {
    tree_.clear();
    items_.clear();
    unused_.clear();
    others_.reset();
  }

  using ompl::NearestNeighbors<T>::add;
  /// Adds an element. Its state must not change until it is removed.
  void add(const T& data) override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return NearestStates::add(data); });
    }
    if (others_ == nullptr && place(data)) return;
    if (others_ == nullptr) useOthers();
    others_->add(data);
  }

  /// Removes an element. Returns false if it is not there.
  bool remove(const T& data) override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return NearestStates::remove(data); });
    }
    if (others_) return others_->remove(data);
    for (const auto& [distance, index] : closest(data, items_.size(), 0.0)) {
      if (*items_[index] != data) continue;
      if constexpr (kHasState) tree_.remove(data->state, index);
      items_[index].reset();
      unused_.push_back(index);
      return true;
    }
    return false;
  }

  /// The nearest element. Throws ompl::Exception if there is none.
  T nearest(const T& data) const override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return NearestStates::nearest(data); });
    }
    if (others_) return others_->nearest(data);
    if (size() == 0) throw ompl::Exception("No elements found in nearest neighbors data structure");
    if constexpr (kHasState) {
      std::array<std::uint32_t, kUsual> nearest;
      const std::size_t count = tree_.nearest(data->state, nearest);
      if (count > 0) return *items_[nearestOf(std::span(nearest).first(count), data)];
    }
    return *items_[closest(data, 1, kAnywhere).front().second];
  }

  /// Replaces `found` by the k nearest elements, or all if there are fewer.
  void nearestK(const T& data, std::size_t k, std::vector<T>& found) const override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&, k] { return NearestStates::nearestK(data, k, found); });
    }
    if (others_) return others_->nearestK(data, k, found);
    found.clear();
    if (k > 0) collect(closest(data, k, kAnywhere), found);
  }

  /// Replaces `found` by the elements not farther than `radius`, in the metric.
  void nearestR(const T& data, double radius, std::vector<T>& found) const override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment(
          [&, radius] { return NearestStates::nearestR(data, radius, found); });
    }
    if (others_) return others_->nearestR(data, radius, found);
    found.clear();
    collect(closest(data, items_.size(), radius), found);
  }

  /// Number of elements.
  std::size_t size() const override {
    return others_ ? others_->size() : items_.size() - unused_.size();
  }

  /// Replaces `all` by all elements, in no particular order.
  void list(std::vector<T>& all) const override {
    if (others_) return others_->list(all);
    all.clear();
    for (const std::optional<T>& item : items_) {
      if (item) all.push_back(*item);
    }
  }

 private:
  static constexpr std::size_t kUsual = 16;  ///< most states that may be the nearest
  static constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  static constexpr bool kHasState = requires(const T& data) {
    static_cast<const ompl::base::State*>(data->state);
  };
  using Found = std::vector<std::pair<double, std::uint32_t>>;  ///< distances and item numbers

  /// The k nearest within a radius, as a heap with the farthest on top.
  class Closest final : public detail::JointTree::Candidates {
   public:
    Closest(const NearestStates& all, const T& query, std::size_t k, double radius)
        : all_(all), query_(query), k_(k), radius_(radius) {}

    double consider(std::uint32_t index) override {
      const double distance = all_.distFun_(*all_.items_[index], query_);
      if (distance > radius_) return radius_;
      found_.emplace_back(distance, index);
      std::ranges::push_heap(found_);
      if (found_.size() > k_) {
        std::ranges::pop_heap(found_);
        found_.pop_back();
      }
      return found_.size() < k_ ? radius_ : found_.front().first;
    }

    Found sorted() {
      std::ranges::sort_heap(found_);
      return std::move(found_);
    }

   private:
    const NearestStates& all_;
    const T& query_;
    std::size_t k_;
    double radius_;
    Found found_;
  };

  /// The nearest of the candidates. Does not call the distance function if there is only one.
  std::uint32_t nearestOf(std::span<const std::uint32_t> candidates, const T& data) const {
    std::uint32_t nearest = candidates.front();
    if (candidates.size() == 1) return nearest;
    double least = kAnywhere;
    for (const std::uint32_t index : candidates) {
      const double distance = this->distFun_(*items_[index], data);
      if (distance < least) least = distance, nearest = index;
    }
    return nearest;
  }

  /// The k nearest elements within the radius; k > 0.
  Found closest(const T& data, std::size_t k, double radius) const {
    Closest closest(*this, data, k, radius);
    if constexpr (kHasState) {
      if (tree_.search(data->state, radius, closest)) return closest.sorted();
    }
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
      if (items_[i]) closest.consider(i);
    }
    return closest.sorted();
  }

  void collect(const Found& closest, std::vector<T>& found) const {
    for (const auto& [distance, index] : closest) found.push_back(*items_[index]);
  }

  bool place(const T& data) {
    if constexpr (kHasState) {
      const auto index =
          unused_.empty() ? static_cast<std::uint32_t>(items_.size()) : unused_.back();
      if (!tree_.add(data->state, index)) return false;
      if (unused_.empty()) {
        items_.emplace_back(data);
      } else {
        items_[index] = data;
        unused_.pop_back();
      }
      return true;
    }
    return false;
  }

  void useOthers() {
    std::vector<T> all;
    list(all);
    clear();
    others_ = std::make_unique<ompl::NearestNeighborsGNAT<T>>();
    others_->setDistanceFunction(this->distFun_);
    others_->add(all);
  }

  detail::JointTree tree_;
  std::vector<std::optional<T>> items_;                ///< by their numbers in the tree
  std::vector<std::uint32_t> unused_;                  ///< unused numbers
  std::unique_ptr<ompl::NearestNeighbors<T>> others_;  ///< used instead for other states
};

/// Gives a planner these nearest neighbours, if OMPL accepts others than its own and they help.
/// Clears the planner's tree. Returns false, and changes nothing, for all other planners.
///
/// Supported: RRT, RRTConnect, RRTstar, InformedRRTstar, SORRTstar, LazyRRT, LBTRRT, LazyLBTRRT,
/// BiTRRT, pRRT, and derived planners. RRTXstatic and RRTsharp, too, once they have their problem
/// definition, which OMPL needs first.
///
/// Not supported: BITstar, ABITstar and AITstar, whose setNearestNeighbors is in none of OMPL's
/// libraries, so a program that calls it does not link (seen with 1.5.2). PRM, LazyPRM, SPARS and
/// SPARStwo, whose vertices have no `state`; if they are given other nearest neighbours before
/// setup(), some never set the metric, and a query throws std::bad_function_call. TRRT, which asks
/// for the size of a tree that does not exist yet. SST, and planners that accept no others.
bool useNearestStates(ompl::base::Planner& planner);

}  // namespace swept
