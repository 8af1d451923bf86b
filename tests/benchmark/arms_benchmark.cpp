// SPDX-License-Identifier: BSD-3-Clause
// Table V of Pan, Chitta, Manocha 2012: 1000 configurations of each arm of a PR2 among 100
// obstacles of one kind, up to the first hit. The kinematics are done before, for everyone. Exit
// code 1 if an answer of ours differs from the expected one.
#include <cstdlib>

#include "arm_workload.hpp"
#include "data_folder.hpp"
#include "fcl_peer.hpp"
#include "ode_peer.hpp"
#include "swept/core/broadphase/body_tree.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

constexpr int kTurns = 7;

/// '0' or '1' per configuration of each arm.
using Answers = std::map<std::string, std::string>;

class OurScene {
 public:
  OurScene(const Arm& arm, const std::vector<Obstacle>& obstacles) : arm_(arm) {
    std::vector<BodyTree::Body> bodies;
    for (const Obstacle& obstacle : obstacles)
      bodies.push_back({static_cast<int>(bodies.size()), obstacle.shape, obstacle.pose});
    tree_ = BodyTree(std::move(bodies));
  }
  bool collides(const std::vector<Eigen::Isometry3d>& poses) const {
    for (std::size_t i = 0; i < arm_.links.size(); ++i)
      if (tree_.collides(arm_.links[i], poses[i]).status != Contact::Separate) return true;
    return false;
  }

 private:
  const Arm& arm_;
  BodyTree tree_;
};

#ifdef SWEPT_HAS_FCL
template <typename Volume>
std::shared_ptr<fcl::CollisionGeometryd> fclGeometry(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape))
    return std::make_shared<fcl::Boxd>(Eigen::Vector3d(2.0 * box->halfExtents));
  if (const auto* sphere = std::get_if<Sphere>(&shape))
    return std::make_shared<fcl::Sphered>(sphere->radius);
  if (const auto* cylinder = std::get_if<Cylinder>(&shape))
    return std::make_shared<fcl::Cylinderd>(cylinder->radius, 2.0 * cylinder->halfLength);
  const auto& mesh = std::get<TriangleMesh>(shape);
  return fclModel<Volume>({mesh.vertices(), mesh.triangles()});
}

/// A dynamic tree for the obstacles and one for the arm, one against the other: FCL's fastest way.
template <typename Volume>
class FclScene {
 public:
  FclScene(const Arm& arm, const std::vector<Obstacle>& obstacles) {
    for (const Obstacle& obstacle : obstacles)
      add(fclGeometry<Volume>(obstacle.shape), obstacle.pose, obstacles_);
    for (const Shape& link : arm.links) {
      add(fclGeometry<Volume>(link), Eigen::Isometry3d::Identity(), links_);
      moving_.push_back(objects_.back().get());
    }
    obstacles_.setup();
    links_.setup();
  }
  bool collides(const std::vector<Eigen::Isometry3d>& poses) {
    for (std::size_t i = 0; i < moving_.size(); ++i) {
      moving_[i]->setTransform(fcl::Transform3d(poses[i]));
      moving_[i]->computeAABB();
    }
    links_.update();
    bool hit = false;
    obstacles_.collide(&links_, &hit, onPair);
    return hit;
  }

 private:
  static bool onPair(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data) {
    static const fcl::CollisionRequestd request(1, false);
    fcl::CollisionResultd result;
    bool& hit = *static_cast<bool*>(data);
    hit = hit || fcl::collide(a, b, request, result) > 0;
    return hit;
  }
  void add(const std::shared_ptr<fcl::CollisionGeometryd>& geometry, const Eigen::Isometry3d& pose,
           fcl::DynamicAABBTreeCollisionManagerd& manager) {
    objects_.push_back(std::make_unique<fcl::CollisionObjectd>(geometry, fcl::Transform3d(pose)));
    manager.registerObject(objects_.back().get());
  }

  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  std::vector<fcl::CollisionObjectd*> moving_;
  fcl::DynamicAABBTreeCollisionManagerd obstacles_, links_;
};
#endif

