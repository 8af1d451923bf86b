// SPDX-License-Identifier: BSD-3-Clause
// Two rigid meshes: Table II of Pan, Chitta, Manocha 2012 on the piano in the apartment, and two
// pairs made on the spot. Exit code 1 if an answer of ours differs from the expected one.
#include <cstdlib>

#include "data_folder.hpp"
#include "fcl_peer.hpp"
#include "mesh_files.hpp"
#include "swept/core/contacts.hpp"
#include "swept/core/distance.hpp"
#include "timing.hpp"
#include "workloads.hpp"

namespace swept::benchmark {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

constexpr int kTurns = 5;
constexpr std::size_t kAllContacts = 1'000'000;

/// Poses of the second mesh in the first one's frame, and what is true there.
struct PoseSet {
  std::string name;
  std::vector<Isometry3d> poses;
  std::vector<char> touches;      ///< empty: not known from elsewhere
  std::vector<double> distances;  ///< m, as `touches`
};

struct Workload {
  std::string name;
  Soup a, b;
  std::vector<PoseSet> sets;
};

Shape surface(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
}

PoseSet readSet(const nlohmann::json& list, const std::string& name) {
  PoseSet set{name, {}, {}, {}};
  for (const nlohmann::json& item : list.at("configurations")) {
    set.poses.push_back(readPose(item.at("pose")));
    set.touches.push_back(item.at("collides").get<bool>());
    set.distances.push_back(item.at("distance").get<double>());
  }
  return set;
}

Workload pianoInApartment(const std::filesystem::path& data) {
  const nlohmann::json json = readJson(data / "seed_tables" / "piano_apartment.json");
  return {"piano / apartment",
          readObj(data / json.at("meshes").at("environment").get<std::string>()),
          readObj(data / json.at("meshes").at("robot").get<std::string>()),
          {readSet(json.at("dcd").at("random"), "random"),
           readSet(json.at("dcd").at("near_contact"), "near contact")}};
}

/// Half of the apartment's and the piano's triangles repeat another. We drop those and FCL does
/// not: with them gone for both, what is left of the difference is the libraries'.
Workload withoutRepeats(const Workload& work) {
  const auto cleaned = [](const Soup& soup) -> Soup {
    const Shape shape = surface(soup);
    const auto& mesh = std::get<TriangleMesh>(shape);
    return {mesh.vertices(), mesh.triangles()};
  };
  return {work.name + ", no repeats", cleaned(work.a), cleaned(work.b), work.sets};
}

/// 100 poses at random, and 100 within 1e-4 of contact, half of them on either side.
std::vector<PoseSet> posesFor(const Soup& a, const Soup& b, const Vector3d& reach, unsigned seed) {
  const Shape first = surface(a), second = surface(b);
  const auto touches = [&](const Isometry3d& pose) {
    return collide(first, second, pose) != Contact::Separate;
  };
  std::mt19937_64 random(seed);
  PoseSet free{"random", {}, {}, {}}, near{"near contact", {}, {}, {}};
  for (int i = 0; i < 100; ++i) free.poses.push_back(randomPose(random, reach));
  while (near.poses.size() < 100) {
    const Isometry3d touching = randomPose(random, 0.7 * reach);
    if (!touches(touching)) continue;
    Isometry3d apart = touching;
    apart.translation() += 5.0 * reach.norm() * direction(random);
    if (touches(apart)) continue;
    const Bracket bracket = bisect({apart, touching}, 16, touches);
    near.poses.push_back(near.poses.size() % 2 == 0 ? bracket.free : bracket.touching);
  }
  return {free, near};
}

Workload interlockedTori() {
  Workload work{"torus / torus", bumpyTorus(200, 50, 1.0, 0.3), bumpyTorus(200, 50, 1.0, 0.3), {}};
  work.sets = posesFor(work.a, work.b, Vector3d::Constant(1.1), 11);
  return work;
}

Workload gearOnTerrain() {
  Workload work{"gear / terrain", terrain(200, 100, 4.0), gear(100, 25, 0.4, 12), {}};
  work.sets = posesFor(work.a, work.b, {3.5, 3.5, 0.6}, 12);
  return work;
}

/// Answers of one contestant, for the comparison.
struct Answers {
  std::vector<char> touches;
  std::vector<double> distances;
  std::vector<std::size_t> contacts;
  explicit Answers(std::size_t count) : touches(count), distances(count), contacts(count) {}
};

#ifdef SWEPT_HAS_FCL
struct Peer {
  std::string name;
  FclPair pair;
  bool hasOverlap;  ///< RSS answers overlap by distance, 50 times slower
  bool hasDistance;
  double buildSeconds;
  double bytes;
};

template <typename Volume>
void addPeer(std::vector<Peer>& peers, const std::string& name, const Workload& work,
             bool hasOverlap, bool hasDistance) {
  Peer peer{name, {}, hasOverlap, hasDistance, std::numeric_limits<double>::infinity(), 0.0};
  for (int turn = 0; turn < kTurns; ++turn) {
    const double before = heapBytes(), start = cpuSeconds();
    const auto a = fclModel<Volume>(work.a), b = fclModel<Volume>(work.b);
    peer.buildSeconds = std::min(peer.buildSeconds, cpuSeconds() - start);
    peer.bytes = heapBytes() - before;
    peer.pair = {a, b};
  }
  peers.push_back(peer);
}
#endif

class Measurement {
 public:
  explicit Measurement(const Workload& work)
      : work_(work), a_(surface(work.a)), b_(surface(work.b)) {
#ifdef SWEPT_HAS_FCL
    addPeer<fcl::OBBRSSd>(peers_, "OBBRSS", work, true, true);
    addPeer<fcl::OBBd>(peers_, "OBB", work, true, false);
    addPeer<fcl::RSSd>(peers_, "RSS", work, false, true);
#endif
  }

