// SPDX-License-Identifier: BSD-3-Clause
#include "swept/proofs/task_proof.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

#include "carried_box.hpp"
#include "input_files.hpp"
#include "message_of.hpp"
#include "swept/core/enclosing_spheres.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "transcript.hpp"
#include "verify/task.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Json = nlohmann::ordered_json;
using Kind = TaskChange::Kind;

using test::at;

class Task : public testing::Test, protected test::CarriedBox {
 protected:
  std::filesystem::path file() const { return folder_.path() / "task.json"; }
  std::string written(const std::vector<TaskPhase>& phases) const {
    try {
      return writeTask(file(), phases).missing;
    } catch (const UsageError& error) {
      const std::string place = "'" + file().string() + "'", text = error.what();
      EXPECT_TRUE(text.starts_with(place)) << text;
      return text.substr(std::min(text.size(), place.size() + 2));
    }
  }
  static std::string textOf(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  /// The refusal of the task after a change by someone who knows how to make its digests.
  std::string forged(const std::function<void(Json&)>& change) const {
    Json task = Json::parse(textOf(file()));
    change(task);
    bool whole = true;
    for (Json& phase : task["phases"]) {
      whole = whole && phase.is_object();
      if (whole) phase["digest"] = verify::phaseDigest(phase);
    }
    if (whole) task["digest"] = verify::taskDigest(task);
    return verifyTask(folder_.write("forged.json", task.dump())).refusal;
  }
  /// Likewise, by someone who does not.
  std::string changed(const std::function<void(Json&)>& change) const {
    Json task = Json::parse(textOf(file()));
    change(task);
    return verifyTask(folder_.write("changed.json", task.dump())).refusal;
  }

  test::TemporaryFolder folder_;
};

TEST_F(Task, HoldsAndSaysWhatChanges) {
  ASSERT_EQ(written(phases()), "");
  const CheckedTask task = verifyTask(file());
  ASSERT_EQ(task.refusal, "");
  ASSERT_EQ(task.phases.size(), 5U);
  const std::vector<std::vector<std::string>> changes{
      {}, {"box attached to cube"}, {}, {}, {"box placed", "map sensed"}};
  for (std::size_t i = 0; i < 5; ++i) {
    SCOPED_TRACE(i);
    EXPECT_EQ(task.phases[i].name, phases()[i].name);
    EXPECT_EQ(task.phases[i].changes, changes[i]);
    EXPECT_TRUE(task.phases[i].proof.holds());
    EXPECT_GT(task.phases[i].proof.pairs, 0U);
    EXPECT_GT(task.phases[i].proof.clearance, 0.0);
  }
  EXPECT_EQ(task.phases[1].group, "up");
  for (std::size_t i = 1; i < 5; ++i) EXPECT_EQ(task.phases[i].begin, task.phases[i - 1].end);
}

TEST_F(Task, IsNotWrittenOnceItIsStopped) {
  std::stop_source stop;
  ASSERT_EQ(writeTask(file(), phases(), stop.get_token()).missing, "");
  const std::string text = textOf(file());
  EXPECT_TRUE(verifyTask(file(), stop.get_token()).holds());
  stop.request_stop();
  EXPECT_THROW(writeTask(file(), phases(), stop.get_token()), SearchStopped);
  EXPECT_THROW(verifyTask(file(), stop.get_token()), SearchStopped);
  EXPECT_EQ(textOf(file()), text);
  std::filesystem::remove(file());
  EXPECT_THROW(writeTask(file(), phases(), stop.get_token()), SearchStopped);
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(Task, IsReadAgain) {
  const std::vector<TaskPhase> all = phases();
  ASSERT_EQ(written(all), "");
  const std::vector<TaskStep> steps = readTask(file());
  ASSERT_EQ(steps.size(), all.size());
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].name, all[i].name);
    EXPECT_EQ(steps[i].group, all[i].checker->group().name);
    EXPECT_EQ(steps[i].trajectory.variables, all[i].trajectory.variables);
    ASSERT_EQ(steps[i].trajectory.points.size(), all[i].trajectory.points.size());
    for (std::size_t k = 0; k < steps[i].trajectory.points.size(); ++k) {
      EXPECT_EQ(steps[i].trajectory.points[k].time, all[i].trajectory.points[k].time);
      EXPECT_EQ(steps[i].trajectory.points[k].positions, all[i].trajectory.points[k].positions);
      EXPECT_EQ(steps[i].trajectory.points[k].velocities, all[i].trajectory.points[k].velocities);
    }
    ASSERT_EQ(steps[i].changes.size(), all[i].changes.size());
    for (std::size_t k = 0; k < steps[i].changes.size(); ++k) {
      EXPECT_EQ(steps[i].changes[k].kind, all[i].changes[k].kind);
      EXPECT_EQ(steps[i].changes[k].body, all[i].changes[k].body);
    }
  }
}

