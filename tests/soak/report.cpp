// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <ostream>

#include "run.hpp"

namespace soak {

namespace {

using swept::Verdict;

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void printTally(std::ostream& out, const std::string& what, const Tally& tally) {
  out << what << ": " << tally.all();
  for (const Verdict verdict : {Verdict::Free, Verdict::Collision, Verdict::Undecided})
    out << ", " << number("%.2f", 100 * tally.share(verdict)) << " % " << toString(verdict);
  const auto one = tally.ways[static_cast<std::size_t>(Way::One)];
  if (one > 0)
    out << "; " << number("%.2f", 1e6 * tally.oneSeconds / static_cast<double>(one))
        << " us of processor each, drawn and asked one by one";
  out << '\n';
}

void printWays(std::ostream& out, const std::string& what, const Tally& tally) {
  out << what;
  for (std::size_t i = 0; i < tally.ways.size(); ++i)
    out << (i == 0 ? ": " : ", ") << tally.ways[i] << ' ' << toString(static_cast<Way>(i));
  out << '\n';
}

void printMemory(std::ostream& out, const std::string& what, const MemoryReadings& memory,
                 double allowed) {
  const auto& readings = memory.readings();
  out << what << ", MiB:";
  for (const double reading : readings) out << ' ' << number("%.1f", reading);
  if (const auto growth = memory.growth())
    out << "\n  first " << number("%.2f", readings.front()) << ", last "
        << number("%.2f", readings.back()) << ", largest " << number("%.2f", memory.largest())
        << ", last quarter less second quarter " << number("%.2f", *growth) << " of " << allowed
        << " allowed\n";
  else
    out << "\n  too few readings to tell whether it grows\n";
}

void printWork(std::ostream& out, const Result& result, const StageTally& total) {
  out << "in " << number("%.1f", result.seconds) << " s, "
      << number("%.1f", result.processorSeconds) << " s of processor: "
      << number("%.0f", static_cast<double>(total.states.all()) / result.seconds)
      << " states/s and "
      << number("%.0f", static_cast<double>(total.motions.all()) / result.seconds)
      << " motions/s, at the same time\n";
  const UpdateCounts& u = result.updates;
  out << "world versions: " << u.all() << ": " << u.added << " by adding a body, " << u.removed
      << " by removing, " << u.replaced << " by replacing, " << u.returned
      << " by going back to an earlier world\n";
  const RefutationCounts& j = result.judged;
  out << "judged: " << j.states << " states and " << j.motions << " motions, the oracle looked at "
      << j.oracleStates << " states; " << j.rebuilt << " asked again in a checker made anew; "
      << "least room of a free motion " << number("%.3g", j.leastRoomOfFree) << " m\n";
}

void complain(Result& result, const std::string& what, std::ostream& out) {
  if (what.empty()) return;
  out << "FAILED: " << what << '\n';
  ++result.failures;
}

}  // namespace

void report(Result& result, const Options& options, std::ostream& out) {
  StageTally total;
  for (std::size_t i = 0; i < result.stages.size(); ++i) {
    printTally(out, result.stages[i] + " states", result.tallies[i].states);
    printTally(out, result.stages[i] + " motions", result.tallies[i].motions);
    total.add(result.tallies[i]);
  }
  printTally(out, "all states", total.states);
  printTally(out, "all motions", total.motions);
  printWays(out, "states", total.states);
  printWays(out, "motions", total.motions);
  printWork(out, result, total);
  printMemory(out, "resident memory", result.resident, options.growth);
  printMemory(out, "heap in use", result.heap, options.growth);
  complain(result, grown("resident memory", result.resident, options.growth), out);
  complain(result, grown("heap in use", result.heap, options.growth), out);
  if (!result.interrupted) {
    complain(result, lopsided("states", total.states), out);
    complain(result, lopsided("motions", total.motions), out);
  }
  out << result.failures << " failures" << (result.interrupted ? "; ended early" : "") << std::endl;
}

int exitCode(const Result& result) {
  if (result.failures > 0) return 1;
  return result.interrupted ? 130 : 0;
}

}  // namespace soak