  /// Returns how many answers of ours are wrong.
  int queries(const MarkdownTable& table) {
    int wrong = 0;
    for (const PoseSet& set : work_.sets) {
      wrong += collideRow(table, set);
      wrong += distanceRow(table, set);
      wrong += contactsRow(table, set);
    }
    return wrong;
  }

  void builds(const MarkdownTable& table) const {
    double least = std::numeric_limits<double>::infinity(), bytes = 0.0;
    for (int turn = 0; turn < kTurns; ++turn) {
      const double before = heapBytes(), start = cpuSeconds();
      const Shape a = surface(work_.a), b = surface(work_.b);
      least = std::min(least, cpuSeconds() - start);
      bytes = heapBytes() - before;
    }
    const double triangles =
        static_cast<double>(work_.a.triangles.size() + work_.b.triangles.size());
    table.row({work_.name, "swept", number(1e3 * least), "-", number(bytes / triangles)});
#ifdef SWEPT_HAS_FCL
    for (const Peer& peer : peers_)
      table.row({work_.name, "FCL " + peer.name, number(1e3 * peer.buildSeconds),
                 number(least / peer.buildSeconds, 2), number(peer.bytes / triangles)});
#endif
  }

 private:
  template <typename Query>
  Contestant ours(const PoseSet& set, const Query& query) {
    return {"swept", [&set, query] {
              for (std::size_t i = 0; i < set.poses.size(); ++i) query(i, set.poses[i]);
            }};
  }

#ifdef SWEPT_HAS_FCL
  template <typename Query>
  void enterPeers(const PoseSet& set, bool Peer::*has, std::vector<Contestant>& turns,
                  std::vector<Answers>& others, const Query& query) {
    others.reserve(peers_.size());  // contestants refer to the elements
    for (const Peer& peer : peers_) {
      if (!(peer.*has)) continue;
      Answers& answers = others.emplace_back(set.poses.size());
      turns.push_back({peer.name, [&set, &peer, &answers, query] {
                         for (std::size_t i = 0; i < set.poses.size(); ++i)
                           query(peer.pair, set.poses[i], answers, i);
                       }});
    }
  }
#endif

  int collideRow(const MarkdownTable& table, const PoseSet& set) {
    Answers own(set.poses.size());
    std::vector<Contestant> turns{ours(set, [&](std::size_t i, const Isometry3d& pose) {
      own.touches[i] = collide(a_, b_, pose) != Contact::Separate;
    })};
    std::vector<Answers> others;
#ifdef SWEPT_HAS_FCL
    enterPeers(set, &Peer::hasOverlap, turns, others,
               [](const FclPair& pair, const Isometry3d& pose, Answers& answers, std::size_t i) {
                 answers.touches[i] = pair.contacts(pose, 1, false) > 0;
               });
#endif
    takeTurns(turns, kTurns);
    print(table, set, "collide", turns);
    int wrong = 0;
    for (std::size_t i = 0; i < set.poses.size(); ++i) {
      if (!set.touches.empty() && own.touches[i] != set.touches[i])
        wrong += report(set, i, "collide", own.touches[i], set.touches[i], "expected");
      for (std::size_t k = 0; k < others.size(); ++k)
        if (others[k].touches[i] != own.touches[i])
          report(set, i, "collide", own.touches[i], others[k].touches[i], turns[k + 1].name);
    }
    return wrong;
  }

  int distanceRow(const MarkdownTable& table, const PoseSet& set) {
    Answers own(set.poses.size());
    std::vector<Contestant> turns{ours(set, [&](std::size_t i, const Isometry3d& pose) {
      own.distances[i] = distance(a_, b_, pose).upper;
    })};
    std::vector<Answers> others;
#ifdef SWEPT_HAS_FCL
    enterPeers(set, &Peer::hasDistance, turns, others,
               [](const FclPair& pair, const Isometry3d& pose, Answers& answers, std::size_t i) {
                 answers.distances[i] = pair.distance(pose);
               });
#endif
    takeTurns(turns, kTurns);
    print(table, set, "distance", turns);
    int wrong = 0;
    const auto differ = [](double x, double y) {
      return !(std::abs(std::max(0.0, x) - std::max(0.0, y)) <= 1e-6 * std::max(1.0, std::abs(y)));
    };
    for (std::size_t i = 0; i < set.poses.size(); ++i) {
      if (!set.distances.empty() && differ(own.distances[i], set.distances[i]))
        wrong += report(set, i, "distance", own.distances[i], set.distances[i], "expected");
      for (std::size_t k = 0; k < others.size(); ++k)
        if (differ(others[k].distances[i], own.distances[i]))
          report(set, i, "distance", own.distances[i], others[k].distances[i], turns[k + 1].name);
    }
    return wrong;
  }

