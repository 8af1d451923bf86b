// SPDX-License-Identifier: BSD-3-Clause
// Predicted probabilities against how often it happens: the noise is drawn, and collide() or plain
// arithmetic asked. SWEPT_PROBABILITY_SCENES sets how many scenes there are (4000 take a minute),
// SWEPT_PROBABILITY_SEED which.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <numbers>
#include <optional>

#include "mesh_samples.hpp"
#include "point_cloud/line_cell.hpp"
#include "swept/core/collision_probability.hpp"
#include "swept/core/distance.hpp"

namespace swept::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

bool isCampaign() {
  return std::getenv("SWEPT_PROBABILITY_SCENES") != nullptr;
}

int scenesInAll() {
  const char* scenes = std::getenv("SWEPT_PROBABILITY_SCENES");
  return scenes == nullptr ? 360 : std::atoi(scenes);
}

unsigned seed() {
  const char* seed = std::getenv("SWEPT_PROBABILITY_SEED");
  return seed == nullptr ? 1U : static_cast<unsigned>(std::atoi(seed));
}

enum class Kind { MeshBox, MeshBlob, MeshTorus, MeshEll, Solid, Surface, FewPairs, ManyPairs };
constexpr int kKinds = 8;

enum class Noise { Even, Uneven, FlatOrLine };
constexpr int kNoises = 3;

/// A cloud as its sampler sees it.
struct Points {
  std::vector<Vector3d> means;
  std::vector<double> radii;
  std::vector<Matrix3d> factors;  ///< m, made by the test: F F^T is the covariance

  NoisyPointCloud cloud() const {
    std::vector<Matrix3d> covariances;
    for (const Matrix3d& factor : factors) covariances.push_back(factor * factor.transpose());
    return NoisyPointCloud::build(means, radii, covariances);
  }
  std::vector<Vector3d> draw(std::mt19937& random) const {
    std::normal_distribution<double> normal;
    std::vector<Vector3d> drawn;
    for (std::size_t i = 0; i < means.size(); ++i) {
      const double x = normal(random);
      const double y = normal(random);
      drawn.push_back(means[i] + factors[i] * Vector3d(x, y, normal(random)));
    }
    return drawn;
  }
};

struct Scene {
  Kind kind;
  Noise noise;
  Points points;
  Isometry3d pose;             ///< of the other in the cloud's frame
  std::optional<Shape> shape;  ///< the other; none: `others`
  Points others;
};

/// The prism over an L: not convex, with one edge that is a dent.
TriangleMesh ellMesh() {
  const std::vector<Eigen::Vector2d> outline{{-0.5, -0.5}, {0.5, -0.5}, {0.5, -0.1},
                                             {-0.1, -0.1}, {-0.1, 0.5}, {-0.5, 0.5}};
  Soup soup;
  for (const double z : {-0.3, 0.3}) {
    for (const auto& p : outline) soup.vertices.emplace_back(p.x(), p.y(), z);
  }
  for (const Eigen::Vector3i& t :
       std::vector<Eigen::Vector3i>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}}) {
    soup.triangles.emplace_back(t[0], t[2], t[1]);
    soup.triangles.emplace_back(t.array() + 6);
  }
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    soup.triangles.emplace_back(i, next, next + 6);
    soup.triangles.emplace_back(i, next + 6, i + 6);
  }
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

