// SPDX-License-Identifier: BSD-3-Clause
#include "joint_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "squared_distances.hpp"

namespace swept::detail {
namespace {

constexpr std::size_t kLeaf = 256;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kMost = std::numeric_limits<float>::max();
constexpr double kFarthestValue = 1e18;  // its square is a float

const double* valuesOf(const ompl::base::State* state) {
  return state->as<JointSpace::StateType>()->values;
}

float squaredToBox(const std::vector<float>& box, const float* point) {
  const std::size_t dimension = box.size() / 2;
  float sum = 0.0F;
  for (std::size_t d = 0; d < dimension; ++d) {
    const float below = box[d] - point[d], above = point[d] - box[dimension + d];
    const float outside = std::max(std::max(below, above), 0.0F);
    sum += outside * outside;
  }
  return sum;
}

}  // namespace

/// From the leaf with the point outwards.
class JointTree::Cells::Walk {
 public:
  Walk(const Cells& tree, const double* values) : tree_(tree), point_(tree.weighted(values)) {
    float largest = tree.largest_;
    for (const float x : point_) largest = std::max(largest, std::abs(x));
    // Each coordinate is rounded once, their differences, squares and sum once more.
    constexpr double kUlp = std::numeric_limits<float>::epsilon();
    const auto dimension = static_cast<double>(point_.size());
    absolute_ = kUlp * std::sqrt(dimension) * static_cast<double>(largest);
    relative_ = 1.0 + kUlp * (dimension + 8.0);
  }

 protected:
  ~Walk() = default;

  void run() {
    const Cell& root = tree_.cells_[0];
    if (root.children == 0) return lookInto(root);
    visit(0, squaredToBox(root.box, point_.data()));
  }

  /// No point nearer than `distance` has a squared distance above this.
  float limitOf(double distance) const {
    const double most = (distance + absolute_) * relative_;
    const double squared = most * most * relative_;
    return squared < static_cast<double>(kMost) ? static_cast<float>(squared) : kMost;
  }

  /// For a point with this squared distance: the nearest point has none above.
  float limitOfNearest(float squared) const {
    return limitOf(std::sqrt(static_cast<double>(squared)) * relative_ + absolute_);
  }

  float limit_ = kMost;

 private:
  /// For points of a leaf, with their squared distances in whole blocks. `least`: the least of
  /// them.
  virtual void look(std::span<const std::uint32_t> indices, const float* squared, float least) = 0;

  void visit(std::size_t index, float squared) {
    if (!(squared <= limit_)) return;
    const Cell& cell = tree_.cells_[index];
    if (cell.children == 0) return lookInto(cell);
    const std::size_t first = cell.children, second = first + 1;
    const float toFirst = squaredToBox(tree_.cells_[first].box, point_.data());
    const float toSecond = squaredToBox(tree_.cells_[second].box, point_.data());
    const bool below =
        toFirst < toSecond ||
        (toFirst == toSecond && point_[static_cast<std::size_t>(cell.axis)] < cell.middle);
    visit(below ? first : second, below ? toFirst : toSecond);
    visit(below ? second : first, below ? toSecond : toFirst);
  }

  void lookInto(const Cell& leaf) {
    const std::size_t all = leaf.indices.size();
    for (std::size_t first = 0; first < all; first += kLeaf) {
      const std::size_t count = std::min(kLeaf, all - first);
      const float least = squaredDistances(leaf.blocks.data() + first * point_.size(), count,
                                           point_.data(), point_.size(), squared_.data());
      if (least <= limit_) {
        look(std::span(leaf.indices).subspan(first, count), squared_.data(), least);
      }
    }
  }

  const Cells& tree_;
  Point point_;
  std::array<float, kLeaf> squared_;
  double absolute_ = 0.0, relative_ = 1.0;
};

class JointTree::Cells::Search final : Walk {
 public:
  Search(const Cells& tree, const double* values, Candidates& candidates)
      : Walk(tree, values), candidates_(candidates) {}

  void run(double within) {
    limit_ = limitOf(within);
    Walk::run();
  }