  int contactsRow(const MarkdownTable& table, const PoseSet& set) {
    Answers own(set.poses.size());
    std::vector<ContactPoint> contacts;
    std::vector<Contestant> turns{ours(set, [&](std::size_t i, const Isometry3d& pose) {
      contacts.clear();
      findContacts(a_, b_, pose, kAllContacts, contacts);
      own.contacts[i] = contacts.size();
    })};
    std::vector<Answers> others;
#ifdef SWEPT_HAS_FCL
    enterPeers(set, &Peer::hasOverlap, turns, others,
               [](const FclPair& pair, const Isometry3d& pose, Answers& answers, std::size_t i) {
                 answers.contacts[i] = pair.contacts(pose, kAllContacts, true);
               });
#endif
    takeTurns(turns, kTurns);
    print(table, set, "penetration (all contacts)", turns);
    int wrong = 0;
    for (std::size_t i = 0; i < set.poses.size(); ++i) {
      if (!set.touches.empty() && (own.contacts[i] > 0) != (set.touches[i] != 0))
        wrong += report(set, i, "contacts", static_cast<double>(own.contacts[i]), set.touches[i],
                        "expected");
    }
    printCounts(set, own, others, turns);
    return wrong;
  }

  /// Ours are fewer where the meshes repeat triangles, which are dropped; FCL may also name a pair
  /// twice.
  void printCounts(const PoseSet& set, const Answers& own, const std::vector<Answers>& others,
                   const std::vector<Contestant>& turns) {
    const auto sum = [](const Answers& answers) {
      std::size_t total = 0;
      for (const std::size_t count : answers.contacts) total += count;
      return std::to_string(total);
    };
    std::string line = work_.name + ", " + set.name + ": contacts swept " + sum(own);
    for (std::size_t k = 0; k < others.size(); ++k)
      line += ", FCL " + turns[k + 1].name + " " + sum(others[k]);
    notes_.push_back(line + "; triangles kept " + keptOf(a_) + " and " + keptOf(b_));
  }

  static std::string keptOf(const Shape& shape) {
    const MeshReport& report = std::get<TriangleMesh>(shape).report();
    const int dropped = report.degenerateDropped + report.duplicatesDropped;
    return std::to_string(report.trianglesGiven - dropped) + " of " +
           std::to_string(report.trianglesGiven);
  }

  void print(const MarkdownTable& table, const PoseSet& set, const std::string& query,
             const std::vector<Contestant>& turns) {
    std::vector<std::string> cells{work_.name, query, set.name};
    for (const std::string& cell : comparison(turns, set.poses.size(), 1e-6)) cells.push_back(cell);
    table.row(cells);
  }

  int report(const PoseSet& set, std::size_t i, const char* query, double own, double other,
             const std::string& whose) {
    notes_.push_back(work_.name + ", " + set.name + " " + std::to_string(i) + ", " + query +
                     ": swept " + number(own, 17) + ", " + whose + " " + number(other, 17));
    return 1;
  }

 public:
  const std::vector<std::string>& notes() const {
    return notes_;
  }

 private:
  const Workload& work_;
  Shape a_, b_;
#ifdef SWEPT_HAS_FCL
  std::vector<Peer> peers_;
#endif
  std::vector<std::string> notes_;
};

int run() {
  std::vector<Workload> workloads;
  if (const auto data = dataFolder()) {
    workloads.push_back(pianoInApartment(*data));
    workloads.push_back(withoutRepeats(workloads.back()));
  } else {
    std::printf("piano / apartment skipped: SWEPT_DATA is not set\n\n");
  }
  workloads.push_back(interlockedTori());
  workloads.push_back(gearOnTerrain());

  int wrong = 0;
  std::vector<Measurement> measured(workloads.begin(), workloads.end());
  {
    const MarkdownTable table({"pair", "query", "set", "swept, us", "FCL's best, us", "ratio"});
    for (Measurement& measurement : measured) wrong += measurement.queries(table);
  }
  std::printf("\n");
  {
    const MarkdownTable table({"pair", "library", "build, ms", "swept / this", "bytes / triangle"});
    for (const Measurement& measurement : measured) measurement.builds(table);
  }
  std::printf("\n");
  for (const Measurement& measurement : measured)
    for (const std::string& note : measurement.notes()) std::printf("%s\n", note.c_str());
  std::printf("\n%d wrong answers\n", wrong);
  return wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace swept::benchmark

int main() {
  return swept::benchmark::run();
}
