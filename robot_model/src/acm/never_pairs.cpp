// SPDX-License-Identifier: BSD-3-Clause
#include "acm/never_pairs.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "acm/never_proof.hpp"
#include "kinematics/common_ancestors.hpp"
#include "threads/for_each_index.hpp"

namespace swept::detail {

namespace {

/// Number of additions (see NeverProof::work()) that take as long as a question before its first
/// box: for the question itself, and for each of the robot's bodies.
constexpr std::int64_t kQuestionWork = 2000;
constexpr std::int64_t kBodyWork = 1;
/// Of many questions, this many are answered one after the other with the same scratch, which is
/// large for a robot with many bodies. Few questions are spread over all threads.
constexpr std::size_t kMostTogether = 16;
constexpr std::size_t kFewestTasks = 256;

class Prover {
 public:
  Prover(const Robot& robot, std::span<LinkQuestion> questions)
      : robot_(robot),
        questions_(questions),
        model_(wholeKinematics(robot)),
        start_(robot.defaultState()) {
    pieces_.resize(robot.links().size());
    for (const LinkQuestion& question : questions)
      for (const int link : {question.linkA, question.linkB})
        if (!pieces_[link]) pieces_[link] = piecesOf(robot, model_, link);
    countJoints();
  }

  std::int64_t prove(std::int64_t budget, std::int64_t mostWork, unsigned threads) {
    if (questions_.empty()) return 0;
    const std::vector<std::uint32_t> order = byJoints();
    std::int64_t left = mostWork;
    for (std::size_t first = 0; first < order.size();) {
      // Questions that are answered together must be affordable together, whatever their work turns
      // out to be. So the answers do not depend on which thread is faster, and the work exceeds its
      // limit by at most the last pairs of balls of a few questions.
      std::size_t last = first;
      for (std::int64_t owed = 0; last < order.size(); ++last) {
        owed += mostWorkOf(order[last], budget);
        if (owed > left) break;
      }
      if (last == first) break;
      left -= answerAll(std::span(order).subspan(first, last - first), budget, threads);
      first = last;
    }
    return mostWork - left;
  }

 private:
  /// Returns the work.
  std::int64_t answerAll(std::span<const std::uint32_t> questions, std::int64_t budget,
                         unsigned threads) {
    const std::size_t together =
        std::clamp<std::size_t>(questions.size() / kFewestTasks, 1, kMostTogether);
    std::vector<std::int64_t> work((questions.size() + together - 1) / together, 0);
    forEachIndex(work.size(), threads, [&](std::size_t i) {
      LinkChain::Place place;
      const std::size_t end = std::min((i + 1) * together, questions.size());
      for (std::size_t k = i * together; k < end; ++k)
        work[i] +=
            answer(questions_[questions[k]], budget, mostWorkOf(questions[k], budget), place);
    });
    return std::accumulate(work.begin(), work.end(), std::int64_t{0});
  }

  void countJoints() {
    CommonAncestors ancestors(model_);
    for (const LinkQuestion& question : questions_) {
      ancestors.setFirst(model_.bodyOfLink[question.linkA]);
      joints_.push_back(ancestors.jointsTo(model_.bodyOfLink[question.linkB]));
    }
  }

  /// Those with fewer joints first, otherwise in the given order.
  std::vector<std::uint32_t> byJoints() const {
    std::vector<std::uint32_t> next(static_cast<std::size_t>(std::ranges::max(joints_)) + 2, 0);
    for (const int joints : joints_) ++next[joints + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<std::uint32_t> order(joints_.size());
    for (std::size_t i = 0; i < joints_.size(); ++i)
      order[next[joints_[i]]++] = static_cast<std::uint32_t>(i);
    return order;
  }

  std::int64_t startWork() const {
    return kQuestionWork + kBodyWork * static_cast<std::int64_t>(model_.bodies.size());
  }
  std::int64_t mostWorkOf(std::size_t question, std::int64_t budget) const {
    return startWork() + NeverProof::usualWork(budget, static_cast<std::size_t>(joints_[question]));
  }

  /// Returns the work.
  std::int64_t answer(LinkQuestion& question, std::int64_t budget, std::int64_t mostWork,
                      LinkChain::Place& place) const {
    const LinkPieces& a = *pieces_[question.linkA];
    const LinkPieces& b = *pieces_[question.linkB];
    const LinkChain chain(robot_, model_, model_.bodyOfLink[question.linkA],
                          model_.bodyOfLink[question.linkB], question.beyond);
    if (!chain.bounded() || !a.covered() || !b.covered()) return startWork();
    chain.startFrom(start_, place);
    NeverProof proof(a, b, chain, question.margin, place);
    question.never = proof.run(budget, mostWork - startWork()) == NeverProof::State::Proven;
    return startWork() + proof.work();
  }

  const Robot& robot_;
  const std::span<LinkQuestion> questions_;
  const KinematicModel model_;
  const Eigen::VectorXd start_;
  std::vector<std::optional<LinkPieces>> pieces_;  ///< per link, of those asked about
  std::vector<int> joints_;                        ///< per question, between the two links
};

}  // namespace

std::int64_t proveNever(const Robot& robot, std::span<LinkQuestion> questions, std::int64_t budget,
                        std::int64_t mostWork, unsigned threads) {
  return Prover(robot, questions).prove(budget, mostWork, threads);
}

}  // namespace swept::detail