TriangleMesh meshOf(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

class SceneSampler {
 public:
  explicit SceneSampler(unsigned seed) : random_(seed) {}

  Scene draw(int index) {
    Scene scene;
    scene.kind = static_cast<Kind>(index % kKinds);
    scene.noise = static_cast<Noise>(index / kKinds % kNoises);
    scene.pose = randomPose(random_, 1.0);
    if (scene.kind == Kind::FewPairs || scene.kind == Kind::ManyPairs) {
      const bool many = scene.kind == Kind::ManyPairs;
      const double size = many ? uniform(random_, 0.1, 0.5) : uniform(random_, 0.1, 0.3);
      scene.points = cloud(scene.noise, many ? 12 : 5, size);
      scene.others = cloud(scene.noise, many ? 12 : 5, size);
      scene.pose.translation() *= 0.1;
    } else {
      scene.shape = shapeOf(scene.kind);
      scene.points = cloud(scene.noise, 1 + static_cast<int>(random_() % 6), 0.0);
      for (Vector3d& mean : scene.points.means) mean = scene.pose * nearSurface(*scene.shape);
    }
    return scene;
  }

 private:
  Shape shapeOf(Kind kind) {
    const int which = static_cast<int>(random_() % 4);
    switch (kind) {
      case Kind::MeshBox:
        return meshOf(boxSoup({-0.5, -0.3, -0.1}, {0.5, 0.3, 0.1}));
      case Kind::MeshBlob:
        return meshOf(blobSoup(random_, 6, 8));
      case Kind::MeshTorus:
        return meshOf(torusSoup(16, 10, 0.4, 0.12));
      case Kind::MeshEll:
        return ellMesh();
      case Kind::Surface:
        if (which < 2) return makeTriangle({0, 0, 0}, {0.8, 0, 0}, {0, 0.7, 0.1});
        return TriangleMesh::build(boxSoup({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}).vertices,
                                   boxSoup({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4}).triangles,
                                   MeshInterior::Surface);
      case Kind::Solid:
      case Kind::FewPairs:
      case Kind::ManyPairs:
        break;
    }
    if (which == 0) return makeSphere(0.3);
    if (which == 1) return makeBox({0.5, 0.7, 0.3});
    if (which == 2) return makeCylinder(0.2, 0.6);
    return makeCapsule(0.15, 0.5);
  }

  /// Within a step or two of the noise from the surface, mostly outside.
  Vector3d nearSurface(const Shape& shape) {
    for (int tries = 0; tries < 10000; ++tries) {
      Vector3d at = uniformPoint(random_, 1.0);
      const DistanceResult apart =
          distance(shape, Sphere{0.0}, Isometry3d(Eigen::Translation3d(at)));
      if (apart.upper <= 0.0 ? random_() % 4 == 0 : apart.upper < uniform(random_, 0.0, 0.3)) {
        return at;
      }
    }
    return Vector3d::Zero();
  }

  Points cloud(Noise noise, int count, double size) {
    Points points;
    for (int i = 0; i < count; ++i) {
      points.means.push_back(uniformPoint(random_, size));
      points.radii.push_back(i % 3 == 0 ? 0.02 : uniform(random_, 0.02, 0.08));
      points.factors.push_back(factor(noise));
    }
    return points;
  }

  Matrix3d factor(Noise noise) {
    const Matrix3d turn = randomPose(random_, 0.0).linear();
    const double s = uniform(random_, 0.02, 0.1);
    switch (noise) {
      case Noise::Even:
        return s * Matrix3d::Identity();
      case Noise::Uneven:
        return turn * Vector3d(s, 0.3 * s, uniform(random_, 0.05, 1.0) * s).asDiagonal();
      case Noise::FlatOrLine:
        break;
    }
    return turn * Vector3d(s, random_() % 2 == 0 ? 0.0 : 0.6 * s, 0.0).asDiagonal();
  }

  std::mt19937 random_;
};

bool meets(const Scene& scene, std::mt19937& random) {
  const std::vector<Vector3d> drawn = scene.points.draw(random);
  if (scene.shape) {
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      Isometry3d ball_from_shape = scene.pose;
      ball_from_shape.translation() -= drawn[i];
      const Sphere ball{scene.points.radii[i]};
      if (collide(ball, *scene.shape, ball_from_shape) == Contact::Touching) return true;
    }
    return false;
  }
  const std::vector<Vector3d> others = scene.others.draw(random);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    for (std::size_t j = 0; j < others.size(); ++j) {
      const double apart = (drawn[i] - scene.pose * others[j]).norm();
      if (apart <= scene.points.radii[i] + scene.others.radii[j]) return true;
    }
  }
  return false;
}

double frequency(const Scene& scene, int draws, std::mt19937& random) {
  int met = 0;
  for (int i = 0; i < draws; ++i) met += meets(scene, random) ? 1 : 0;
  return static_cast<double>(met) / draws;
}

CollisionProbability predict(const Scene& scene, const CollisionProbabilityOptions& options) {
  const NoisyPointCloud cloud = scene.points.cloud();
  if (scene.shape) return collisionProbability(cloud, *scene.shape, scene.pose, options);
  return collisionProbability(cloud, scene.others.cloud(), scene.pose, options);
}

/// Scenes by their predicted probability, in tenths.
struct Bin {
  int scenes = 0;
  double predicted = 0.0;
  double observed = 0.0;
};

