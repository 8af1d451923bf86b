// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target on files, and on files cut short and with bytes changed, where the compiler
// has no fuzzer: a regression test of what was found. Arguments: how many changes of each file, and
// folders. Exit code 2 without a file.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

void run(const Bytes& bytes) {
  LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

/// Some bytes of it are others, or gone.
Bytes changed(Bytes bytes, std::mt19937& random) {
  if (bytes.empty()) return bytes;
  std::uniform_int_distribution<std::size_t> place(0, bytes.size() - 1);
  if (random() % 4 == 0) bytes.resize(place(random));
  for (auto changes = random() % 4; changes > 0 && !bytes.empty(); --changes)
    bytes[place(random) % bytes.size()] = static_cast<std::uint8_t>(random());
  return bytes;
}

int runFile(const std::filesystem::path& file, int changes) {
  std::ifstream stream(file, std::ios::binary);
  const Bytes bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  run(bytes);
  std::mt19937 random(1);
  for (int i = 0; i < changes; ++i) run(changed(bytes, random));
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const int changes = std::atoi(argv[1]);
  int files = 0;
  for (int i = 2; i < argc; ++i) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry : std::filesystem::directory_iterator(argv[i]))
      found.push_back(entry.path());
    std::ranges::sort(found);
    for (const auto& file : found) files += runFile(file, changes);
  }
  std::printf("%d files, %d inputs\n", files, files * (changes + 1));
  return files > 0 ? 0 : 2;
}
