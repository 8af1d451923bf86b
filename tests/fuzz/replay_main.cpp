// SPDX-License-Identifier: BSD-3-Clause
// Runs a fuzz target on files, and on files cut short and with bytes changed, where the compiler
// has no fuzzer: a regression test of what was found. Arguments: how many changes of each file, or
// for how long, as in `60s`, and folders. The inputs are the same each time, and so many as fit.
// Exit code 2 without a file.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>
#include <span>
#include <string>
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

struct Subject {
  Bytes bytes;
  std::mt19937 random{1};
};

std::vector<Subject> subjectsIn(std::span<char*> folders) {
  std::vector<std::filesystem::path> files;
  for (const char* folder : folders)
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      files.push_back(entry.path());
  std::ranges::sort(files);
  std::vector<Subject> subjects;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    subjects.push_back(
        {{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()}});
  }
  return subjects;
}

/// Whether there shall be one more input after so many.
std::function<bool(std::size_t)> untilDone(const std::string& extent, std::size_t files) {
  if (!extent.ends_with('s'))
    return [last = files * std::stoul(extent)](std::size_t inputs) { return inputs < last; };
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(std::stoul(extent));
  return [end](std::size_t) { return std::chrono::steady_clock::now() < end; };
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  auto subjects = subjectsIn({argv + 2, argv + argc});
  if (subjects.empty()) return 2;
  for (const Subject& subject : subjects) run(subject.bytes);
  std::size_t changes = 0;
  for (const auto goesOn = untilDone(argv[1], subjects.size()); goesOn(changes); ++changes) {
    Subject& subject = subjects[changes % subjects.size()];
    run(changed(subject.bytes, subject.random));
  }
  std::printf("%zu files, %zu inputs\n", subjects.size(), subjects.size() + changes);
}