TEST_F(Task, IsTheSameInEveryFloatingPointEnvironment) {
  const std::vector<TaskPhase> all = phases();
  test::expectSameInEveryEnvironment({{"delayed",
                                       [&](test::Transcript& t) {
                                         for (const TrajectoryPoint& point :
                                              delayed(all[0].trajectory, 0.1).points)
                                           t.add(point.time);
                                       }},
                                      {"written",
                                       [&](test::Transcript& t) {
                                         t.add(written(all));
                                         t.add(textOf(file()));
                                       }},
                                      {"read",
                                       [&](test::Transcript& t) {
                                         for (const TaskStep& step : readTask(file()))
                                           t.add(step.name, step.trajectory.points.back().time);
                                       }},
                                      {"verified", [&](test::Transcript& t) {
                                         for (const CheckedPhase& phase : verifyTask(file()).phases)
                                           t.add(phase.name, phase.end, phase.proof.clearance);
                                       }}});
}

/// A change of a good task, and what is wrong with the other one.
struct BrokenTask {
  std::function<void(std::vector<TaskPhase>&)> change;
  std::string message;
};

TEST_F(Task, ThatDoesNotJoinIsNotWritten) {
  const auto remade = [&](std::size_t i, const Checker& checker, double from, double to,
                          std::vector<TaskChange> changes) {
    return [=](std::vector<TaskPhase>& all) {
      all[i] = phase(all[i].name, checker, from, to, endOf(all[i - 1]), changes);
    };
  };
  const std::vector<TaskChange> attached{{Kind::Attached, "box"}};
  const std::vector<TaskChange> placed{{Kind::Placed, "box"}, {Kind::Sensed, "map"}};
  const auto lift = [&](const Checker& checker) { return remade(1, checker, 0.0, 0.5, attached); };
  const auto leave = [&](const Checker& checker, std::vector<TaskChange> changes) {
    return remade(4, checker, 0.0, 1.0, std::move(changes));
  };
  const auto said = [](std::size_t i, std::vector<TaskChange> changes) {
    return [=](std::vector<TaskPhase>& all) { all[i].changes = changes; };
  };
  const Checker up = checker("up", -1.2, 0), left = checker("up", 1.0, 0, 0.3);
  Isometry3d turned = at(0.2, 0, 0);
  turned.rotate(Eigen::AngleAxisd(1e-6, Eigen::Vector3d::UnitZ()));
  World moved = world(0.0);
  moved.replace("block", makeBox({0.2, 0.2, 0.2}), at(0.2, 0, -0.01));

  const std::vector<BrokenTask> broken{
      {[](auto& all) {
         all[2].trajectory = delayed(all[2].trajectory, 0.5);
         certify(all[2]);
       },
       "phase 3 (carry): it begins at 2.8000063 s, and phase 2 ends at 2.3000063 s"},
      {lift(carrying(checker("up", -1.19, 0))),
       "phase 2 (lift), joint x: it begins at -1.19, and phase 1 ends at -1.2"},
      {remade(3, carrying(checker("up", 1.0, 0)), 0.499, 0.0, {}),
       "phase 4 (lower), joint z: it begins at 0.499, and phase 3 ends at 0.5"},
      {[](auto& all) {
         all[1].trajectory.points.back().velocities[0] = 0.125;
         certify(all[1]);
       },
       "phase 3 (carry), joint z: it begins with a velocity of 0, and phase 2 ends with one of "
       "0.125"},
      {lift(carrying(up, at(0.21, 0, 0))),
       "phase 2 (lift), body box: it is 0.01 m from where it was in phase 1"},
      {lift(carrying(up, at(0.2, 0, 3e-9))),
       "phase 2 (lift), body box: it is 3e-09 m from where it was in phase 1"},
      {lift(carrying(up, turned)), "phase 2 (lift), body box: it is turned since phase 1"},
      {lift(up.withAttached("box", "cube", makeSphere(0.05), at(0.2, 0, 0))),
       "phase 2 (lift), body box: its shape is not what it was in phase 1"},
      {said(1, {}),
       "phase 2 (lift), body box: it is carried by cube, and was in the world in phase 1; no "
       "change says so"},
      {said(1, {{Kind::Placed, "box"}}),
       "phase 2 (lift), body box: it is carried by cube, and was in the world in phase 1; it is "
       "said to be placed"},
      {said(1, {{Kind::Sensed, "box"}}),
       "phase 2 (lift), body box: it is said to be sensed, and is carried by cube"},
      {said(4, {{Kind::Sensed, "box"}, {Kind::Sensed, "map"}}),
       "phase 5 (leave), body box: it is said to be sensed, and is carried by cube in phase 4"},
      {lift(up), "phase 2 (lift), body box: it is not there, and was in phase 1"},
      {leave(beside(left, 1.2).withBody("post", makeSphere(0.1), at(0, -2, 0)), placed),
       "phase 5 (leave), body post: it was not there in phase 4"},
      {leave(beside(left, 1.21), placed),
       "phase 5 (leave), body box: it is 0.01 m from where it was in phase 4"},
      {said(4, {{Kind::Placed, "box"}}),
       "phase 5 (leave), body map: it is not where it was in phase 4"},
      {leave(beside(left.withReplaced("map", makeSphere(0.2), at(0.3, 2, 0)), 1.2),
             {{Kind::Placed, "box"}}),
       "phase 5 (leave), body map: its shape is not what it was in phase 4"},
      {remade(2,
              carrying(Checker(robot_, "along", std::make_shared<const World>(moved),
                               standing(0.0, 0.5))),
              -1.2, 1.0, {}),
       "phase 3 (carry), body block: it is not where it was in phase 2"},
      {said(2, attached), "phase 3 (carry), body box: it is said to be attached, and is as it was"},
      {said(2, {{Kind::Sensed, "dog"}}), "phase 3 (carry), changes: there is no body dog"},
      {said(1, {{Kind::Attached, "box"}, {Kind::Sensed, "box"}}),
       "phase 2 (lift), changes: body box is there twice"},
      {said(0, {{Kind::Sensed, "map"}}), "phase 1 (reach), changes: no phase is before it"},
  };
  for (const BrokenTask& task : broken) {
    SCOPED_TRACE(task.message);
    std::vector<TaskPhase> all = phases();
    task.change(all);
    EXPECT_EQ(written(all), task.message);
    EXPECT_FALSE(std::filesystem::exists(file()));
  }
}

