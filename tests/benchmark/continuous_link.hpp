// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "continuous_truth.hpp"
#include "data_folder.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "workloads.hpp"

/// A link's mesh past an obstacle while one joint of its robot moves.
namespace swept::benchmark {

/// The first mesh of a link.
class LinkUnderTest {
 public:
  LinkUnderTest(const std::filesystem::path& files, std::string group, std::string link)
      : robot_(Robot::load(files.string() + ".urdf", files.string() + ".srdf")),
        group_(std::move(group)),
        link_(std::move(link)) {
    const auto index = robot_->findLink(link_);
    if (!index) throw std::runtime_error(files.string() + ": no link " + link_);
    for (const CollisionGeometry& piece :
         robot_->links()[static_cast<std::size_t>(*index)].collision)
      if (geometry_ == nullptr && std::holds_alternative<TriangleMesh>(piece.shape))
        geometry_ = &piece;
    if (geometry_ == nullptr) throw std::runtime_error(link_ + " has no mesh");
  }

  std::string name() const { return robot_->name() + " " + link_; }
  const Shape& shape() const { return geometry_->shape; }
  const TriangleMesh& mesh() const { return std::get<TriangleMesh>(geometry_->shape); }

  /// Of the mesh while one joint before the link turns by 0.1 to 1 rad, all others at random.
  std::shared_ptr<const Motion> randomMotion(std::mt19937_64& random) const {
    const Group& group = *robot_->findGroup(group_);
    std::vector<double> from;
    for (const int v : group.variables) {
      const Variable& variable = robot_->variables()[static_cast<std::size_t>(v)];
      const bool bounded = std::isfinite(variable.lower) && std::isfinite(variable.upper);
      from.push_back(bounded ? uniform(random, variable.lower, variable.upper)
                             : uniform(random, -std::numbers::pi, std::numbers::pi));
    }
    const std::vector<std::size_t> movers = variablesBefore(group);
    for (;;) {
      const std::size_t chosen = movers[random() % movers.size()];
      std::vector<double> to = from;
      to[chosen] += (random() % 2 == 0 ? 1.0 : -1.0) * uniform(random, 0.1, 1.0);
      const Variable& variable =
          robot_->variables()[static_cast<std::size_t>(group.variables[chosen])];
      if (to[chosen] < variable.lower || to[chosen] > variable.upper) continue;
      const auto carried = std::make_shared<const Carried>(
          LinkMotion(*robot_, group_, link_, from, to), geometry_->link_from_shape);
      return {carried, &carried->mesh};
    }
  }

 private:
  struct Carried {
    Carried(LinkMotion link, const Eigen::Isometry3d& link_from_mesh)
        : body(std::move(link)), mesh(body, link_from_mesh) {}
    Carried(const Carried&) = delete;
    Carried& operator=(const Carried&) = delete;
    LinkMotion body;
    AttachedFrame mesh;
  };

  /// Indices into the group's variables: turning joints on the way from the root to the link.
  std::vector<std::size_t> variablesBefore(const Group& group) const {
    std::vector<std::size_t> found;
    int link = *robot_->findLink(link_);
    for (;;) {
      const int parent = robot_->links()[static_cast<std::size_t>(link)].parentJoint;
      if (parent < 0) return found;
      const Joint& joint = robot_->joints()[static_cast<std::size_t>(parent)];
      for (std::size_t i = 0; i < group.variables.size(); ++i)
        if (joint.type != JointType::Prismatic && !joint.mimic &&
            group.variables[i] == joint.firstVariable)
          found.push_back(i);
      if (joint.parentLink < 0) return found;
      link = joint.parentLink;
    }
  }

