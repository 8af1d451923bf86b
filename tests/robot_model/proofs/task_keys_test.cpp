// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "format_table.hpp"
#include "input_files.hpp"
#include "swept/proofs/task_proof.hpp"

namespace swept {
namespace {

using test::KeyCase;

TEST(TaskKeys, AsReadTaskTreatsThem) {
  const auto task = [](const std::string& phase, const std::string& path, const std::string& points,
                       const std::string& more) {
    return "{\"phases\": [{" + phase + ", \"path\": {" + path +
           ", \"trajectory\": {\"variables\": [\"x\"], \"points\": [" + points + "]}}}]" + more +
           "}";
  };
  const std::string phase = R"("phase": "lift", "changes": [])", path = R"("group": "arm")";
  const std::string first = R"({"time": 0, "positions": [0]}, )";
  const std::string points = first + R"({"time": 1, "positions": [1]})";
  const std::string plain = task(phase, path, points, "");
  const auto point = [&](const char* key, const std::string& text) {
    return KeyCase{std::string("phases/path/trajectory/points/") + key, plain,
                   task(phase, path, first + text, "")};
  };
  const auto changed = [&](const std::string& change) {
    return task(R"("phase": "lift", "changes": [)" + change + "]", path, points, "");
  };
  const std::string cup = R"({"body": "cup", "change": "attached"})";
  test::walkFormat(
      "Task (.json)",
      {{"robot", plain, task(phase, path, points, R"(, "robot": "rook7")")},
       {"digest", plain, task(phase, path, points, R"(, "digest": "00")")},
       {"phases", plain, R"({"phases": []})"},
       {"phases/phase", plain, task(R"("phase": "carry", "changes": [])", path, points, "")},
       {"phases/digest", plain, task(phase + R"(, "digest": "00")", path, points, "")},
       {"phases/changes", plain, changed(cup)},
       {"phases/changes/body", changed(cup), changed(R"({"body": "nut", "change": "attached"})")},
       {"phases/changes/change", changed(cup), changed(R"({"body": "cup", "change": "placed"})")},
       {"phases/path", plain, task(phase, R"("group": "hand")", points, "")},
       {"phases/path/group", plain, task(phase, R"("group": "hand")", points, "")},
       {"phases/path/trajectory", plain,
        task(phase, path, first + R"({"time": 2, "positions": [1]})", "")},
       {"phases/path/trajectory/variables", plain,
        R"({"phases": [{"phase": "lift", "changes": [], "path": {"group": "arm", "trajectory": )"
        R"({"variables": ["y"], "points": [)" +
            points + "]}}}]}"},
       point("time", R"({"time": 2, "positions": [1]})"),
       point("positions", R"({"time": 1, "positions": [2]})"),
       point("velocities", R"({"time": 1, "positions": [1], "velocities": [3]})"),
       point("accelerations", R"({"time": 1, "positions": [1], "accelerations": [3]})"),
       {"phases/path/other key", plain, task(phase, path + R"(, "proof": "other")", points, "")}},
      [](const std::string& text) {
        const test::TemporaryFolder folder;
        std::ostringstream all;
        for (const TaskStep& step : readTask(folder.write("task.json", text))) {
          all << step.name << ' ' << step.group;
          for (const TaskChange& change : step.changes)
            all << ' ' << static_cast<int>(change.kind) << change.body;
          for (const std::string& name : step.trajectory.variables) all << ' ' << name;
          for (const TrajectoryPoint& own : step.trajectory.points)
            for (const std::vector<double>& list : {std::vector<double>{own.time}, own.positions,
                                                    own.velocities, own.accelerations}) {
              for (const double value : list) all << ' ' << value;
              all << ';';
            }
          all << '\n';
        }
        return all.str();
      });
}

}  // namespace
}  // namespace swept