/// The same beside a cart, which comes to the way of the box once that has passed.
class TaskBesideACart : public Task {
 protected:
  static MovingObstacle cart(double from = 3.0) {
    return {.name = "cart",
            .parts = {{makeSphere(0.1), Isometry3d::Identity()}},
            .waypoints = {{0.0, at(-1.0, from, 0.5)}, {6.0, at(-1.0, 0.0, 0.5)}}};
  }
  /// `cartOf`: of each phase, counted from 0.
  std::vector<TaskPhase> besideCart(const std::function<MovingObstacle(int)>& cartOf) const {
    std::vector<TaskPhase> all = phases();
    for (std::size_t i = 0; i < all.size(); ++i) {
      all[i].checker = std::make_shared<const Checker>(
          all[i].checker->withObstacle(cartOf(static_cast<int>(i))));
      certify(all[i]);
    }
    return all;
  }
};

TEST_F(TaskBesideACart, WhatMovesIsOnTheClockOfTheTask) {
  const std::vector<TaskPhase> all = besideCart([](int) { return cart(); });
  ASSERT_EQ(written(all), "");
  const CheckedTask checked = verifyTask(file());
  ASSERT_EQ(checked.refusal, "");
  ASSERT_EQ(checked.phases.size(), 5U);
  for (const CheckedPhase& phase : checked.phases) {
    EXPECT_EQ(phase.proof.moving, std::vector<std::string>{"cart"});
    EXPECT_EQ(phase.proof.clockBegin, phase.begin);
    EXPECT_EQ(phase.proof.clockEnd, phase.end);
  }
  // Each phase by itself would begin while the cart is far away: what is proven is about its place
  // at the times of the task. When the box passes later, it meets the cart.
  std::vector<TaskPhase> late = all;
  late[2].trajectory = delayed(late[2].trajectory, 3.5);
  EXPECT_THROW(certify(late[2]), std::logic_error);

  EXPECT_EQ(forged([](Json& task) { task["phases"][2]["path"]["clock"] = -2.0; }),
            "phase 3 (carry): the clock of what moves shows -2.0 s at the task's time 0");
  EXPECT_EQ(forged([](Json& task) { task["phases"][2]["path"]["clock"] = "noon"; }),
            "phase 3 (carry): the clock of what moves shows \"noon\" s at the task's time 0");
  EXPECT_NE(forged([](Json& task) { task["phases"][2]["path"].erase("clock"); }), "");
}

