// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/State.h>
#include <ompl/datastructures/NearestNeighbors.h>
#include <ompl/datastructures/NearestNeighborsGNAT.h>
#include <ompl/util/Exception.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "swept/core/floating_point_environment.hpp"

namespace ompl::base {
class Planner;
}

namespace swept {

namespace detail {

/// States of one space of limited joints, by numbers that the caller gives them.
class JointTree {
 public:
  /// Told of the states that may be near enough.
  class Candidates {
   public:
    /// Returns the distance from which on states are of no interest any more.
    virtual double consider(std::uint32_t index) = 0;

   protected:
    ~Candidates() = default;
  };

  JointTree();
  ~JointTree();

  void clear();
  /// False, and nothing has happened, for a state that makeStateSpace's space of a group of limited
  /// joints has not made, or another one than the space of those before.
  bool add(const ompl::base::State* state, std::uint32_t index);
  /// The values have to be those that were added.
  void remove(const ompl::base::State* state, std::uint32_t index);
  /// Offers all that are nearer than what `consider` returned last, at first `within`, and a few
  /// more. False, and nothing is offered, for a state of another space.
  bool search(const ompl::base::State* state, double within, Candidates& candidates) const;
  /// Adds those that may be the nearest one, in single precision: mostly it alone. False, and
  /// nothing is added, for a state of another space.
  bool nearest(const ompl::base::State* state, std::vector<std::uint32_t>& nearest) const;

 private:
  class Cells;
  bool holds(const ompl::base::State* state) const;

  std::unique_ptr<Cells> cells_;
};

}  // namespace detail

/// Nearest neighbours for OMPL's planners, several times as fast as OMPL's own for groups whose
/// joints all have limits, up to large trees:
///
///     swept::useNearestStates(*planner);
///
/// before the planner's tree has grown. Answers are exact: those of the planner's distance
/// function, sorted; of states that are equally near any. For states of other spaces, and for what
/// has no `state` (the vertices of PRM), it is OMPL's NearestNeighborsGNAT. Threads may ask at the
/// same time while none adds or removes.
///
/// A k-d tree (Bentley, Multidimensional binary search trees, CACM 1975) whose leaves hold many
/// states and are looked through in SIMD lanes, in single precision with a bound on its error; the
/// distance function decides about the few that may be the nearest.
template <typename T>
class NearestStates : public ompl::NearestNeighbors<T> {
 public:
  /// Distance of two elements.
  using DistanceFunction = typename ompl::NearestNeighbors<T>::DistanceFunction;

  /// The metric of the planner's space; call it before anything is added.
  void setDistanceFunction(const DistanceFunction& distance) override {
    ompl::NearestNeighbors<T>::setDistanceFunction(distance);
    if (others_) others_->setDistanceFunction(distance);
  }

  /// True: nearest first.
  bool reportsSortedResults() const override { return true; }

  /// Forgets all elements, and what kind of states they had.
  void clear() override {
    tree_.clear();
    items_.clear();
    unused_.clear();
    others_.reset();
  }

  using ompl::NearestNeighbors<T>::add;
  /// Its state must not change until it is removed.
  void add(const T& data) override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return NearestStates::add(data); });
    }
    if (others_ == nullptr && place(data)) return;
    if (others_ == nullptr) useOthers();
    others_->add(data);
  }

  /// False: it is not there.
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

  /// Throws ompl::Exception when there is none.
  T nearest(const T& data) const override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&] { return NearestStates::nearest(data); });
    }
    if (others_) return others_->nearest(data);
    if (size() == 0) throw ompl::Exception("No elements found in nearest neighbors data structure");
    if constexpr (kHasState) {
      std::vector<std::uint32_t> nearest;
      if (tree_.nearest(data->state, nearest)) return *items_[nearestOf(nearest, data)];
    }
    return *items_[closest(data, 1, kAnywhere).front().second];
  }

  /// The k nearest, or all if there are fewer; instead of what is in `found`.
  void nearestK(const T& data, std::size_t k, std::vector<T>& found) const override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment([&, k] { return NearestStates::nearestK(data, k, found); });
    }
    if (others_) return others_->nearestK(data, k, found);
    found.clear();
    if (k > 0) collect(closest(data, k, kAnywhere), found);
  }

  /// Those not farther than `radius`, in the metric; instead of what is in `found`.
  void nearestR(const T& data, double radius, std::vector<T>& found) const override {
    if (detail::inForeignEnvironment()) {
      return inDefaultEnvironment(
          [&, radius] { return NearestStates::nearestR(data, radius, found); });
    }
    if (others_) return others_->nearestR(data, radius, found);
    found.clear();
    collect(closest(data, items_.size(), radius), found);
  }

  /// Elements that are there.
  std::size_t size() const override {
    return others_ ? others_->size() : items_.size() - unused_.size();
  }

  /// All elements, in no particular order; instead of what is in `all`.
  void list(std::vector<T>& all) const override {
    if (others_) return others_->list(all);
    all.clear();
    for (const std::optional<T>& item : items_) {
      if (item) all.push_back(*item);
    }
  }

 private:
  static constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  static constexpr bool kHasState = requires(const T& data) {
    static_cast<const ompl::base::State*>(data->state);
  };
  using Found = std::vector<std::pair<double, std::uint32_t>>;  ///< distances, and of which items

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

  /// The distance function is not asked where there is no choice.
  std::uint32_t nearestOf(const std::vector<std::uint32_t>& candidates, const T& data) const {
    std::uint32_t nearest = candidates.front();
    if (candidates.size() == 1) return nearest;
    double least = kAnywhere;
    for (const std::uint32_t index : candidates) {
      const double distance = this->distFun_(*items_[index], data);
      if (distance < least) least = distance, nearest = index;
    }
    return nearest;
  }

  /// k > 0.
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
  std::vector<std::uint32_t> unused_;                  ///< of the numbers
  std::unique_ptr<ompl::NearestNeighbors<T>> others_;  ///< instead, for other states
};

/// Gives a planner these nearest neighbours where OMPL lets it have others than its own and they
/// help. Its tree is cleared. False, and nothing has happened, for all others.
///
/// Done: RRT, RRTConnect, RRTstar, InformedRRTstar, SORRTstar, LazyRRT, LBTRRT, LazyLBTRRT, BiTRRT,
/// pRRT, and what derives from these. RRTXstatic and RRTsharp, too, once they have their problem
/// definition, which OMPL wants first.
///
/// Not done: BITstar, ABITstar and AITstar, whose setNearestNeighbors is in none of OMPL's
/// libraries, so that a program that calls it does not link (seen with 1.5.2). PRM, LazyPRM, SPARS
/// and SPARStwo, whose vertices have no `state`; and of these, those that were given others before
/// setup() never tell them the metric, so that a query throws std::bad_function_call. TRRT, which
/// asks for the size of a tree that it does not have yet. SST, and planners that take no others.
bool useNearestStates(ompl::base::Planner& planner);

}  // namespace swept
