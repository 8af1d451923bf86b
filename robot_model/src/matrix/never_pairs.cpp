// SPDX-License-Identifier: BSD-3-Clause
#include "matrix/never_pairs.hpp"

#include <map>

#include "kinematics/for_each_index.hpp"
#include "matrix/never_proof.hpp"

namespace swept::detail {

namespace {

class Prover {
 public:
  Prover(const Robot& robot, std::span<const LinkQuestion> questions)
      : robot_(robot), model_(wholeKinematics(robot)), start_(robot.defaultState()) {
    for (const LinkQuestion& question : questions)
      for (const int link : {question.linkA, question.linkB})
        if (!pieces_.contains(link)) pieces_.emplace(link, piecesOf(robot, model_, link));
  }

  bool prove(const LinkQuestion& question, std::int64_t budget) const {
    const LinkPieces& a = pieces_.at(question.linkA);
    const LinkPieces& b = pieces_.at(question.linkB);
    const LinkChain chain(robot_, model_, model_.bodyOfLink[question.linkA],
                          model_.bodyOfLink[question.linkB]);
    if (!chain.bounded() || !a.covered() || !b.covered()) return false;
    LinkChain::Place place;
    chain.startFrom(start_, place);
    return NeverProof(a, b, chain, question.margin, place).run(budget) == NeverProof::State::Proven;
  }

 private:
  const Robot& robot_;
  const KinematicModel model_;
  const Eigen::VectorXd start_;
  std::map<int, LinkPieces> pieces_;
};

}  // namespace

void proveNever(const Robot& robot, std::span<LinkQuestion> questions, std::int64_t budget) {
  const Prover prover(robot, questions);
  forEachIndex(questions.size(), 0,
               [&](std::size_t i) { questions[i].never = prover.prove(questions[i], budget); });
}

}  // namespace swept::detail
