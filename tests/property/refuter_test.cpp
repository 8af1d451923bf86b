// SPDX-License-Identifier: BSD-3-Clause
// For each model and scene: a thousand random motions, every Free one sampled at 1e-3 rad by code
// that shares nothing with the checker. One overlap fails, with a command line that replays it.
#include "refuter.hpp"
#include "models_dir.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <set>
#include <stdexcept>

#include "data_folder.hpp"
#include "models_under_test.hpp"

namespace {

const std::filesystem::path kModels = modelsDir();

std::vector<std::filesystem::path> scenes() {
  std::vector<std::filesystem::path> found;
  for (const auto& entry : std::filesystem::directory_iterator(kModels / "scenes"))
    if (entry.path().extension() == ".yaml") found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Scenario> scenariosOf(const Model& model) {
  std::vector<Scenario> all;
  ScenarioFiles files = filesOf(model);
  for (const auto& scene : scenes()) {
    files.scene = scene;
    all.push_back(loadScenario(files));
  }
  files.scene.clear();
  all.push_back(clutterScenario(files, 7));
  return all;
}

class Refuter : public testing::TestWithParam<Model> {};

TEST_P(Refuter, FindsNothingToRefute) {
  RefuterReport total;
  std::uint64_t seed = 1;
  for (const Scenario& scenario : scenariosOf(GetParam())) {
    RefuterOptions options;
    options.seed = seed++;
    options.skew = 3.5;
    const RefuterReport report = refute(scenario, options);
    std::cout << scenario.worldArguments << ": " << summary(report) << std::endl;
    for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
    EXPECT_EQ(report.motions, options.motions);
    total.add(report);
  }
  std::cout << "all: " << summary(total) << std::endl;
  // The suite says something only if it has free motions, blocked ones, and close calls.
  EXPECT_GT(total.free, 0.2 * total.motions);
  EXPECT_LT(total.free, 0.8 * total.motions);
  EXPECT_GT(total.grazing, 0.1 * total.motions);
  EXPECT_LT(total.undecidedAnywhere, 0.005 * total.motions);
}

TEST_P(Refuter, MarginsAreKeptToo) {
  ScenarioFiles files = filesOf(GetParam());
  swept::CheckerOptions options;
  options.margin = 0.01;
  const Scenario scenario = clutterScenario(files, 11, options);
  RefuterOptions refuter;
  refuter.motions = 150;
  refuter.skew = 3.5;
  const RefuterReport report = refute(scenario, refuter);
  std::cout << summary(report) << std::endl;
  for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  EXPECT_GE(report.leastRoomOfFree, 0);
  EXPECT_GT(report.free, 15);
}

/// A refuter that cannot refute proves nothing: here its world is not quite the checker's.
TEST_P(Refuter, NoticesAMillimetre) {
  Scenario scenario = clutterScenario(filesOf(GetParam()), 7);
  std::vector<oracle::Body> world = scenario.oracle->world();
  for (oracle::Body& body : world)
    for (oracle::Piece& piece : body.pieces) piece.body_from_piece.translation().z() += 1e-3;
  scenario.oracle =
      std::make_unique<oracle::Oracle>(scenario.oracle->arm(), std::move(world), scenario.group);
  RefuterOptions options;
  options.motions = 200;
  options.skew = 3.5;
  const RefuterReport report = refute(scenario, options);
  const auto says = [&](const char* what) {
    return std::count_if(report.failures.begin(), report.failures.end(), [&](const auto& failure) {
      return failure.find(what) != std::string::npos;
    });
  };
  EXPECT_GT(says("REFUTED"), 0);
  EXPECT_GT(says("the witness does not hold"), 0);
}

/// Motions whose proven prefix once passed over a contact: intervals left open that overlap, of
/// several pairs.
TEST(RefutedOnce, ProvenPrefixesEndBeforeTheContact) {
  const Scenario scenario = clutterScenario(filesOf({"rook6_cart", "whole_body"}), 6);
  const std::pair<std::vector<double>, std::vector<double>> motions[] = {
      {{0.071572628301518143, -0.07050639900162764, 1.6001372831577481, 1.1280240908661643,
        2.1009631679703951, -1.7159288205204637, -2.0429753579562275, -1.8064253704678197,
        2.500043334365186},
       {-0.22506925073570314, -0.39110982613954232, 2.6491110697560876, 1.1702870776240399,
        1.220732883020158, -1.6780934268675325, -2.1376489828629839, 0.44320432954312294,
        3.4573052702509761}},
      {{-0.045812709459333467, -0.45669564654043038, -2.2020886120716856, 3.7701081362388433,
        0.39985232127694781, 0.73313392243067288, -1.3820690088230314, 1.1098771832933079,
        -1.1327039340002305},
       {-0.12619623313234651, -0.24314366541165486, -0.55580639232474005, 3.255001283828606,
        -0.5647687922895539, -0.37480460814126226, -1.8873889032082962, -1.1703018673108641,
        -0.98061846491246907}}};
  for (const auto& [from, to] : motions) {
    const RefuterReport report = refuteMotion(scenario, {}, from, to);
    EXPECT_EQ(report.collision, 1);
    for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
  }
}

std::string refusal(const Scenario& scenario, const RefuterOptions& options,
                    const std::vector<double>& from) {
  try {
    refuteMotion(scenario, options, from, std::vector<double>(from.size(), 0.1));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(RefuterOptions, ThatMakeNoSenseAreRefused) {
  const Scenario scenario = loadScenario(filesOf({"rook7", "arm"}));
  const std::vector<double> home(7, 0.0);
  EXPECT_EQ(refusal(scenario, {}, home), "nothing was refused");
  EXPECT_EQ(refusal(scenario, {}, {0.1}), "a configuration of group 'arm' has 7 values, not 1");
  EXPECT_EQ(refusal(scenario, {}, std::vector<double>(8, 0.0)),
            "a configuration of group 'arm' has 7 values, not 8");
  for (const double step : {0.0, -1e-3, std::nan(""), HUGE_VAL}) {
    const std::string said = refusal(scenario, {.step = step}, home);
    EXPECT_NE(said.find("rad or m; allowed: finite and above zero"), std::string::npos) << said;
  }
  const std::string fine = refusal(scenario, {.step = 1e-300}, home);
  EXPECT_NE(fine.find("steps; allowed: 0 to 1e9"), std::string::npos) << fine;
  EXPECT_EQ(refusal(scenario, {.skew = 0.5}, home), "skew is 0.5; allowed: finite, 1 or more");
  EXPECT_EQ(refusal(scenario, {.motions = 0}, home), "0 motions; allowed: 1 or more");
}

TEST(RefuterOnData, FindsNothingToRefuteOnThePanda) {
  const auto data = dataFolder();
  if (!data) GTEST_SKIP() << "skipped: SWEPT_DATA is not set";
  const std::filesystem::path& root = *data;
  ScenarioFiles files;
  files.robot = root / "robots/panda/panda.urdf";
  files.srdf = root / "robots/panda/panda.srdf";
  files.group = "panda_arm";
  files.problems = root / "mbm/panda.json";
  for (const char* set : {"bookshelf_small", "cage", "table_under_pick"}) {
    files.set = set;
    RefuterOptions options;
    options.motions = 150;
    options.skew = 3.5;
    const RefuterReport report = refute(loadScenario(files), options);
    std::cout << set << ": " << summary(report) << std::endl;
    for (const std::string& failure : report.failures) ADD_FAILURE() << failure;
    EXPECT_GT(report.free, 30);
    EXPECT_GT(report.collision, 15);
  }
}

TEST_P(Refuter, AgreesOnWhatIsChecked) {
  size_t pairs = 0;
  for (const Scenario& scenario : scenariosOf(GetParam())) {
    const auto unordered = [](const std::string& a, const std::string& b) {
      return a < b ? std::pair(a, b) : std::pair(b, a);
    };
    using Names = std::set<std::pair<std::string, std::string>>;
    Names mine, theirs, unreachable;
    for (const auto& [a, b] : scenario.oracle->pairs()) mine.insert(unordered(a, b));
    for (const auto& p : scenario.checker->checkedPairs())
      theirs.insert(unordered(p.bodyA, p.bodyB));
    // What provably cannot meet may be left out; the oracle still watches it.
    for (const auto& p : scenario.checker->skippedPairs())
      if (p.reason == "out of reach") unreachable.insert(unordered(p.bodyA, p.bodyB));
    theirs.merge(unreachable);
    EXPECT_EQ(mine, theirs) << scenario.robot << ' ' << scenario.worldArguments;
    pairs += mine.size();
  }
  EXPECT_GT(pairs, 0u);
}

INSTANTIATE_TEST_SUITE_P(Models, Refuter, modelsUnderTest(), modelName);

}  // namespace
