// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "certificate/pair_search.hpp"
#include "verify/check.hpp"

namespace swept {
namespace {

/// The share of the clearance beyond the margin that the planes have to prove.
constexpr double kShareOfClearance = 0.5;

class CertificateSearch {
 public:
  CertificateSearch(const Checker& checker, const Json& model)
      : model_(verify::readModel(model)), pairs_(verify::pairsToProve(model_)) {
    const std::vector<CertifiedBody> sources = certifiedBodies(checker);
    for (std::size_t i = 0; i < sources.size(); ++i)
      bodies_.emplace_back(model_.bodies[i], sources[i]);
    findMeasured(checker, sources);
  }

  /// Null where a pair is not proven; then `missing` says why.
  Json segment(std::span<const double> from, std::span<const double> to, double clearance,
               std::string& missing) {
    const verify::Motion motion(model_, from, to);
    Json proofs = Json::array();
    for (const verify::PairToProve& pair : pairs_) {
      SearchedBody& a = bodies_[static_cast<std::size_t>(pair.a)];
      SearchedBody& b = bodies_[static_cast<std::size_t>(pair.b)];
      const double margin = model_.marginOf(pair.a, pair.b);
      const bool measured = measured_.contains({pair.a, pair.b});
      const double share = measured ? std::max(0.0, kShareOfClearance * (clearance - margin)) : 0.0;
      const double keep = std::isfinite(share) ? margin + share : margin;
      Json entry = PairSearch(model_, motion, pair, a, b, keep).run();
      if (entry.is_null()) {
        missing = a.body().name() + " - " + b.body().name();
        return nullptr;
      }
      entry["digest"] = verify::pairDigest(entry);
      proofs.push_back(std::move(entry));
    }
    return proofs;
  }

 private:
  void findMeasured(const Checker& checker, const std::vector<CertifiedBody>& sources) {
    std::map<std::pair<std::string, bool>, int> numbers;
    for (std::size_t i = 0; i < sources.size(); ++i)
      numbers[{sources[i].name, sources[i].link >= 0}] = static_cast<int>(i);
    for (const Checker::Pair& pair : checker.checkedPairs())
      measured_.insert(
          std::minmax(numbers.at({pair.bodyA, true}), numbers.at({pair.bodyB, pair.selfPair})));
  }

  verify::Model model_;
  std::vector<verify::PairToProve> pairs_;
  std::deque<SearchedBody> bodies_;
  /// Pairs that the clearances cover. Bodies out of a link's reach have to be proven apart as well,
  /// and may be nearer than these.
  std::set<std::pair<int, int>> measured_;
};

}  // namespace

Certificate certificateOf(const Checker& checker, std::span<const std::vector<double>> states,
                          std::span<const double> clearances) {
  Certificate certificate{.model = modelJson(checker), .proof = nullptr, .missing = {}};
  CertificateSearch search(checker, certificate.model);
  Json segments = Json::array();
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    std::string pair;
    Json proofs = search.segment(states[i], states[i + 1], clearances[i], pair);
    if (proofs.is_null()) {
      certificate.missing = "segment " + std::to_string(i + 1) + ", " + pair;
      return certificate;
    }
    segments.push_back(
        {{"states_digest", verify::stateDigest(toJson(states[i]), toJson(states[i + 1]))},
         {"pairs", std::move(proofs)}});
  }
  certificate.proof = {{"digests", verify::digestsOf(certificate.model)},
                       {"segments", std::move(segments)}};
  return certificate;
}

}  // namespace swept
