// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/bvh/bvh_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include "all_volumes.hpp"
#include "bvh_models.hpp"
#include "mesh_samples.hpp"
#include "message_of.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::messageOf;
using test::modelOf;
using test::Soup;
using testing::HasSubstr;

const std::map<std::string, SplitFunction>& splitRules() {
  static const std::map<std::string, SplitFunction> rules{{"mean", MeanSplit{}},
                                                          {"median", MedianSplit{}},
                                                          {"principal axis", PrincipalAxisSplit{}},
                                                          {"surface area", SurfaceAreaSplit{}}};
  return rules;
}

/// Checks a subtree from what it covers; returns its depth and the index after its last node.
template <typename BV>
std::pair<int, int> checkSubtree(const BvhModel<BV>& model, int index, int first, int count) {
  const auto& node = model.tree().node(index);
  EXPECT_EQ(node.first, first);
  EXPECT_EQ(node.count, count);
  for (int slot = first; slot < first + count; ++slot) {
    const int triangle = model.tree().order()[slot];
    for (const int vertex : model.triangles()[triangle]) {
      EXPECT_TRUE(node.volume.contains(model.vertices()[vertex])) << "node " << index;
      if (model.state() == BvhState::Updated) {
        EXPECT_TRUE(node.volume.contains(model.previousVertices()[vertex])) << "node " << index;
      }
    }
  }
  if (node.isLeaf()) return {1, index + 1};
  const int left = model.tree().node(index + 1).count;
  EXPECT_GT(left, 0);
  EXPECT_LT(left, count);
  const auto [leftDepth, leftEnd] = checkSubtree(model, index + 1, first, left);
  EXPECT_EQ(node.rightChild, leftEnd);
  const auto [rightDepth, end] = checkSubtree(model, node.rightChild, first + left, count - left);
  return {1 + std::max(leftDepth, rightDepth), end};
}

/// Every promise of the tree: all primitives, in volumes that contain them, at bounded depth.
template <typename BV>
void checkTree(const BvhModel<BV>& model) {
  std::vector<int> order = model.tree().order();
  std::sort(order.begin(), order.end());
  std::vector<int> all(model.primitiveCount());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(order, all);
  const auto [depth, end] = checkSubtree(model, 0, 0, static_cast<int>(all.size()));
  EXPECT_EQ(end, static_cast<int>(model.tree().nodes().size()));
  EXPECT_EQ(depth, model.tree().depth());
  EXPECT_LE(depth, BvTree<BV>::kMaxDepth);
}

template <typename BV>
double volumeSizes(const BvhModel<BV>& model) {
  double sum = 0.0;
  for (const auto& node : model.tree().nodes()) sum += node.volume.size();
  return sum;
}

Soup sample() {
  std::mt19937 random(31);
  return test::blobSoup(random, 8, 16);
}

Soup deformed(const Soup& soup, double by) {
  Soup out = soup;
  for (Vector3d& v : out.vertices) v += by * Vector3d(std::sin(5.0 * v.y()), v.z() * v.z(), v.x());
  return out;
}

template <typename BV>
class BvhModels : public testing::Test {};
TYPED_TEST_SUITE(BvhModels, test::AllVolumes);

TYPED_TEST(BvhModels, EverySplitRuleAndFitRuleCoversAllTriangles) {
  for (const auto& [name, split] : splitRules()) {
    for (const int maxLeaf : {1, 2, 5}) {
      SCOPED_TRACE(name);
      checkTree(modelOf<TypeParam>(sample(), {split, FitToPoints{}, maxLeaf}));
      checkTree(modelOf<TypeParam>(sample(), {split, FitToChildren{}, maxLeaf}));
    }
  }
}

