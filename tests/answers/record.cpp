// SPDX-License-Identifier: BSD-3-Clause
#include "record.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "questions.hpp"

namespace swept::answers {
namespace {

std::string hex(std::uint64_t value) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(value));
  return text.data();
}

/// What a place adds to the files.
struct Lines {
  std::string summary;
  std::string each;
  Totals totals;
};

void count(const std::string& letters, Tally& tally) {
  tally.free += std::ranges::count(letters, 'F');
  tally.collision += std::ranges::count(letters, 'C');
  tally.undecided += std::ranges::count(letters, 'U');
}

void add(const Tally& more, Tally& tally) {
  tally.questions += more.questions;
  tally.free += more.free;
  tally.collision += more.collision;
  tally.undecided += more.undecided;
}

/// Evenly spread over the places: how many of all are this one's.
std::int64_t shareOf(std::int64_t all, std::int64_t place, std::int64_t places) {
  return all * (place + 1) / places - all * place / places;
}

class Recorder {
 public:
  Recorder(const Options& options, const std::vector<Place>& places, bool each)
      : options_(options), places_(places), each_(each) {
    for (const Place& place : places) scenes_ += place.scene != "-";
    std::int64_t scene = 0;
    for (const Place& place : places) sceneOf_.push_back(place.scene == "-" ? -1 : scene++);
  }

  Lines at(std::size_t index) const {
    const Place& place = places_[index];
    Lines lines;
    std::optional<Site> site;
    std::string refusal;
    const auto begin = std::chrono::steady_clock::now();
    try {
      site = place.make();
    } catch (const std::exception& error) {
      refusal = error.what();
    }
    if (!site) {
      Answer answer;
      answer.result("refused", true);
      answer.detail("message", refusal);
      Digest verdict;
      Digest full;
      verdict.add(answer.verdict());
      full.add(answer.full());
      Tally tally;
      tally.questions = 1;
      writeSummary(place, "refused", tally, verdict, full, begin, lines);
      return lines;
    }
    std::optional<Workspace> workspace;
    if (site->checker) workspace.emplace(*site->checker);
    for (const Kind& kind : kinds())
      askAll(kind, index, *site, workspace ? &*workspace : nullptr, lines);
    return lines;
  }

 private:
  std::int64_t countOf(const Kind& kind, std::size_t index) const {
    const bool alone = sceneOf_[index] < 0;
    if (kind.about == About::RobotOnce) return alone ? 1 : 0;
    if (alone) return 0;
    if (kind.about == About::SceneOnce) return 1;
    const auto all =
        static_cast<std::int64_t>(std::llround(kind.share * static_cast<double>(options_.count)));
    return shareOf(all, sceneOf_[index], scenes_);
  }

  void askAll(const Kind& kind, std::size_t index, const Site& site, Workspace* workspace,
              Lines& lines) const {
    const Place& place = places_[index];
    const std::int64_t questions = countOf(kind, index);
    if (questions == 0) return;
    const auto begin = std::chrono::steady_clock::now();
    Digest verdict;
    Digest full;
    Tally tally;
    tally.questions = questions;
    for (std::int64_t i = 0; i < questions; ++i) {
      const Answer answer =
          ask(kind, site, workspace,
              Random::of(options_.seed, {place.robot, place.scene, kind.name}, i));
      verdict.add(answer.verdict());
      full.add(answer.full());
      count(answer.letters(), tally);
      if (each_) {
        lines.each += place.robot + ' ' + place.scene + ' ' + kind.name + ' ' + std::to_string(i) +
                      " answer=" + answer.letters() + " verdict=" + hex(answer.verdict()) +
                      " full=" + hex(answer.full()) + '\n';
      }
    }
    add(tally, lines.totals.all);
    if (kind.motions) add(tally, lines.totals.motions);
    writeSummary(place, kind.name, tally, verdict, full, begin, lines);
  }

  static void writeSummary(const Place& place, const std::string& kind, const Tally& tally,
                           const Digest& verdict, const Digest& full,
                           std::chrono::steady_clock::time_point begin, Lines& lines) {
    std::array<char, 32> seconds{};
    std::snprintf(seconds.data(), seconds.size(), "%.3f",
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    lines.summary +=
        place.robot + ' ' + place.scene + ' ' + kind + " count=" + std::to_string(tally.questions) +
        " free=" + std::to_string(tally.free) + " collision=" + std::to_string(tally.collision) +
        " undecided=" + std::to_string(tally.undecided) + " verdict=" + hex(verdict.value()) +
        " full=" + hex(full.value()) + " seconds=" + seconds.data() + '\n';
  }

  const Options& options_;
  const std::vector<Place>& places_;
  bool each_;
  std::int64_t scenes_ = 0;
  std::vector<std::int64_t> sceneOf_;  ///< of each place: its number among scenes
};

const Place& placeOf(const std::vector<Place>& places, const std::string& robot,
                     const std::string& scene) {
  for (const Place& place : places)
    if (place.robot == robot && place.scene == scene) return place;
  throw std::invalid_argument("--only: no " + robot + '/' + scene);
}

}  // namespace

Totals record(const Options& options, const std::vector<Place>& places, std::ostream& lines,
              std::ostream* each) {
  const Recorder recorder(options, places, each != nullptr);
  std::vector<std::optional<Lines>> done(places.size());
  std::size_t written = 0;
  Totals totals;
  std::mutex mutex;
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < places.size(); i = next++) {
      Lines made = recorder.at(i);
      const std::scoped_lock lock(mutex);
      done[i] = std::move(made);
      for (; written < done.size() && done[written]; ++written) {
        lines << done[written]->summary << std::flush;
        if (each) *each << done[written]->each;
        add(done[written]->totals.all, totals.all);
        add(done[written]->totals.motions, totals.motions);
        done[written] = Lines{};
      }
    }
  };
  const unsigned threads =
      options.threads ? options.threads : std::max(1U, std::thread::hardware_concurrency());
  std::vector<std::jthread> others;
  for (unsigned i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  others.clear();
  return totals;
}

void askOnly(const Options& options, const std::vector<Place>& places, std::ostream& text) {
  std::vector<std::string> parts{""};
  for (const char c : options.only) {
    if (c == '/') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  if (parts.size() != 4) throw std::invalid_argument("--only: ROBOT/SCENE/KIND/INDEX is wanted");
  const Place& place = placeOf(places, parts[0], parts[1]);
  const auto kind =
      std::ranges::find_if(kinds(), [&](const Kind& one) { return parts[2] == one.name; });
  if (kind == kinds().end()) throw std::invalid_argument("--only: no kind '" + parts[2] + "'");
  if ((kind->about == About::RobotOnce) != (place.scene == "-"))
    throw std::invalid_argument("--only: " + parts[2] + " is not asked there");
  const Site site = place.make();
  std::optional<Workspace> workspace;
  if (site.checker) workspace.emplace(*site.checker);
  const Answer answer =
      ask(*kind, site, workspace ? &*workspace : nullptr,
          Random::of(options.seed, {place.robot, place.scene, kind->name}, std::stoull(parts[3])),
          &text);
  text << "answer=" << answer.letters() << " verdict=" << hex(answer.verdict())
       << " full=" << hex(answer.full()) << '\n';
}

}  // namespace swept::answers