  std::shared_ptr<const Robot> robot_;
  std::string group_, link_;
  const CollisionGeometry* geometry_ = nullptr;
};

#ifdef SWEPT_HAS_FCL

constexpr double kLinkTolerance = 1e-6;  ///< m
constexpr int kSweepsOfAKind = 100;      ///< as many hits as free motions

struct Obstacle {
  std::string name;
  Shape shape;
  std::shared_ptr<fcl::CollisionGeometryd> obb, obbRss;
};

inline Soup soupOf(const TriangleMesh& mesh) {
  return {mesh.vertices(), mesh.triangles()};
}

inline std::vector<Obstacle> obstacles() {
  const Box box = makeBox({0.2, 0.15, 0.1});
  const Cylinder cylinder = makeCylinder(0.06, 0.3);
  const Soup torus = bumpyTorus(32, 12, 0.1, 0.04);
  // FCL's mesh algorithms take primitives as they are, for either volume.
  const auto fclBox = std::make_shared<fcl::Boxd>(0.2, 0.15, 0.1);
  const auto fclCylinder = std::make_shared<fcl::Cylinderd>(0.06, 0.3);
  return {{"box", box, fclBox, fclBox},
          {"cylinder", cylinder, fclCylinder, fclCylinder},
          {"mesh, 768", TriangleMesh::build(torus.vertices, torus.triangles),
           fclModel<fcl::OBBd>(torus), fclModel<fcl::OBBRSSd>(torus)}};
}

/// One link against one obstacle.
class LinkPast {
 public:
  LinkPast(const LinkUnderTest& link, const Obstacle& obstacle, std::uint64_t seed)
      : link_(link), obstacle_(obstacle), random_(seed) {
    const Soup soup = soupOf(link.mesh());
    obb_ = {fclModel<fcl::OBBd>(soup), obstacle.obb};
    obbRss_ = {fclModel<fcl::OBBRSSd>(soup), obstacle.obbRss};
    while (hits_.size() < kSweepsOfAKind || free_.size() < kSweepsOfAKind) propose();
  }

  const std::vector<Sweep>& hits() const { return hits_; }
  const std::vector<Sweep>& free() const { return free_; }
  double apart() const { return apart_; }
  double distanceAt(const Sweep& sweep, double t) const {
    return obbRss_.distance(sweep.still->at(0.0).inverse() * sweep.motion->at(t));
  }

  std::vector<Method> methods() {
    const auto sweptAlong = [this](const Sweep& sweep, const Motion& motion) {
      return ask(obstacle_.shape, link_.shape(), sweep, kLinkTolerance, workspace_, motion);
    };
    std::vector<Method> methods{
        {"swept", [=](const Sweep& sweep) { return sweptAlong(sweep, *sweep.motion); }},
        {"swept, as a screw", [=, this](const Sweep& sweep) {
           return sweptAlong(sweep, screws_[static_cast<std::size_t>(&sweep - inTurn_)]);
         }}};
    for (const FclBodies* bodies : {&obb_, &obbRss_})
      methods.push_back({"FCL, naive, 100 samples",
                         [=](const Sweep& sweep) { return bodies->samples(sweep, 100); }});
    methods.push_back(
        {"FCL, conservative advancement",
         [this](const Sweep& sweep) { return obbRss_.conservativeAdvancement(sweep); }, true});
    return methods;
  }
  /// To be called before methods() are asked about these sweeps.
  void turnTo(const std::vector<Sweep>& sweeps) {
    screws_.clear();
    for (const Sweep& sweep : sweeps)
      screws_.push_back(UniformMotion::screw(sweep.motion->at(0.0), sweep.motion->at(1.0)));
    inTurn_ = sweeps.data();
  }

 private:
  /// An obstacle turned at random, near where the link's middle is at some time.
  void propose() {
    Sweep sweep;
    sweep.kind = PathKind::Screw;
    sweep.motion = link_.randomMotion(random_);
    Eigen::Isometry3d pose = randomPose(random_, Eigen::Vector3d::Zero());
    pose.translation() =
        sweep.motion->at(uniform(random_, 0.0, 1.0)) * boundingSphere(link_.shape()).center +
        uniform(random_, 0.0, 0.3) * direction(random_);
    sweep.still = std::make_shared<UniformMotion>(UniformMotion::still(pose));
    if (obbRss_.distance(pose.inverse() * sweep.motion->at(0.0)) < 1e-3) return;
    sweep.speed = fastestPoint(*sweep.motion, link_.mesh().vertices());
    sweep.truth = sampledFirstContact(fclProbe(obbRss_), sweep, 1e-7, 1000);
    std::vector<Sweep>& list = sweep.truth.hit ? hits_ : free_;
    if (list.size() == kSweepsOfAKind) return;
    apart_ = std::max(apart_, addFclMotions(sweep, boundingSphere(link_.shape()).radius));
    list.push_back(sweep);
  }

