// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "continuous_fcl.hpp"
#include "data_folder.hpp"
#include "mesh_files.hpp"

/// The piano in the apartment: Tables II and III of Pan, Chitta, Manocha 2012. Lengths in inches.
namespace swept::benchmark {

constexpr double kPianoTolerance = 1e-3;  ///< inches
constexpr int kPianoChecks = 11;          ///< discrete ones per motion, as in the paper
/// Of the data's first contacts: they were looked for at 10 000 instants.
constexpr double kPianoInstant = 1.0 / 9999.0;

inline Sweep pianoSweep(const nlohmann::json& item, const std::string& kind) {
  const Eigen::Isometry3d start = readPose(item.at("start")), goal = readPose(item.at("goal"));
  Sweep sweep;
  if (kind == "translation") {
    sweep.kind = PathKind::Translation;
    sweep.motion = std::make_shared<UniformMotion>(
        UniformMotion::translation(start, goal.translation() - start.translation()));
  } else if (kind == "linear") {
    sweep.kind = PathKind::Linear;
    sweep.motion = std::make_shared<UniformMotion>(UniformMotion::interpolation(start, goal));
  } else {
    sweep.kind = PathKind::Screw;
    sweep.motion = std::make_shared<UniformMotion>(UniformMotion::screw(start, goal));
  }
  sweep.still =
      std::make_shared<UniformMotion>(UniformMotion::still(Eigen::Isometry3d::Identity()));
  const nlohmann::json& truth = item.at("truth").at(kind);
  if (truth.at("verdict") == "hit") {
    const double toc = truth.at("toc").get<double>();
    sweep.truth = {true, std::max(0.0, toc - kPianoInstant), toc};
  }
  for (int i = 0; i < kPianoChecks; ++i)
    sweep.instants.push_back(sweep.motion->at(i / (kPianoChecks - 1.0)));
  return sweep;
}

class Piano {
 public:
  explicit Piano(const std::filesystem::path& data)
      : json_(readJson(data / "seed_tables" / "piano_apartment.json")),
        apartmentSoup_(readObj(data / json_.at("meshes").at("environment").get<std::string>())),
        pianoSoup_(readObj(data / json_.at("meshes").at("robot").get<std::string>())),
        apartment_(surface(apartmentSoup_)),
        piano_(surface(pianoSoup_)) {
#ifdef SWEPT_HAS_FCL
    obb_ = {fclModel<fcl::OBBd>(pianoSoup_), fclModel<fcl::OBBd>(apartmentSoup_)};
    obbRss_ = {fclModel<fcl::OBBRSSd>(pianoSoup_), fclModel<fcl::OBBRSSd>(apartmentSoup_)};
#endif
  }

  /// Prints both tables. Returns how many answers of ours are wrong.
  int run() {
    const std::vector<Method> methods = listMethods();
    const bool peers = methods.size() > 1;
    const MarkdownTable table(
        peers ? std::vector<std::string>{"motions", "path", "hits", "swept, us", "11 checks, us",
                                         "swept / this", "11, up to the first hit, us",
                                         "swept / this", "FCL 10 samples, us", "100 samples, us",
                                         "FCL advancement, us"}
              : std::vector<std::string>{"motions", "path", "hits", "swept, us"});
    for (const char* set : {"random", "free_ends", "steps"}) {
      std::vector<double> sums;
      int hits = 0, count = 0;
      for (const char* kind : {"translation", "linear", "screw"}) {
        const std::vector<Sweep> sweeps = read(set, kind);
        const std::vector<Result> results = compete(methods, sweeps, 5);
        judge(set, sweeps, results);
        const int hit = static_cast<int>(std::count_if(
            sweeps.begin(), sweeps.end(), [](const Sweep& sweep) { return sweep.truth.hit; }));
        row(table, set, kind, hit, sweeps.size(), results);
        hits += hit;
        count += static_cast<int>(sweeps.size());
        sums.resize(results.size());
        for (std::size_t i = 0; i < results.size(); ++i) sums[i] += results[i].seconds;
      }
      std::vector<Result> total;
      for (const double seconds : sums) total.push_back({{}, seconds, {}});
      row(table, set, "all", hits, static_cast<std::size_t>(count), total);
    }
    std::printf("\n");
    printScores();
    return wrong_;
  }

 private:
  static Shape surface(const Soup& soup) {
    return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
  }

