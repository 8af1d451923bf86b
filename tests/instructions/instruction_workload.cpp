// SPDX-License-Identifier: BSD-3-Clause
// instruction_workload [NAME...]: puts the queries of the workloads named, or of all, to checkers:
// each once to get going, and once more to be counted by callgrind, which is started with
// --instr-atstart=no and dumps each count under the workload's name. Prints how many queries each
// has, and the instruction set that the processor, or valgrind in its place, offers.
#include <valgrind/callgrind.h>

#include <exception>
#include <iostream>

#include "models_dir.hpp"
#include "motion_lists.hpp"
#include "workloads.hpp"

namespace swept::instructions {
namespace {

const char* instructionSet() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return "AVX-512";
  if (__builtin_cpu_supports("avx2")) return "AVX2";
  return "x86-64";
#else
  return "other";
#endif
}

void ask(const Workload& workload) {
  for (const auto& site : workload.sites) workload.run(*site);
}

void count(const Workload& workload) {
  // What the first call alone does is left out: binding of symbols, choice of instruction set.
  ask(workload);
  CALLGRIND_START_INSTRUMENTATION;
  ask(workload);
  CALLGRIND_STOP_INSTRUMENTATION;
  CALLGRIND_DUMP_STATS_AT(workload.name.c_str());
  std::cout << "queries " << workload.name << ' ' << workload.items << '\n';
}

}  // namespace
}  // namespace swept::instructions

int main(int argc, char** argv) {
  namespace instructions = swept::instructions;
  try {
    std::vector<std::string> names(argv + 1, argv + argc);
    if (names.empty()) names = instructions::workloadNames();
    instructions::Models models(modelsDir());
    for (const std::string& name : names)
      instructions::count(instructions::makeWorkload(name, models));
    std::cout << "instruction-set " << instructions::instructionSet() << '\n';
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return 1;
  }
}
