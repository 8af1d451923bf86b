// SPDX-License-Identifier: BSD-3-Clause
#include "io/path_rows.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "io/judged_state.hpp"
#include "output/text_output.hpp"

namespace swept::detail {

void PathRows::setColumns(std::span<const std::string> names, const FailAtColumn& failAt,
                          const FailAt& fail) {
  columns_.set(names, failAt);
  columns_.requireWholeGroup(fail);
}

void PathRows::add(std::span<const double> values, int line, const FailAt& fail, bool mayJump) {
  std::vector<double> q = columns_.ofGroup(values);
  if (!mayJump) noteTurns(q, line);
  before_ = q;
  const JudgedState judged = judgeState(robot_, group_, q);
  if (!judged.problem.empty()) fail(judged.problem);
  for (const TakenToLimit& taken : judged.taken)
    taken_.note(taken.variable, limitRemark(taken), line);
  columns_.requireStill(values, q, fail);
  states_.push_back(std::move(q));
}

void PathRows::noteTurns(std::span<const double> q, int line) {
  if (before_.empty()) return;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Variable& variable = robot_.variables()[group_.variables[i]];
    const double turn = std::abs(q[i] - before_[i]);
    if (variable.cyclic && turn > std::numbers::pi)
      turns_.note(variable.name,
                  variable.name + " turns by " + shortNumber(turn) +
                      " rad, more than half a turn, from the point before: what is looked at is "
                      "the shorter way",
                  line);
  }
}

void PathRows::tellRemarks() const {
  taken_.tell([this](int line, const std::string& text) { source_.warn(line, text); });
  turns_.tell([this](int line, const std::string& text) { source_.warnOfUnchecked(line, text); });
}

}  // namespace swept::detail