  std::vector<Method> listMethods() {
    std::vector<Method> methods{{"swept", [this](const Sweep& sweep) {
                                   return ask(apartment_, piano_, sweep, kPianoTolerance,
                                              workspace_, *sweep.motion);
                                 }}};
#ifdef SWEPT_HAS_FCL
    for (const FclBodies* bodies : {&obb_, &obbRss_}) {
      methods.push_back({"FCL, 11 checks",
                         [bodies](const Sweep& sweep) { return bodies->discrete(sweep, true); }});
      methods.push_back({"FCL, 11 checks up to the first hit",
                         [bodies](const Sweep& sweep) { return bodies->discrete(sweep, false); }});
      methods.push_back({"FCL, naive, 10 samples",
                         [bodies](const Sweep& sweep) { return bodies->samples(sweep, 10); }});
      methods.push_back({"FCL, naive, 100 samples",
                         [bodies](const Sweep& sweep) { return bodies->samples(sweep, 100); }});
    }
    // OBB has no distance.
    methods.push_back(
        {"FCL, conservative advancement",
         [this](const Sweep& sweep) { return obbRss_.conservativeAdvancement(sweep); }, true});
#endif
    return methods;
  }

  std::vector<Sweep> read(const std::string& set, const std::string& kind) {
    std::vector<Sweep> sweeps;
    for (const nlohmann::json& item : json_.at("ccd").at(set).at("motions")) {
      Sweep& sweep = sweeps.emplace_back(pianoSweep(item, kind));
      sweep.speed = fastestPoint(*sweep.motion, pianoSoup_.vertices);
#ifdef SWEPT_HAS_FCL
      apart_ = std::max(apart_, addFclMotions(sweep, boundingSphere(piano_).radius));
#endif
    }
    return sweeps;
  }

  static void row(const MarkdownTable& table, const std::string& set, const std::string& kind,
                  int hits, std::size_t count, const std::vector<Result>& results) {
    const auto mean = [&](const Result& result) {
      return number(1e6 * result.seconds / static_cast<double>(count));
    };
    std::vector<std::string> cells{set, kind, std::to_string(hits) + " of " + std::to_string(count),
                                   mean(results[0])};
    for (std::size_t i = 1; i < results.size(); ++i) {
      cells.push_back(mean(results[i]));
      if (i <= 2) cells.push_back(number(results[0].seconds / results[i].seconds, 2));
    }
    table.row(cells);
  }

  void judge(const std::string& set, const std::vector<Sweep>& sweeps,
             const std::vector<Result>& results) {
    for (const Result& result : results) {
      Score score;
      // The truth's time is one of 10 000; it is not off by more.
      for (std::size_t i = 0; i < sweeps.size(); ++i)
        score.add(sweeps[i], result.answers[i], kPianoTolerance, kPianoTolerance);
      if (&result == &results.front()) wrong_ += score.wrong();
      if (scores_.count(result.name) == 0) names_.push_back(result.name);
      scores_[result.name][set] += score;
    }
  }

  void printScores() const {
    const MarkdownTable table({"method", "motions", "right", "missed contacts", "false hits",
                               "late by more than the tolerance", "unsound times"});
    for (const std::string& name : names_)
      for (const auto& [set, score] : scores_.at(name))
        table.row({name, set, std::to_string(score.right()) + " of " + std::to_string(score.sweeps),
                   std::to_string(score.missed), std::to_string(score.falseHits),
                   std::to_string(score.late), std::to_string(score.unsound)});
#ifdef SWEPT_HAS_FCL
    std::printf("\nposes of the two libraries differ by at most %s inches\n",
                number(apart_, 2).c_str());
#endif
  }

  nlohmann::json json_;
  Soup apartmentSoup_, pianoSoup_;
  Shape apartment_, piano_;
  ContinuousWorkspace workspace_;
  std::map<std::string, std::map<std::string, Score>> scores_;
  std::vector<std::string> names_;
  int wrong_ = 0;
#ifdef SWEPT_HAS_FCL
  FclBodies obb_, obbRss_;
  double apart_ = 0.0;
#endif
};

inline int pianoPart() {
  std::printf("## Piano in the apartment, tolerance 0.001 inches\n\n");
  const auto data = dataFolder();
  if (!data) {
    std::printf("skipped: SWEPT_DATA is not set\n\n");
    return 0;
  }
  const int wrong = Piano(*data).run();
  std::printf("\n%d wrong answers\n\n", wrong);
  return wrong;
}

}  // namespace swept::benchmark