/// Both arms through one scene each, in turns with the others.
template <typename Scene>
void enter(std::vector<Contestant>& contestants, std::vector<Answers>& answers,
           const std::string& name, const ArmWorkload& work,
           const std::vector<std::shared_ptr<Scene>>& scenes) {
  const std::size_t index = answers.size();
  answers.emplace_back();
  contestants.push_back({name, [&work, &answers, scenes, index] {
                           for (std::size_t k = 0; k < work.arms.size(); ++k) {
                             const Arm& arm = work.arms[k];
                             std::string& bits = answers[index][arm.name];
                             bits.assign(arm.poses.size(), '0');
                             for (std::size_t i = 0; i < arm.poses.size(); ++i)
                               if (scenes[k]->collides(arm.poses[i])) bits[i] = '1';
                           }
                         }});
}

struct Score {
  int falseHits = 0;
  int missed = 0;
};

Score scoreOf(const ArmWorkload& work, const std::string& kind, const Answers& answers) {
  Score score;
  for (const Arm& arm : work.arms) {
    const std::string truth = work.truth(arm, kind);
    const std::string& bits = answers.at(arm.name);
    for (std::size_t i = 0; i < truth.size(); ++i) {
      score.falseHits += bits.at(i) == '1' && truth[i] == '0';
      score.missed += bits.at(i) == '0' && truth[i] == '1';
    }
  }
  return score;
}

int measure(const ArmWorkload& work, const std::string& kind, const MarkdownTable& table) {
  const std::vector<Obstacle>& obstacles = work.obstacles.at(kind);
  std::vector<Contestant> contestants;
  std::vector<Answers> answers;
  answers.reserve(8);
  const auto enterAll = [&]<typename Scene>(const std::string& name, std::type_identity<Scene>) {
    std::vector<std::shared_ptr<Scene>> scenes;
    for (const Arm& arm : work.arms) scenes.push_back(std::make_shared<Scene>(arm, obstacles));
    enter(contestants, answers, name, work, scenes);
  };
  enterAll("swept", std::type_identity<OurScene>{});
#ifdef SWEPT_HAS_FCL
  enterAll("FCL OBB", std::type_identity<FclScene<fcl::OBBd>>{});
  enterAll("FCL OBBRSS", std::type_identity<FclScene<fcl::OBBRSSd>>{});
#endif
#ifdef SWEPT_HAS_ODE
  std::vector<std::shared_ptr<OdeScene>> scenes;
  for (const Arm& arm : work.arms) {
    auto scene = std::make_shared<OdeScene>();
    for (const Obstacle& obstacle : obstacles) scene->addObstacle(obstacle.shape, obstacle.pose);
    for (const Shape& link : arm.links) scene->addLink(link);
    scenes.push_back(scene);
  }
  enter(contestants, answers, "ODE", work, scenes);
#endif
  takeTurns(contestants, kTurns);

  const double thousands = static_cast<double>(work.arms.size());
  std::vector<std::string> cells{kind};
  int wrong = 0;
  for (std::size_t k = 0; k < contestants.size(); ++k) {
    const Score score = scoreOf(work, kind, answers[k]);
    std::string text = number(1e3 * contestants[k].seconds / thousands);
    if (score.falseHits + score.missed > 0)
      text += " (" + std::to_string(score.missed) + " missed, " + std::to_string(score.falseHits) +
              " false)";
    cells.push_back(text);
    if (k == 0) wrong = score.falseHits + score.missed;
  }
  const Contestant* peer = bestPeer(contestants);
  cells.push_back(peer == nullptr ? "-" : number(contestants[0].seconds / peer->seconds, 2));
  table.row(cells);
  return wrong;
}

int run() {
  const auto data = dataFolder();
  if (!data) {
    std::printf("skipped: SWEPT_DATA is not set\n");
    return EXIT_SUCCESS;
  }
  const ArmWorkload work = readArmWorkload(*data);
  std::vector<std::string> head{"obstacles", "swept, ms / 1000"};
#ifdef SWEPT_HAS_FCL
  head.insert(head.end(), {"FCL OBB", "FCL OBBRSS"});
#endif
#ifdef SWEPT_HAS_ODE
  head.emplace_back("ODE");
  dInitODE2(0);
  dSetMessageHandler([](int, const char*, va_list) {});  // printing would be timed
  dAllocateODEDataForThread(dAllocateMaskAll);
#endif
  head.emplace_back("ratio to the best");
  const MarkdownTable table(head);
  int wrong = 0;
  for (const char* kind : {"box", "sphere", "cylinder", "mesh"})
    wrong += measure(work, kind, table);
  std::printf("\n%d wrong answers\n", wrong);
#ifdef SWEPT_HAS_ODE
  dCloseODE();
#endif
  return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace swept::benchmark

int main() {
  return swept::benchmark::run();
}