TEST_F(TaskBesideACart, ItsCourseIsTheSameUnlessItIsSensed) {
  const auto fromThenOn = [&](std::size_t phase, double from, std::vector<TaskChange> changes) {
    std::vector<TaskPhase> all =
        besideCart([&](int i) { return cart(static_cast<std::size_t>(i) < phase ? 3.0 : from); });
    all[phase].changes.insert(all[phase].changes.end(), changes.begin(), changes.end());
    return written(all);
  };
  EXPECT_EQ(fromThenOn(2, 3.5, {}),
            "phase 3 (carry), body cart: it moves by itself, and not as it did in phase 2");
  EXPECT_EQ(fromThenOn(2, 3.5, {{Kind::Placed, "cart"}}),
            "phase 3 (carry), body cart: it moves by itself, and not as it did in phase 2");
  EXPECT_EQ(fromThenOn(2, 3.0, {{Kind::Attached, "cart"}}),
            "phase 3 (carry), body cart: it is said to be attached, and is as it was");
  EXPECT_EQ(fromThenOn(2, 3.5, {{Kind::Sensed, "cart"}}), "");
  EXPECT_EQ(verifyTask(file()).phases.at(2).changes, std::vector<std::string>{"cart sensed"});

  // It stands, or is not there, from a phase on.
  const auto afterwards = [&](const std::function<Checker(const Checker&)>& change) {
    std::vector<TaskPhase> all = besideCart([](int) { return cart(); });
    const std::vector<TaskPhase> without = phases();
    for (std::size_t i = 3; i < all.size(); ++i) {
      all[i].checker = std::make_shared<const Checker>(change(*without[i].checker));
      certify(all[i]);
    }
    const std::string refused = written(all);
    all[3].changes.push_back({Kind::Sensed, "cart"});
    EXPECT_EQ(written(all), "");
    return refused;
  };
  EXPECT_EQ(afterwards([](const Checker& other) {
              return other.withBody("cart", makeSphere(0.1), at(-1.0, 3.0, 0.5));
            }),
            "phase 4 (lower), body cart: it does not move by itself any more, as it did in phase "
            "3");
  EXPECT_EQ(afterwards([](const Checker& other) { return other; }),
            "phase 4 (lower), body cart: it is not there, and was in phase 3");
}

TEST_F(Task, OfTwoRobotsIsNotWritten) {
  const auto urdf = [](const std::string& upper, const std::string& size, const std::string& name) {
    const auto slide = [](const std::string& joint, const std::string& parent,
                          const std::string& child, const std::string& axis,
                          const std::string& limit) {
      return "<joint name='" + joint + "' type='prismatic'><parent link='" + parent +
             "'/><child link='" + child + "'/><axis xyz='" + axis + "'/><limit lower='-3' upper='" +
             limit + "' effort='1' velocity='1'/></joint>";
    };
    return "<robot name='" + name +
           "'><link name='base'/><link name='carriage'/><link name='cube'><collision><geometry>"
           "<box size='0.2 0.2 " +
           size + "'/></geometry></collision></link>" +
           slide("x", "base", "carriage", "1 0 0", "3") +
           slide("z", "carriage", "cube", "0 0 1", upper) + "</robot>";
  };
  const auto other = [&](const std::string& upper, const std::string& size,
                         const std::string& name) {
    std::vector<TaskPhase> all = phases();
    const Checker own(robotOf(Robot::parse(urdf(upper, size, name), "slider.urdf")), "up",
                      std::make_shared<const World>(world(0.0)), standing(1.0, 0.0));
    all[3] = phase("lower", carrying(own), 0.5, 0.0, endOf(all[2]));
    const std::string before = written(all);
    return before;
  };
  EXPECT_EQ(other("3", "0.2", "slider"), "");
  EXPECT_EQ(other("3", "0.21", "slider"),
            "phase 4 (lower), body cube: its shape is not what it was in phase 3");
  EXPECT_EQ(other("3", "0.2", "glider"), "phase 4 (lower): its robot is not that of the task");
  std::vector<TaskPhase> all = phases();
  const Checker own(robotOf(Robot::parse(urdf("2", "0.2", "slider"), "slider.urdf")), "up",
                    std::make_shared<const World>(world(0.0)), standing(-1.2, 0.0));
  all.erase(all.begin() + 2, all.end());
  all.push_back(phase("lower", carrying(own), 0.5, 0.0, endOf(all[1])));
  EXPECT_EQ(written(all),
            "phase 3 (lower), joint z: it is not moved by the same variable with the same limits "
            "as in phase 2");
}