/// Predictions mean what they say: of what is predicted with p, p happens.
TEST(CollisionProbabilityCalibration, WhatIsPredictedHappensThatOften) {
  constexpr int kDraws = 100;
  CollisionProbabilityOptions options;
  options.accuracy = 0.05;
  options.maxLooks = 4'000;
  SceneSampler sampler(seed());
  std::mt19937 random(seed() + 1);
  std::array<Bin, 10> bins;
  std::array<std::array<int, kNoises>, kKinds> open{};
  double excess = 0.0;
  double variance = 0.0;
  int sampled = 0;
  const int scenes = scenesInAll();
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = sampler.draw(i);
    const CollisionProbability found = predict(scene, options);
    ASSERT_LE(found.lower, found.probability);
    ASSERT_LE(found.probability, found.upper);
    const double observed = frequency(scene, kDraws, random);
    const double p = found.probability;
    Bin& bin = bins[std::min<std::size_t>(9, static_cast<std::size_t>(10.0 * p))];
    ++bin.scenes;
    bin.predicted += p;
    bin.observed += observed;
    excess += p - observed;
    variance += p * (1.0 - p) / kDraws + found.standardError * found.standardError;
    sampled += found.effort.samples > 0 ? 1 : 0;
    if (p > 0.02 && p < 0.98) {
      ++open[static_cast<std::size_t>(scene.kind)][static_cast<std::size_t>(scene.noise)];
    }
  }
  for (const Bin& bin : bins) {
    ASSERT_GE(bin.scenes, scenes / 40);
    if (isCampaign()) {
      std::cout << bin.scenes << " scenes, predicted " << bin.predicted / bin.scenes
                << ", observed " << bin.observed / bin.scenes << '\n';
    }
    EXPECT_LE(std::abs(bin.predicted - bin.observed) / bin.scenes, 0.05);
  }
  EXPECT_LE(std::abs(excess), 3.0 * std::sqrt(variance));
  if (isCampaign()) {
    std::cout << "excess " << excess / scenes << ", standard error " << std::sqrt(variance) / scenes
              << ", sampled " << sampled << '\n';
  }
  EXPECT_GT(sampled, scenes / 20);
  for (const auto& kind : open) {
    for (const int count : kind) EXPECT_GE(count, scenes / 240);
  }
}

/// Each scene on its own, against so many draws that an error of a hundredth shows.
TEST(CollisionProbabilityCalibration, BoundsHoldInEachScene) {
  const int draws = isCampaign() ? 100'000 : 10'000;
  CollisionProbabilityOptions options;
  options.accuracy = 0.02;
  options.maxLooks = isCampaign() ? 100'000 : 10'000;
  SceneSampler sampler(seed() + 2);
  std::mt19937 random(seed() + 3);
  int open = 0;
  int narrow = 0;
  const int scenes = isCampaign() ? 192 : 48;
  for (int i = 0; i < scenes; ++i) {
    const Scene scene = sampler.draw(i);
    const CollisionProbability found = predict(scene, options);
    const double observed = frequency(scene, draws, random);
    const double p = found.probability;
    const double sigma = std::sqrt(std::max(p * (1.0 - p), 1.0 / draws) / draws);
    EXPECT_LE(std::abs(p - observed), 4.0 * sigma + options.accuracy) << "scene " << i;
    EXPECT_GE(observed, found.lower - 4.0 * sigma) << "scene " << i;
    EXPECT_LE(observed, found.upper + 4.0 * sigma) << "scene " << i;
    open += p > 0.02 && p < 0.98 ? 1 : 0;
    narrow += found.upper - found.lower <= 0.05 ? 1 : 0;
  }
  EXPECT_GT(open, scenes / 2);
  EXPECT_GT(narrow, scenes / 2);
}

ThresholdResult compare(const Scene& scene, double threshold,
                        const CollisionProbabilityOptions& options) {
  const NoisyPointCloud cloud = scene.points.cloud();
  if (scene.shape) return probabilityExceeds(cloud, *scene.shape, scene.pose, threshold, options);
  return probabilityExceeds(cloud, scene.others.cloud(), scene.pose, threshold, options);
}

/// Thresholds are decided as the probability says, for a fraction of its price.
TEST(CollisionProbabilityCalibration, ThresholdsAreCheaper) {
  CollisionProbabilityOptions options;
  options.accuracy = 0.04;
  options.maxLooks = 10'000;
  SceneSampler sampler(5);
  std::array<int, 3> answers{};
  int looksForThresholds = 0, looksForProbabilities = 0;
  int samples = 0;
  constexpr int kScenes = 72;
  for (int i = 0; i < kScenes; ++i) {
    const Scene scene = sampler.draw(i);
    const CollisionProbability found = predict(scene, options);
    for (const double threshold : {0.01, 0.1, 0.5, 0.9}) {
      const ThresholdResult result = compare(scene, threshold, options);
      ++answers[static_cast<std::size_t>(result.answer)];
      EXPECT_EQ(result.answer == Exceeds::Yes, result.lower > threshold);
      EXPECT_EQ(result.answer == Exceeds::No, result.upper <= threshold);
      // Both intervals have the truth.
      EXPECT_LE(result.lower, found.upper);
      EXPECT_LE(found.lower, result.upper);
      if (scene.shape) looksForThresholds += result.effort.looks;
      if (scene.shape) looksForProbabilities += found.effort.looks;
      samples += result.effort.samples;
    }
  }
  EXPECT_EQ(samples, 0);
  EXPECT_GT(answers[static_cast<std::size_t>(Exceeds::Yes)], kScenes);
  EXPECT_GT(answers[static_cast<std::size_t>(Exceeds::No)], kScenes);
  EXPECT_LT(answers[static_cast<std::size_t>(Exceeds::Undecided)], 4 * kScenes / 10);
  EXPECT_LT(looksForThresholds, looksForProbabilities / 3);
}