TYPED_TEST(BvhModels, OddMeshesEndAndStayWithinTheDepth) {
  Soup lopsided;  // sizes and distances halve, so a cut by mean or area takes off few at a time
  for (int i = 0; i < 300; ++i) {
    const double size = std::ldexp(1.0, -i);
    lopsided.vertices.emplace_back(size, 0.0, 0.0);
    lopsided.vertices.emplace_back(0.9 * size, 0.1 * size, 0.0);
    lopsided.vertices.emplace_back(0.9 * size, 0.0, 0.1 * size);
    lopsided.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  Soup equal;  // one triangle, many times
  equal.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  equal.triangles.assign(100, {0, 1, 2});
  Soup single = equal;
  single.triangles.resize(1);
  Soup point = single;
  point.triangles = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  for (const auto& [name, split] : splitRules()) {
    SCOPED_TRACE(name);
    const auto model = modelOf<TypeParam>(lopsided, {split, defaultFit<TypeParam>(), 1});
    checkTree(model);
    if (name == "surface area") {
      EXPECT_GT(model.tree().depth(), 20);
    }
    for (const Soup* soup : {&equal, &single, &point}) {
      checkTree(modelOf<TypeParam>(*soup, {split, defaultFit<TypeParam>(), 1}));
    }
  }
}

TYPED_TEST(BvhModels, RefitAndRebuildFollowReplacedVertices) {
  for (const Refresh refresh : {Refresh::Refit, Refresh::Rebuild}) {
    auto model = modelOf<TypeParam>(sample());
    const std::vector<int> order = model.tree().order();
    const Soup after = deformed(sample(), 0.8);
    model.beginReplace();
    // In two parts, as a streaming caller would.
    model.replaceVertices(0, std::span(after.vertices).first(40));
    model.replaceVertices(40, std::span(after.vertices).subspan(40));
    model.endReplace(refresh);
    EXPECT_EQ(model.state(), BvhState::Built);
    EXPECT_EQ(model.vertices(), after.vertices);
    EXPECT_TRUE(model.previousVertices().empty());
    checkTree(model);
    if (refresh == Refresh::Refit) {
      EXPECT_EQ(model.tree().order(), order);
    }
    EXPECT_LT(volumeSizes(model), 4.0 * volumeSizes(modelOf<TypeParam>(after)));
  }
}

TYPED_TEST(BvhModels, UpdateBoundsBothPositions) {
  for (const Refresh refresh : {Refresh::Refit, Refresh::Rebuild}) {
    auto model = modelOf<TypeParam>(sample());
    const double before = volumeSizes(model);
    Soup last = sample();
    for (const double by : {0.3, 0.6}) {  // an update of an updated model too
      const Soup next = deformed(sample(), by);
      model.beginUpdate();
      EXPECT_EQ(model.previousVertices(), last.vertices);
      model.updateVertices(0, next.vertices);
      model.endUpdate(refresh);
      EXPECT_EQ(model.state(), BvhState::Updated);
      EXPECT_EQ(model.previousVertices(), last.vertices);
      EXPECT_EQ(model.vertices(), next.vertices);
      checkTree(model);
      // In between, on the straight way, as well.
      for (const auto& node : model.tree().nodes()) {
        const Vector3i& t = model.triangles()[model.tree().order()[node.first]];
        EXPECT_TRUE(node.volume.inflated(1e-12).contains(0.4 * last.vertices[t[0]] +
                                                         0.6 * next.vertices[t[0]]));
      }
      last = next;
    }
    EXPECT_GT(volumeSizes(model), before);
    // Replacing forgets the way.
    model.beginReplace();
    model.endReplace(refresh);
    EXPECT_TRUE(model.previousVertices().empty());
    checkTree(model);
  }
}

TYPED_TEST(BvhModels, PointCloudsAreBoundedWithTheirRadii) {
  std::mt19937 random(32);
  BvhModel<TypeParam> model;
  model.begin();
  for (int i = 0; i < 200; ++i) {
    model.addPoint(test::uniformPoint(random, 1.0), i % 3 == 0 ? 0.0 : 0.1);
  }
  const int bare = model.addVertex({2.0, 0.0, 0.0});
  model.end();
  ASSERT_TRUE(model.isPointCloud());
  EXPECT_EQ(model.primitiveCount(), 201U);
  EXPECT_EQ(model.radii()[bare], 0.0);
  for (const auto& node : model.tree().nodes()) {
    for (int slot = node.first; slot < node.first + node.count; ++slot) {
      const int point = model.tree().order()[slot];
      const Vector3d onBall =
          model.vertices()[point] + 0.999999 * model.radii()[point] * test::unitVector(random);
      EXPECT_TRUE(node.volume.contains(onBall));
    }
  }
}

TEST(BvTree, SurfaceAreaSplitCostsLessThanHalving) {
  const Soup torus = test::torusSoup(64, 32, 1.0, 0.2);
  const auto sah = modelOf<Aabb>(torus, {SurfaceAreaSplit{}, defaultFit<Aabb>(), 1});
  const auto median = modelOf<Aabb>(torus, {MedianSplit{}, defaultFit<Aabb>(), 1});
  EXPECT_LE(volumeSizes(sah), 1.05 * volumeSizes(median));
  EXPECT_EQ(median.tree().depth(), 13);  // 4,096 triangles
}

TEST(BvTree, UserRulesAreRules) {
  struct TakeOne {
    std::size_t operator()(std::span<SplitItem>) const { return 1; }
  };
  struct Refuse {
    std::size_t operator()(std::span<SplitItem> items) const { return items.size(); }
  };
  static_assert(SplitRule<TakeOne> && SplitRule<Refuse>);
  checkTree(modelOf<Obb>(sample(), {TakeOne{}, FitToPoints{}, 1}));
  const auto halved = modelOf<Obb>(sample(), {Refuse{}, FitToPoints{}, 1});
  checkTree(halved);
  EXPECT_LE(halved.tree().depth(), 9);  // 224 triangles
  const auto loose = [](const FitInput<Aabb>& node) { return FitToPoints{}(node).inflated(0.5); };
  const auto model = modelOf<Aabb>(sample(), {MeanSplit{}, loose, 1});
  checkTree(model);
  EXPECT_GT(model.tree().node(0).volume.upper.x(), 1.2);
}

/// Refits used to be to the children, whatever the rule, and left out what a rule had added.
TEST(BvhModel, RefitsKeepTheRuleOfItsOwn) {
  const auto padded = [](const FitInput<Obb>& node) { return FitToPoints{}(node).inflated(0.5); };
  for (const Refresh refresh : {Refresh::Refit, Refresh::Rebuild}) {
    auto model = modelOf<Obb>(sample(), {MeanSplit{}, padded, 2});
    const Soup after = deformed(sample(), 0.3);
    model.beginUpdate();
    model.updateVertices(0, after.vertices);
    model.endUpdate(refresh);
    checkTree(model);
    for (const auto& node : model.tree().nodes()) {
      for (int slot = node.first; slot < node.first + node.count; ++slot) {
        for (const int vertex : model.triangles()[model.tree().order()[slot]]) {
          for (int k = 0; k < 3; ++k) {
            const Vector3d aside = 0.499 * Vector3d::Unit(k);
            EXPECT_TRUE(node.volume.contains(model.vertices()[vertex] + aside));
            EXPECT_TRUE(node.volume.contains(model.previousVertices()[vertex] - aside));
          }
        }
      }
    }
  }
}

TEST(BvTree, RulesThatLosePrimitivesAreRefused) {
  const auto twice = [](std::span<SplitItem> items) {
    items.front() = items.back();
    return items.size() / 2;
  };
  EXPECT_THAT(messageOf([&] {
                modelOf<Aabb>(sample(), {twice, FitToPoints{}, 1});
              }),
              HasSubstr("BvTree: the split rule has lost primitive 0 of 224; allowed: to reorder"));
}

TEST(BvTree, OtherPrimitivesThanAtBuildAreRefused) {
  const std::vector<Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::vector<double> radii(4, 0.1);
  const std::span<const Vector3d> four = std::span(points).first(4);
  EXPECT_EQ(messageOf([&] {
              BvTree<Aabb>::build({four, 0});
            }),
            "BvTree: 0 points per primitive; allowed: at least 1");
  EXPECT_EQ(messageOf([&] {
              BvTree<Aabb>::build({points, 1, radii});
            }),
            "BvTree: 4 radii of 5 primitives; allowed: as many, or none");
  auto tree = BvTree<Aabb>::build({four, 1, radii});
  EXPECT_EQ(messageOf([&] { tree.refit({points}); }),
            "BvTree: refit to 5 primitives; allowed: 4, as at build");
  EXPECT_EQ(messageOf([&] { tree.refit({four.first(3)}); }),
            "BvTree: refit to 3 primitives; allowed: 4, as at build");
  EXPECT_EQ(messageOf([&] {
              tree.refit({four, 1, std::span(radii).first(2)});
            }),
            "BvTree: 2 radii of 4 primitives; allowed: as many, or none");
  EXPECT_NO_THROW(tree.refit({four, 1}));
}

/// What is given may be what is overwritten, or lie in memory that has to grow.
TEST(BvhModel, VerticesMayBeItsOwn) {
  BvhModel<Aabb> model;
  model.begin();
  model.addMesh(sample().vertices, sample().triangles);
  for (int i = 0; i < 4; ++i) model.addMesh(model.vertices(), model.triangles());
  const std::vector<Vector3d> before = model.vertices();
  const std::size_t count = sample().vertices.size();
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_EQ(before[i], before[i % count]) << i;
  for (const Vector3i& t : model.triangles())
    ASSERT_LT(static_cast<std::size_t>(t.maxCoeff()), before.size());
  model.end();
  EXPECT_EQ(model.triangles().size(), 16 * sample().triangles.size());
  checkTree(model);
  for (const bool later : {true, false}) {
    const std::vector<Vector3d> old = model.vertices();
    model.beginReplace();
    const std::span<const Vector3d> own = model.vertices();
    model.replaceVertices(later ? 1 : 0, later ? own.first(own.size() - 1) : own.subspan(1));
    model.endReplace();
    for (std::size_t i = 1; i < old.size(); ++i)
      ASSERT_EQ(model.vertices()[later ? i : i - 1], old[later ? i - 1 : i]) << i;
    checkTree(model);
  }
}

TEST(BvhModel, MemoryIsCounted) {
  const auto small = modelOf<Aabb>(sample());
  const auto large = modelOf<Aabb>(test::torusSoup(64, 32, 1.0, 0.2));
  const auto single =
      modelOf<Aabb>(test::torusSoup(64, 32, 1.0, 0.2), {MeanSplit{}, FitToChildren{}, 1});
  const std::size_t triangles = large.triangles().size();
  EXPECT_GT(large.bytes(), triangles * (sizeof(Vector3i) + sizeof(BvTree<Aabb>::Node)));
  EXPECT_LT(large.bytes(), triangles * 160);
  EXPECT_LT(small.bytes(), large.bytes() / 10);
  EXPECT_LT(large.bytes(), 0.8 * static_cast<double>(single.bytes()));
}

/// The state machine: every call in every state.

BvhModel<Aabb> modelIn(BvhState state) {
  BvhModel<Aabb> model;
  if (state == BvhState::Empty) return model;
  model.begin();
  model.addTriangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  if (state == BvhState::Building) return model;
  model.end();
  if (state == BvhState::Replacing) model.beginReplace();
  if (state == BvhState::Updating || state == BvhState::Updated) model.beginUpdate();
  if (state == BvhState::Updated) model.endUpdate();
  EXPECT_EQ(model.state(), state);
  return model;
}

struct Call {
  std::string name;
  std::function<void(BvhModel<Aabb>&)> run;
  std::map<BvhState, BvhState> leadsTo;  ///< allowed states
  std::string allowed;
};

std::vector<Call> allCalls() {
  using enum BvhState;
  static const std::vector<Vector3d> some{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
  static const std::vector<Vector3i> one{{0, 1, 2}};
  using Model = BvhModel<Aabb>;
  const std::map<BvhState, BvhState> building{{Building, Building}};
  return {
      {"begin", [](Model& m) { m.begin(); }, {{Empty, Building}}, "empty"},
      {"addVertex", [](Model& m) { m.addVertex(some[0]); }, building, "building"},
      {"addTriangle", [](Model& m) { m.addTriangle(Vector3i(0, 1, 2)); }, building, "building"},
      {"addTriangle", [](Model& m) { m.addTriangle(some[0], some[1], some[2]); }, building,
       "building"},
      {"addMesh", [](Model& m) { m.addMesh(some, one); }, building, "building"},
      {"addPoint", [](Model& m) { m.addPoint(some[0], 0.1); }, building, "building"},
      {"end", [](Model& m) { m.end(); }, {{Building, Built}}, "building"},
      {"beginReplace",
       [](Model& m) { m.beginReplace(); },
       {{Built, Replacing}, {Updated, Replacing}},
       "built or updated"},
      {"replaceVertices",
       [](Model& m) { m.replaceVertices(0, some); },
       {{Replacing, Replacing}},
       "replacing"},
      {"endReplace", [](Model& m) { m.endReplace(); }, {{Replacing, Built}}, "replacing"},
      {"beginUpdate",
       [](Model& m) { m.beginUpdate(); },
       {{Built, Updating}, {Updated, Updating}},
       "built or updated"},
      {"updateVertices",
       [](Model& m) { m.updateVertices(0, some); },
       {{Updating, Updating}},
       "updating"},
      {"endUpdate", [](Model& m) { m.endUpdate(); }, {{Updating, Updated}}, "updating"},
      {"someQuery",
       [](Model& m) { m.requireTriangles("someQuery"); },
       {{Built, Built}, {Updated, Updated}},
       "built or updated"},
  };
}

TEST(BvhModel, EveryCallInEveryStateDoesOrSays) {
  using enum BvhState;
  int refused = 0;
  for (const BvhState state : {Empty, Building, Built, Replacing, Updating, Updated}) {
    for (const Call& call : allCalls()) {
      SCOPED_TRACE(call.name + " while " + std::string(toString(state)));
      BvhModel<Aabb> model = modelIn(state);
      const auto allowed = call.leadsTo.find(state);
      if (allowed != call.leadsTo.end()) {
        EXPECT_NO_THROW(call.run(model));
        EXPECT_EQ(model.state(), allowed->second);
        continue;
      }
      const std::size_t vertices = model.vertices().size();
      try {
        call.run(model);
        ADD_FAILURE() << "no exception";
      } catch (const BvhStateError& error) {
        EXPECT_EQ(std::string(error.what()), "BvhModel::" + call.name + ": model is " +
                                                 std::string(toString(state)) +
                                                 "; allowed: " + call.allowed);
        ++refused;
      }
      EXPECT_EQ(model.state(), state);
      EXPECT_EQ(model.vertices().size(), vertices);
    }
    BvhModel<Aabb> model = modelIn(state);
    model.clear();
    EXPECT_EQ(model.state(), Empty);
    EXPECT_TRUE(model.tree().nodes().empty());
  }
  EXPECT_EQ(refused, 6 * 14 - 17);
}

TEST(BvhModel, BadInputIsNamedAndChangesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  BvhModel<Aabb> model;
  model.begin();
  EXPECT_THAT(messageOf([&] { model.end(); }),
              HasSubstr("BvhModel::end: no triangles and no points"));
  EXPECT_THAT(messageOf([&] {
                model.addVertex({1, nan, 2});
              }),
              HasSubstr("BvhModel::addVertex: vertex 0 is (1, nan, 2); allowed: finite"));
  model.addVertex({0, 0, 0});
  EXPECT_THAT(messageOf([&] {
                model.addTriangle({0, 0, 1});
              }),
              HasSubstr("triangle 0 has vertex 1; allowed: 0 to 1 exclusive"));
  EXPECT_THAT(messageOf([&] { model.addTriangle({0, 0, -1}); }), HasSubstr("has vertex -1"));
  EXPECT_THAT(messageOf([&] {
                model.addPoint({0, 0, 0}, -1.0);
              }),
              HasSubstr("point 1 has radius -1; allowed: finite and not negative"));
  EXPECT_THAT(messageOf([&] { model.addPoint({0, 0, 0}, nan); }), HasSubstr("has radius nan"));
  EXPECT_THAT(messageOf([&] {
                model.addTriangle({0, 0, 0}, {1, 0, 0}, {0, infinity, 0});
              }),
              HasSubstr("BvhModel::addTriangle: vertex 3 is (0, inf, 0)"));
  const std::vector<Vector3d> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::vector<Vector3i> wrong{{0, 1, 2}, {0, 1, 3}};
  EXPECT_THAT(messageOf([&] { model.addMesh(vertices, wrong); }),
              HasSubstr("BvhModel::addMesh: triangle 1 has vertex 3; allowed: 0 to 3 exclusive"));
  EXPECT_EQ(model.vertices().size(), 1U);
  EXPECT_TRUE(model.triangles().empty());
  model.addTriangle(vertices[0], vertices[1], vertices[2]);
  model.addPoint({5, 5, 5}, 2.5e-7);
  EXPECT_THAT(messageOf([&] { model.end(); }),
              HasSubstr("point 4 has radius 2.5e-07 in a model of triangles; allowed: 0"));
  EXPECT_EQ(model.state(), BvhState::Building);

  model = modelIn(BvhState::Replacing);
  const std::vector<Vector3d> before = model.vertices();
  EXPECT_THAT(messageOf([&] { model.replaceVertices(1, vertices); }),
              HasSubstr("BvhModel::replaceVertices: vertices 1 and 3 on of 3"));
  const std::vector<Vector3d> bad{{0, 0, 9}, {0, 0, nan}};
  EXPECT_THAT(messageOf([&] { model.replaceVertices(1, bad); }),
              HasSubstr("vertex 2 is (0, 0, nan)"));
  EXPECT_EQ(model.vertices(), before);

  BvhModel<Aabb> cloud;
  cloud.begin();
  cloud.addPoint({0, 0, 0}, 0.1);
  cloud.end();
  EXPECT_THAT(messageOf([&] { cloud.requireTriangles("meshDistance"); }),
              HasSubstr("BvhModel::meshDistance: model is a point cloud; allowed: triangles"));
}

}  // namespace
}  // namespace swept