 private:
  void look(std::span<const std::uint32_t> indices, const float* squared, float) override {
    std::array<std::uint32_t, kLeaf> places;
    const std::size_t count = placesNotAbove(limit_, squared, indices.size(), places.data());
    for (const std::uint32_t i : std::span(places).first(count)) {
      if (squared[i] <= limit_) limit_ = limitOf(candidates_.consider(indices[i]));
    }
  }

  Candidates& candidates_;
};

class JointTree::Cells::NearestSearch final : Walk {
 public:
  NearestSearch(const Cells& tree, const double* values) : Walk(tree, values) {}

  std::size_t run(std::span<std::uint32_t> nearest) {
    Walk::run();
    std::size_t count = 0;
    for (const auto& [squared, index] : found_) {
      if (!(squared <= limit_)) continue;
      if (count == nearest.size()) return 0;
      nearest[count++] = index;
    }
    return count;
  }

 private:
  static constexpr std::size_t kUsual = 16;

  void look(std::span<const std::uint32_t> indices, const float* squared, float least) override {
    limit_ = std::min(limit_, limitOfNearest(least));
    std::array<std::uint32_t, kLeaf> places;
    const std::size_t count = placesNotAbove(limit_, squared, indices.size(), places.data());
    for (const std::uint32_t i : std::span(places).first(count))
      found_.emplace_back(squared[i], indices[i]);
  }

  boost::container::small_vector<std::pair<float, std::uint32_t>, kUsual> found_;
};

JointTree::Cells::Cells(const JointSpace& space, std::span<const double> factors)
    : space_(&space), dimension_(space.getDimension()), scales_(space.weights()), cells_{leaf()} {
  for (std::size_t d = 0; d < factors.size(); ++d) scales_[d] *= factors[d];
}

JointTree::Cells::Point JointTree::Cells::weighted(const double* values) const {
  Point point(dimension_, boost::container::default_init);
  for (std::size_t d = 0; d < dimension_; ++d) {
    double value = scales_[d] * values[d];
    if (!(std::abs(value) <= kFarthestValue))
      value = std::isfinite(value) && value < 0.0 ? -kFarthestValue : kFarthestValue;
    point[d] = static_cast<float>(value);
  }
  return point;
}

JointTree::Cells::Cell JointTree::Cells::leaf() const {
  Cell cell;
  cell.box.assign(dimension_, kInfinity);
  cell.box.insert(cell.box.end(), dimension_, -kInfinity);
  cell.capacity = kLeaf;
  return cell;
}

float JointTree::Cells::coordinate(const Cell& leaf, std::size_t i, std::size_t axis) const {
  return leaf.blocks[i / kBlock * kBlock * dimension_ + axis * kBlock + i % kBlock];
}

void JointTree::Cells::put(Cell& leaf, const float* point, std::uint32_t index) const {
  const std::size_t i = leaf.indices.size();
  if (i % kBlock == 0) leaf.blocks.resize(leaf.blocks.size() + kBlock * dimension_);
  for (std::size_t d = 0; d < dimension_; ++d) {
    leaf.blocks[i / kBlock * kBlock * dimension_ + d * kBlock + i % kBlock] = point[d];
    leaf.box[d] = std::min(leaf.box[d], point[d]);
    leaf.box[dimension_ + d] = std::max(leaf.box[dimension_ + d], point[d]);
  }
  leaf.indices.push_back(index);
}

void JointTree::Cells::add(const double* values, std::uint32_t index) {
  const Point point = weighted(values);
  for (const float x : point) largest_ = std::max(largest_, std::abs(x));
  std::size_t at = 0;
  while (cells_[at].children != 0) {
    Cell& cell = cells_[at];
    for (std::size_t d = 0; d < dimension_; ++d) {
      cell.box[d] = std::min(cell.box[d], point[d]);
      cell.box[dimension_ + d] = std::max(cell.box[dimension_ + d], point[d]);
    }
    at = cell.children + (point[static_cast<std::size_t>(cell.axis)] < cell.middle ? 0 : 1);
  }
  put(cells_[at], point.data(), index);
  if (cells_[at].indices.size() > cells_[at].capacity) divide(at);
}

/// Divides at the median along the longest side. If at least half of the points are at one place,
/// the leaf stays, and may hold more.
void JointTree::Cells::divide(std::size_t index) {
  Cell full = std::move(cells_[index]);
  const std::size_t count = full.indices.size();
  std::size_t axis = 0;
  float longest = -1.0F;
  for (std::size_t d = 0; d < dimension_; ++d) {
    const float side = full.box[dimension_ + d] - full.box[d];
    if (side > longest) longest = side, axis = d;
  }
  std::vector<float> along(count);
  for (std::size_t i = 0; i < count; ++i) along[i] = coordinate(full, i, axis);
  const auto median = along.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(along.begin(), median, along.end());
  const float middle = *median;
  if (!(*std::min_element(along.begin(), median) < middle)) {
    full.capacity *= 2;
    cells_[index] = std::move(full);
    return;
  }
  Cell children[2] = {leaf(), leaf()};
  std::vector<float> point(dimension_);
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t d = 0; d < dimension_; ++d) point[d] = coordinate(full, i, d);
    put(children[point[axis] < middle ? 0 : 1], point.data(), full.indices[i]);
  }
  Cell& inner = cells_[index];
  inner = {};
  inner.box = std::move(full.box);
  inner.axis = static_cast<int>(axis);
  inner.middle = middle;
  inner.children = static_cast<std::uint32_t>(cells_.size());
  cells_.push_back(std::move(children[0]));
  cells_.push_back(std::move(children[1]));
}