TEST_F(Task, NeedsPhasesThatAreProven) {
  EXPECT_EQ(written({}), "a task has one phase or more");
  std::vector<TaskPhase> all = phases();
  all[2].certificate.verdict = Verdict::Undecided;
  EXPECT_EQ(written(all),
            "phase 3 (carry): there is no proof of a trajectory that is not free: it "
            "is undecided");
  all = phases();
  all[1].checker = nullptr;
  EXPECT_EQ(test::messageOf([&] { writeTask(file(), all); }), "phase 2 (lift) has no checker");
  EXPECT_THROW(writeTask(folder_.path() / "task.yaml", phases()), UsageError);
}

/// What is changed by someone who makes the digests of phases and task anew, but has no proof.
TEST_F(Task, ThatIsForgedIsRefused) {
  ASSERT_EQ(written(phases()), "");
  ASSERT_EQ(forged([](Json&) {}), "");
  const auto points = [](Json& task, std::size_t i) -> Json& {
    return task["phases"][i]["path"]["trajectory"]["points"];
  };
  const auto body = [](Json& task, std::size_t i, const std::string& name) -> Json& {
    for (Json& own : task["phases"][i]["path"]["model"]["bodies"])
      if (own["name"] == name) return own;
    throw std::logic_error("no body " + name);
  };
  const std::vector<std::pair<std::function<void(Json&)>, std::string>> cases{
      {[](Json& task) { task["phases"][1]["changes"] = Json::array(); },
       "phase 2 (lift), body box: it is carried by cube, and was in the world in phase 1; no "
       "change says so"},
      {[](Json& task) { task["phases"][4]["changes"].erase(1); },
       "phase 5 (leave), body map: it is not where it was in phase 4"},
      {[](Json& task) { task["phases"].erase(2); },
       "phase 3 (lower): it begins at 5.000014 s, and phase 2 ends at 2.3000063 s"},
      {[](Json& task) { std::swap(task["phases"][1], task["phases"][3]); },
       "phase 2 (lower): it begins at 5.000014 s, and phase 1 ends at 1.3000028 s"},
      {[&](Json& task) { points(task, 2)[0]["time"] = 2.3; },
       "phase 3 (carry), point 1, time: is not as it was when the path was certified"},
      {[&](Json& task) { points(task, 2)[0]["positions"][0] = -1.19; },
       "phase 3 (carry), point 1, x, position: is not as it was when the path was certified"},
      {[&](Json& task) { points(task, 2)[0]["velocities"][0] = 0.1; },
       "phase 3 (carry), point 1, x, velocity: is not as it was when the path was certified"},
      {[&](Json& task) { body(task, 1, "box")["shapes"][0]["pose"][9] = 0.25; },
       "phase 2 (lift), body box: is not as it was when the path was certified"},
      {[&](Json& task) { body(task, 1, "box")["link"] = "carriage"; },
       "phase 2 (lift), body box: is not as it was when the path was certified"},
      {[&](Json& task) { body(task, 4, "map")["shapes"][0]["radius"] = 0.05; },
       "phase 5 (leave), body map: is not as it was when the path was certified"},
      {[](Json& task) { task["phases"][3]["path"]["model"]["joints"][0]["values"][0] = 1.01; },
       "phase 4 (lower), joint x: is not as it was when the path was certified"},
      {[](Json& task) { task["phases"][3]["path"]["model"]["links"][0] = "ground"; },
       "phase 4 (lower), rules: the group, its limits, margins, tolerances or pairs that may touch "
       "are not as they were when the path was certified"},
      {[](Json& task) { task["robot"] = "other"; },
       "phase 1 (reach): its robot is not that of the task"},
      {[](Json& task) { task["phases"][0]["path"]["robot"] = "other"; },
       "phase 1 (reach), path file, robot: is not as it was when the path was certified"},
      {[](Json& task) { task["phases"][0]["path"].erase("trajectory"); },
       "phase 1 (reach): there is no trajectory"},
      {[](Json& task) { task["phases"][0]["path"].erase("model"); },
       "phase 1 (reach): there is no model"},
      {[](Json& task) { task["phases"][0]["path"].erase("proof"); },
       "phase 1 (reach), path: there is no proof"},
      {[](Json& task) { task["phases"][0]["path"] = "path.json"; },
       "phase 1 (reach), path: not an object"},
      {[](Json& task) { task["phases"][0]["phase"] = 1; }, "phase 1: its name is not a text"},
      {[](Json& task) { task["phases"][0].erase("changes"); }, "phase 1: there is no changes"},
      {[](Json& task) { task["phases"][0]["pause"] = 3; }, "phase 1: it has no pause"},
      {[](Json& task) { task["phases"][1]["changes"] = "box"; },
       "phase 2 (lift): changes is not a list"},
      {[](Json& task) { task["phases"][1]["changes"][0]["change"] = "thrown"; },
       "phase 2 (lift), changes: \"thrown\" is none of attached, placed and sensed"},
      {[](Json& task) { task["phases"][1]["changes"][0]["to"] = "cube"; },
       "phase 2 (lift), changes: not a body and a change: "
       "{\"body\":\"box\",\"change\":\"attached\",\"to\":\"cube\"}"},
      {[](Json& task) { task["phases"][1]["changes"][0]["body"] = 7; },
       "phase 2 (lift), changes: not a text: 7"},
      {[](Json& task) { task["phases"][1] = 3; }, "phase 2: not an object"},
      {[](Json& task) { task["phases"] = Json::array(); }, "task: there is no phase"},
      {[](Json& task) { task["seed"] = 1; }, "task: it has no seed"}};
  for (const auto& [change, message] : cases) {
    SCOPED_TRACE(message);
    EXPECT_EQ(forged(change), message);
  }
}

