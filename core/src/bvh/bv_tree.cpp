// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bvh/bv_tree.hpp"

#include <atomic>
#include <stdexcept>
#include <string>

#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("BvTree: " + what);
}

void requireUsable(const PrimitivePoints& primitives) {
  if (primitives.perPrimitive < 1) refuse("0 points per primitive; allowed: at least 1");
  const std::size_t count = primitives.count();
  const std::size_t radii = primitives.radii.size();
  if (radii == 0 || radii == count) return;
  refuse(std::to_string(radii) + " radii of " + std::to_string(count) +
         " primitives; allowed: as many, or none");
}

/// Whether each primitive occurs once, whatever a rule did to the items.
void requireAll(const std::vector<int>& order) {
  std::vector<bool> found(order.size(), false);
  for (const int primitive : order) {
    if (primitive >= 0 && static_cast<std::size_t>(primitive) < order.size())
      found[static_cast<std::size_t>(primitive)] = true;
  }
  const auto lost = std::find(found.begin(), found.end(), false);
  if (lost == found.end()) return;
  refuse("the split rule has lost primitive " + std::to_string(lost - found.begin()) + " of " +
         std::to_string(order.size()) + "; allowed: to reorder");
}

std::vector<SplitItem> itemsOf(const PrimitivePoints& primitives) {
  const std::size_t per = primitives.perPrimitive;
  std::vector<SplitItem> items(primitives.count());
  for (std::size_t i = 0; i < items.size(); ++i) {
    SplitItem& item = items[i];
    item.primitive = static_cast<int>(i);
    item.lower = item.upper = primitives.points[i * per];
    for (const Eigen::Vector3d& p : primitives.points.subspan(i * per + 1, per - 1)) {
      for (int k = 0; k < 3; ++k) {
        item.lower[k] = std::min(item.lower[k], p[k]);
        item.upper[k] = std::max(item.upper[k], p[k]);
      }
    }
  }
  return items;
}

class TopologyBuilder {
 public:
  TopologyBuilder(std::vector<SplitItem>& items, const SplitFunction& split, int maxLeaf,
                  TreeTopology& out)
      : items_(items), split_(split), maxLeaf_(static_cast<std::size_t>(maxLeaf)), out_(out) {
    out_.nodes.reserve(2 * items.size());
    build(0, items.size(), 1);
  }

 private:
  void build(std::size_t first, std::size_t count, int depth) {
    out_.depth = std::max(out_.depth, depth);
    const std::size_t self = out_.nodes.size();
    out_.nodes.push_back({-1, static_cast<int>(first), static_cast<int>(count)});
    if (count <= maxLeaf_) return;
    const std::size_t left = part(std::span(items_).subspan(first, count), depth);
    build(first, left, depth + 1);
    out_.nodes[self].rightChild = static_cast<int>(out_.nodes.size());
    build(first + left, count - left, depth + 1);
  }

  std::size_t part(std::span<SplitItem> items, int depth) const {
    if (depth < kMaxTreeDepth / 2) {
      const std::size_t left = split_(items);
      if (left > 0 && left < items.size()) return left;
    }
    return MedianSplit{}(items);
  }

  std::vector<SplitItem>& items_;
  const SplitFunction& split_;
  std::size_t maxLeaf_;
  TreeTopology& out_;
};

}  // namespace

TreeTopology TreeTopology::build(const PrimitivePoints& primitives, const SplitFunction& split,
                                 int maxLeaf) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, maxLeaf] { return build(primitives, split, maxLeaf); });
  }
  if (maxLeaf < 1) refuse("maxLeaf is " + std::to_string(maxLeaf) + "; allowed: at least 1");
  requireUsable(primitives);
  std::vector<SplitItem> items = itemsOf(primitives);
  TreeTopology topology;
  const TopologyBuilder builder(items, split, maxLeaf, topology);
  topology.order.reserve(items.size());
  for (const SplitItem& item : items) topology.order.push_back(item.primitive);
  requireAll(topology.order);
  return topology;
}

namespace detail {

std::uint64_t nextTreeShape() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

void requireAsAtBuild(const PrimitivePoints& primitives, std::size_t count) {
  requireUsable(primitives);
  if (primitives.count() == count) return;
  refuse("refit to " + std::to_string(primitives.count()) +
         " primitives; allowed: " + std::to_string(count) + ", as at build");
}

}  // namespace detail

template class BvTree<Aabb>;
template class BvTree<Obb>;
template class BvTree<Rss>;
template class BvTree<ObbRss>;
template class BvTree<KDop<16>>;
template class BvTree<KDop<18>>;
template class BvTree<KDop<24>>;

}  // namespace swept
