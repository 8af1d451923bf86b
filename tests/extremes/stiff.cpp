// SPDX-License-Identifier: BSD-3-Clause
#include "stiff.hpp"

#include "core/error_table_reproducer.hpp"
#include "stiff_sample.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"

namespace extremes {

namespace {

using error_table::Reproducer;

constexpr int kStiffSamples = 80;

/// Relative to the reach: what a witness may be off by.
constexpr double kWitness = 1e-12;

double slackOf(const StiffSample& sample) {
  const auto joints = static_cast<double>(sample.from.size());
  return kWitness * sample.reach * std::max(1.0, joints);
}

std::string describe(const StiffSample& sample, const std::string& found) {
  std::string text = "  // from " + Reproducer::numbers(sample.from) + " to " +
                     Reproducer::numbers(sample.to) + ", tolerance " +
                     Reproducer::number(sample.checker->options().tolerance) + ": " + found +
                     "; the truth is a least distance of " + sample.least.str(25);
  if (sample.contact) text += " and contact at " + sample.contact->str(25);
  for (const swept::WorldBody& body : sample.checker->world().bodies()) {
    text += "; " + body.name + " at " +
            Reproducer::numbers({body.parts[0].world_from_shape.translation().x(),
                                 body.parts[0].world_from_shape.translation().y(),
                                 body.parts[0].world_from_shape.translation().z()});
  }
  return text + "\n";
}

/// The start or, where there is a contact, a t at which it lasts.
double stateOf(const StiffSample& sample) {
  if (!sample.contact) return 0.0;
  const double first = sample.contact->convert_to<double>();
  for (double later = 1e-2; later > 1e-12; later /= 10.0) {
    const double t = std::min(1.0, first + later);
    if (sample.distance(t) < -2.0 * slackOf(sample)) return t;
  }
  return first;
}

Answer judgeState(const StiffSample& sample, swept::Workspace& workspace) {
  const double t = stateOf(sample);
  const Eigen::VectorXd q = sample.checker->interpolate(sample.from, sample.to, t);
  const std::vector<double> values(q.begin(), q.end());
  Answer answer;
  const auto found =
      timed([&] { return sample.checker->checkState(values, workspace); }, answer.seconds);
  const Real truth = sample.distance(t);
  const bool near = abs(truth) <= slackOf(sample);
  answer.apart = truth > 0;
  if (found == swept::Verdict::Undecided) {
    answer.outcome = near ? Outcome::Undecided : Outcome::Far;
  } else if ((found == swept::Verdict::Free) != answer.apart) {
    // The state is rounded.
    answer.outcome = near ? Outcome::Undecided : Outcome::Wrong;
    answer.honest = near || answer.apart;
  }
  if (answer.outcome != Outcome::Right) {
    answer.text = describe(sample, "checkState at " + Reproducer::number(t) + " gives " +
                                       std::string(swept::toString(found)));
  }
  return answer;
}

Outcome outcomeOf(const swept::MotionCertificate& found, const StiffSample& sample) {
  const double near = sample.checker->options().tolerance + slackOf(sample);
  if (found.verdict == swept::Verdict::Undecided) {
    return abs(sample.least) <= near ? Outcome::Undecided : Outcome::Far;
  }
  if (found.verdict == swept::Verdict::Free) {
    return sample.contact ? Outcome::Wrong : Outcome::Right;
  }
  if (!sample.contact) {
    return sample.least <= slackOf(sample) ? Outcome::Undecided : Outcome::Wrong;
  }
  return Outcome::Right;
}

/// Free until no later than the first contact; the witness is a contact, and not before the first.
bool isHonest(const swept::MotionCertificate& found, const StiffSample& sample) {
  if (found.verdict == swept::Verdict::Free && sample.contact) return false;
  if (sample.contact && Real(found.freeUntil) > *sample.contact) return false;
  if (!found.witness) return found.verdict != swept::Verdict::Collision;
  return sample.distance(found.witness->t) <= slackOf(sample);
}

Answer judgeMotion(const StiffSample& sample, swept::Workspace& workspace) {
  Answer answer;
  const swept::MotionCertificate found =
      timed([&] { return sample.checker->certifyMotion(sample.from, sample.to, workspace); },
            answer.seconds);
  answer.apart = !sample.contact;
  answer.work = found.effort.intervals + found.effort.lanes + found.effort.distances;
  answer.honest = isHonest(found, sample);
  answer.outcome = answer.honest ? outcomeOf(found, sample) : Outcome::Wrong;
  if (found.witness && sample.contact) {
    const double scale = sample.path / sample.reach;
    const Real late = abs(Real(found.witness->t) - *sample.contact);
    answer.error = late.convert_to<double>() * scale;
    answer.bound = (found.witness->t - found.freeUntil) * scale;
  }
  if (answer.outcome != Outcome::Right) {
    answer.text = describe(
        sample, "certifyMotion gives " + std::string(swept::toString(found.verdict)) +
                    ", free until " + Reproducer::number(found.freeUntil) + ", witness at " +
                    (found.witness ? Reproducer::number(found.witness->t) : "none") + ", " +
                    std::to_string(answer.work) + " steps");
  }
  return answer;
}

Answer judgeClearance(const StiffSample& sample, swept::Workspace& workspace) {
  Answer answer;
  const double accuracy =
      sample.accuracy > 0.0 ? sample.accuracy : 10.0 * sample.checker->options().tolerance;
  const swept::MotionClearance found = timed(
      [&] { return sample.checker->motionClearance(sample.from, sample.to, accuracy, workspace); },
      answer.seconds);
  const Real truth = std::max(Real(0), sample.least);
  const double slack = slackOf(sample);
  answer.apart = sample.least > 0;
  answer.work = found.intervals;
  answer.error = abs(Real(found.upper) - truth).convert_to<double>() / sample.reach;
  answer.bound = (found.upper - found.lower) / sample.reach;
  const Real attained = std::max(Real(0), sample.distance(found.t));
  answer.honest = Real(found.lower) <= truth && Real(found.upper) >= truth - slack &&
                  abs(attained - Real(found.upper)) <= slack;
  if (!answer.honest) {
    answer.outcome = Outcome::Wrong;
  } else if (!(found.upper - found.lower <= accuracy + slack)) {
    answer.outcome = Outcome::Far;
  } else if (truth > 0 && !(found.lower > 0.0)) {
    answer.outcome = truth <= accuracy ? Outcome::Undecided : Outcome::Far;
  }
  if (answer.outcome != Outcome::Right) {
    answer.text = describe(sample, "motionClearance gives [" + Reproducer::number(found.lower) +
                                       ", " + Reproducer::number(found.upper) + "] at " +
                                       Reproducer::number(found.t));
  }
  return answer;
}

/// As judgeMotion(), of the ball and the post without a robot.
Answer judgeSpin(const Spin& spin) {
  const auto still = swept::UniformMotion::still(spin.place);
  const auto moving = swept::UniformMotion::turning(
      Isometry3d(Eigen::Translation3d(spin.lever, 0.0, 0.0)), Vector3d(0.0, 0.0, spin.turn),
      Vector3d(0.0, 0.0, spin.up), Vector3d(-spin.lever, 0.0, 0.0));
  swept::ContinuousOptions options;
  options.tolerance = spin.tolerance;
  Answer answer;
  const swept::ContinuousResult found = timed(
      [&] {
        return swept::continuousCollide(spin.post, still, swept::Sphere{spin.ball}, moving,
                                        options);
      },
      answer.seconds);
  const double slack = kWitness * spin.lever;
  const bool seen = found.verdict == swept::Verdict::Collision;
  answer.apart = !spin.contact;
  answer.work = found.effort.intervals + found.effort.volumeTests + found.effort.leafTests;
  answer.honest = (!spin.contact || (Real(found.freeUntil) <= *spin.contact &&
                                     found.verdict != swept::Verdict::Free)) &&
                  (!seen || spin.distance(found.contactBy) <= slack);
  const Real least = abs(spin.least);
  if (!answer.honest) {
    answer.outcome = Outcome::Wrong;
  } else if (found.verdict == swept::Verdict::Undecided) {
    answer.outcome = least <= spin.tolerance + slack ? Outcome::Undecided : Outcome::Far;
  } else if (seen && !spin.contact) {
    answer.outcome = least <= slack ? Outcome::Undecided : Outcome::Wrong;
  } else if (seen) {
    const double path = std::abs(spin.turn);
    answer.error = abs(Real(found.contactBy) - *spin.contact).convert_to<double>() * path;
    answer.bound = (found.contactBy - found.freeUntil) * path;
  }
  if (answer.outcome != Outcome::Right) {
    answer.text =
        "  // lever " + Reproducer::number(spin.lever) + ", ball " + Reproducer::number(spin.ball) +
        ", post " + Reproducer::number(spin.post.radius) + " at " +
        Reproducer::numbers({spin.place.translation().x(), spin.place.translation().y()}) +
        ", turn " + Reproducer::number(spin.turn) + ", up " + Reproducer::number(spin.up) +
        ": continuousCollide gives " + std::string(swept::toString(found.verdict)) +
        ", free until " + Reproducer::number(found.freeUntil) + ", contact by " +
        Reproducer::number(found.contactBy) + "; the truth is a least distance of " +
        spin.least.str(25) + "\n";
  }
  return answer;
}

Row rowOf(const std::string& query, const StiffCase& from, bool countsWork) {
  Row row;
  row.query = query;
  row.name = from.name;
  row.baseline = from.baseline;
  row.workLimit = from.workLimit;
  row.bothSides = from.bothSides;
  row.countsWork = countsWork;
  return row;
}

void measure(const StiffCase& from, std::vector<Row>& rows) {
  Random random(seedOf(from.name));
  Row state = rowOf("checkState", from, false);
  state.hasBound = false;
  Row motion = rowOf("certifyMotion", from, true);
  Row clearance = rowOf("motionClearance", from, true);
  if (from.clearanceLimit > 0.0) clearance.workLimit = from.clearanceLimit;
  Row spin = rowOf("continuousCollide", from, true);
  // Without the ceiling more of them are free.
  spin.bothSides = false;
  for (int i = 0; i < kStiffSamples; ++i) {
    const StiffSample sample = from.draw(random, i);
    swept::Workspace workspace(*sample.checker);
    state.add(judgeState(sample, workspace));
    motion.add(judgeMotion(sample, workspace));
    clearance.add(judgeClearance(sample, workspace));
    if (sample.spin) spin.add(judgeSpin(*sample.spin));
  }
  rows.push_back(std::move(state));
  rows.push_back(std::move(motion));
  rows.push_back(std::move(clearance));
  if (spin.n > 0) rows.push_back(std::move(spin));
}

}  // namespace

void stiffRows(std::vector<Row>& rows) {
  for (const auto& group : {turnCases(), slideCases()}) {
    for (const StiffCase& one : group) measure(one, rows);
  }
}

}  // namespace extremes