/// What leaves valid proofs and joins is not what was written all the same.
TEST_F(Task, ThatWasChangedIsRefused) {
  ASSERT_EQ(written(phases()), "");
  ASSERT_EQ(changed([](Json&) {}), "");
  EXPECT_EQ(changed([](Json& task) { task["phases"][2]["phase"] = "fly"; }),
            "phase 3 (fly): it is not as it was when the task was written");
  EXPECT_EQ(changed([](Json& task) {
              task["phases"][3]["changes"] = {{{"body", "map"}, {"change", "sensed"}}};
            }),
            "phase 4 (lower): it is not as it was when the task was written");
  EXPECT_EQ(changed([](Json& task) { task["phases"].erase(4); }),
            "task: its phases are not those that it was written with");
  EXPECT_EQ(changed([](Json& task) { task["digest"] = "00"; }),
            "task: its phases are not those that it was written with");
  EXPECT_EQ(changed([](Json& task) { task["phases"][0]["digest"] = "00"; }),
            "phase 1 (reach): it is not as it was when the task was written");
}

TEST_F(Task, ThatIsNoneIsNotRead) {
  const auto message = [&](const std::string& text) {
    const auto other = folder_.write("other.json", text);
    const std::string read = test::inputError([&] { readTask(other); });
    const std::string place = other.string();
    EXPECT_TRUE(read.starts_with(place)) << read;
    return read.substr(std::min(place.size(), read.size()));
  };
  EXPECT_EQ(message("{}"), ": error: it is no task: there are no phases");
  EXPECT_EQ(
      test::inputError([&] { verifyTask(folder_.path() / "other.json"); }),
      (folder_.path() / "other.json").string() + ": error: it is no task: there are no phases");
  EXPECT_EQ(message("[1]"), ": error: it is no task: there are no phases");
  const std::string path =
      R"("path": {"group": "g", "trajectory": {"variables": ["x"], "points": [)";
  EXPECT_EQ(message(R"({"phases": [{"phase": "a", "changes": [], )" + path + "]}}}]}"),
            ": error: phases[0].path.trajectory is no trajectory: controllerCurve: the trajectory "
            "has no point");
  EXPECT_EQ(message(R"({"phases": [{"phase": "a", "changes": [{"body": "b", "change": "c"}], )" +
                    path + R"({"time": 0, "positions": [1]}, {"time": 1, "positions": [1]}]}}}]})"),
            ": error: phases[0].changes[0].change is \"c\"; it must be attached, placed or sensed");
}

}  // namespace
}  // namespace swept