void JointTree::Cells::remove(const double* values, std::uint32_t index) {
  const Point point = weighted(values);
  std::size_t at = 0;
  while (cells_[at].children != 0) {
    const Cell& cell = cells_[at];
    at = cell.children + (point[static_cast<std::size_t>(cell.axis)] < cell.middle ? 0 : 1);
  }
  Cell& cell = cells_[at];
  const auto found = std::ranges::find(cell.indices, index);
  if (found == cell.indices.end()) return;
  const auto i = static_cast<std::size_t>(found - cell.indices.begin());
  const std::size_t last = cell.indices.size() - 1;
  for (std::size_t d = 0; d < dimension_; ++d) {
    cell.blocks[i / kBlock * kBlock * dimension_ + d * kBlock + i % kBlock] =
        coordinate(cell, last, d);
  }
  cell.indices[i] = cell.indices[last];
  cell.indices.pop_back();
  if (last % kBlock == 0) cell.blocks.resize(cell.blocks.size() - kBlock * dimension_);
}

void JointTree::Cells::search(const double* values, double within, Candidates& candidates) const {
  Search(*this, values, candidates).run(within);
}

std::size_t JointTree::Cells::nearest(const double* values,
                                      std::span<std::uint32_t> nearest) const {
  return NearestSearch(*this, values).run(nearest);
}

JointTree::JointTree() = default;
JointTree::~JointTree() = default;

void JointTree::setFactors(std::vector<double> factors) {
  factors_ = std::move(factors);
}

void JointTree::clear() {
  cells_.reset();
}

bool JointTree::holds(const ompl::base::State* state) const {
  const JointSpace::JointState* joints = asJointState(state);
  return joints != nullptr && cells_ != nullptr && &joints->space() == &cells_->space();
}

bool JointTree::add(const ompl::base::State* state, std::uint32_t index) {
  const JointSpace::JointState* joints = asJointState(state);
  if (joints == nullptr) return false;
  if (cells_ == nullptr) {
    if (!factors_.empty() && factors_.size() != joints->space().weights().size()) return false;
    cells_ = std::make_unique<Cells>(joints->space(), factors_);
  }
  if (!holds(state)) return false;
  cells_->add(joints->values, index);
  return true;
}

void JointTree::remove(const ompl::base::State* state, std::uint32_t index) {
  if (holds(state)) cells_->remove(valuesOf(state), index);
}

bool JointTree::search(const ompl::base::State* state, double within,
                       Candidates& candidates) const {
  if (!holds(state)) return false;
  cells_->search(valuesOf(state), within, candidates);
  return true;
}

std::size_t JointTree::nearest(const ompl::base::State* state,
                               std::span<std::uint32_t> nearest) const {
  return holds(state) ? cells_->nearest(valuesOf(state), nearest) : 0;
}

}  // namespace swept::detail