/// Probability that (u, v) is in the cell and (u, v, w) in any of the sets, by the midpoint rule.
double massOf(const detail::NoiseFrame& frame, const detail::LineCell& cell,
              const std::vector<detail::Certificate>& sets) {
  constexpr int kSteps = 60;
  const double stepU = (cell.to[0] - cell.from[0]) / kSteps;
  const double stepV = (cell.to[1] - cell.from[1]) / kSteps;
  double mass = 0.0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const int row = i / kSteps, column = i % kSteps;
    const double u = cell.from[0] + (row + 0.5) * stepU;
    const double v = cell.from[1] + (column + 0.5) * stepV;
    std::vector<detail::Interval> on;
    for (const auto& set : sets) on.push_back(set.along(frame.line(u, v), frame.way()));
    std::sort(on.begin(), on.end(), [](const auto& a, const auto& b) { return a.from < b.from; });
    double reached = -40.0, inside = 0.0;
    for (const detail::Interval& part : on) {
      const double from = std::max(part.from, reached);
      if (part.isEmpty() || part.to <= from) continue;
      inside += 0.5 * (std::erf(part.to / std::sqrt(2.0)) - std::erf(from / std::sqrt(2.0)));
      reached = part.to;
    }
    mass += inside * std::exp(-0.5 * (u * u + v * v)) * stepU * stepV / (2.0 * std::numbers::pi);
  }
  return mass;
}

/// What a cell says of its certificates, against all of its lines.
TEST(CollisionProbabilityCalibration, CellsHoldWhatIsInTheirCertificates) {
  std::mt19937 random(7);
  int close = 0;
  constexpr int kCells = 1000;
  for (int i = 0; i < kCells; ++i) {
    const detail::NoiseFrame frame{Vector3d::Zero(), randomPose(random, 0.0).linear(), false};
    const double u = uniform(random, -2.0, 1.5), v = uniform(random, -2.0, 1.5);
    const double size = uniform(random, 0.1, 1.0);
    auto cell = detail::LineCell::of({u, v}, {u + size, v + uniform(random, 0.3, 1.0) * size});
    std::vector<detail::Certificate> sets;
    for (int k = 0; k <= i % 3; ++k) {
      const Vector3d at =
          frame.line(cell.mean[0], cell.mean[1]) + uniform(random, -2.0, 2.0) * frame.way();
      const Vector3d center = at + uniformPoint(random, 0.5);
      sets.push_back(
          {detail::Certificate::Form::Ball, i % 2 == 0, center, uniform(random, 0.5, 2.0)});
    }
    cell.certificates = sets;
    detail::bound(frame, cell);
    const double truth = massOf(frame, cell, sets);
    const double found = i % 2 == 0 ? cell.least : cell.mass - cell.most;
    EXPECT_LE(found, truth + 1e-5 * cell.mass);
    close += truth > 0.1 * cell.mass && found > 0.8 * truth ? 1 : 0;
  }
  EXPECT_GT(close, kCells / 5);
}

TEST(CollisionProbabilityCalibration, TheSameQueryHasTheSameBits) {
  CollisionProbabilityOptions options;
  options.accuracy = 0.05;
  options.maxLooks = 1'000;
  SceneSampler sampler(6);
  int sampled = 0;
  for (int i = 0; i < 48; ++i) {
    const Scene scene = sampler.draw(i);
    const CollisionProbability one = predict(scene, options);
    const CollisionProbability other = predict(scene, options);
    EXPECT_EQ(one.probability, other.probability);
    EXPECT_EQ(one.lower, other.lower);
    EXPECT_EQ(one.upper, other.upper);
    EXPECT_EQ(one.standardError, other.standardError);
    sampled += one.effort.samples > 0 ? 1 : 0;
  }
  EXPECT_GT(sampled, 2);
}

}  // namespace
}  // namespace swept::test