  const LinkUnderTest& link_;
  const Obstacle& obstacle_;
  std::mt19937_64 random_;
  FclBodies obb_, obbRss_;
  std::vector<Sweep> hits_, free_;
  std::vector<UniformMotion> screws_;
  const Sweep* inTurn_ = nullptr;
  double apart_ = 0.0;
  ContinuousWorkspace workspace_;
};

inline std::vector<LinkUnderTest> linksUnderTest() {
  const std::filesystem::path ours = std::filesystem::path(modelsDir()) / "robots";
  std::vector<LinkUnderTest> links;
  links.emplace_back(ours / "rook7" / "rook7", "arm", "hand");
  links.emplace_back(ours / "rook6" / "rook6", "arm", "wrist_2");
  if (const auto data = dataFolder()) {
    const std::filesystem::path panda = *data / "robots" / "panda" / "panda";
    links.emplace_back(panda, "panda_arm", "panda_hand");
    links.emplace_back(panda, "panda_arm", "panda_link5");
  } else {
    std::printf("Panda skipped: SWEPT_DATA is not set\n\n");
  }
  return links;
}

inline int linkPart() {
  std::printf("## Links past obstacles, tolerance 1e-6 m\n\n");
  const MarkdownTable table({"link", "triangles", "obstacle", "swept, us, hit / free", "as a screw",
                             "FCL 100 samples", "swept / this", "all", "FCL advancement"});
  std::vector<std::string> names;
  std::vector<Score> scores;
  double apart = 0.0;
  const std::vector<Obstacle> things = obstacles();
  std::uint64_t seed = 1;
  for (const LinkUnderTest& link : linksUnderTest()) {
    for (const Obstacle& obstacle : things) {
      LinkPast work(link, obstacle, seed++);
      std::vector<std::vector<Result>> results;
      for (const std::vector<Sweep>* sweeps : {&work.hits(), &work.free()}) {
        work.turnTo(*sweeps);
        results.push_back(compete(work.methods(), *sweeps, 5));
        scores.resize(results.back().size());
        names.clear();
        for (std::size_t i = 0; i < scores.size(); ++i) {
          names.push_back(results.back()[i].name);
          for (std::size_t k = 0; k < sweeps->size(); ++k)
            scores[i].add((*sweeps)[k], results.back()[i].answers[k], kLinkTolerance, 1e-6,
                          [&](const Sweep& sweep, double t) { return work.distanceAt(sweep, t); });
        }
      }
      const auto both = [&](std::size_t i) {
        const auto one = [&](int part) {
          return number(1e6 * results[static_cast<std::size_t>(part)][i].seconds / kSweepsOfAKind);
        };
        return one(0) + " / " + one(1);
      };
      const auto ratio = [](double ours, double theirs) { return number(ours / theirs, 2); };
      const auto seconds = [&](int part, std::size_t i) {
        return results[static_cast<std::size_t>(part)][i].seconds;
      };
      table.row({link.name(), std::to_string(link.mesh().triangles().size()), obstacle.name,
                 both(0), both(1), both(2),
                 ratio(seconds(0, 0), seconds(0, 2)) + " / " + ratio(seconds(1, 0), seconds(1, 2)),
                 ratio(seconds(0, 0) + seconds(1, 0), seconds(0, 2) + seconds(1, 2)), both(3)});
      apart = std::max(apart, work.apart());
    }
  }
  std::printf("\n");
  const MarkdownTable answers({"method", "right", "missed contacts", "false hits", "undecided",
                               "late by more than 1e-6 m", "unsound times"});
  for (std::size_t i = 0; i < scores.size(); ++i)
    answers.row({names[i],
                 std::to_string(scores[i].right()) + " of " + std::to_string(scores[i].sweeps),
                 std::to_string(scores[i].missed), std::to_string(scores[i].falseHits),
                 std::to_string(scores[i].undecided), std::to_string(scores[i].late),
                 std::to_string(scores[i].unsound)});
  const int wrong = scores[0].wrong() + scores[1].wrong();
  std::printf("\nposes of the two libraries differ by at most %s m\n\n%d wrong answers\n\n",
              number(apart, 2).c_str(), wrong);
  return wrong;
}
#else
inline int linkPart() {
  std::printf("## Links past obstacles\n\nskipped: what is true is found with FCL\n\n");
  return 0;
}
#endif

}  // namespace swept::benchmark
