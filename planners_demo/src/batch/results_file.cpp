// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>

#include "batch/results_header.hpp"
#include "command_line/exit_code.hpp"
#include "output/whole_file.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

constexpr std::string_view kHeaderBegin = R"({"format":"swept bench planners")";

/// A header that was not written to its end, and nothing else.
bool isTornHeader(std::string_view text) {
  return text.starts_with(kHeaderBegin) || kHeaderBegin.starts_with(text);
}

[[noreturn]] void refuseToRead(const std::string& file) {
  throw InputError(file, 0, std::string("file cannot be read: ") + std::strerror(errno));
}

std::string tornText(const std::string& file, std::size_t bytes) {
  return "swept: warning: '" + file + "': the last line has no end, and is dropped (" +
         std::to_string(bytes) + " bytes)";
}

void addRun(Results& results, std::map<RunKey, std::string>& known, const std::string& line,
            const std::string& file, int number) {
  try {
    const nlohmann::json json = parseJsonLine(line, file, number);
    RunResult result = resultOf(JsonValue(json, "", file));
    const auto [place, isNew] = known.try_emplace(result.key, json.dump());
    if (!isNew && place->second != json.dump())
      throw InputError(file, number, "another result of the run " + keyText(result.key));
    if (isNew) results.runs.push_back(std::move(result));
  } catch (const InputError& error) {
    throw InputError(file, number, error.message());
  }
}

/// Also of pipes, and of more than a text file may have.
std::string allOf(int descriptor, const std::string& file) {
  std::string text;
  std::array<char, 65536> buffer{};
  for (ssize_t count; (count = read(descriptor, buffer.data(), buffer.size())) != 0;) {
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuseToRead(file);
    text.append(buffer.data(), static_cast<std::size_t>(count));
  }
  return text;
}

class Input {
 public:
  explicit Input(const std::string& file) : descriptor_(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) refuseToRead(file);
  }
  ~Input() { close(descriptor_); }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

Results parseResults(const std::string& text, const std::string& file) {
  Results results;
  std::map<RunKey, std::string> known;
  int number = 0;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string line = text.substr(begin, end - begin);
    if (++number == 1) {
      requireModestJson(line, file);
      results.header = Json::parse(line, nullptr, false);
      requireHeader(results.header, file);
    } else {
      addRun(results, known, line, file, number);
    }
  }
  results.wholeBytes = begin;
  results.tornBytes = text.size() - begin;
  if (number == 0 && !isTornHeader(text)) requireHeader({}, file);
  return results;
}

Results readResults(const std::string& file, Warnings& warnings) {
  if (!std::filesystem::exists(file)) throw InputError(file, 0, "file not found");
  const Input input(file);
  Results results = parseResults(allOf(input.descriptor(), file), file);
  if (results.tornBytes > 0) warnings(tornText(file, results.tornBytes));
  return results;
}

ResultsFile::ResultsFile(const std::string& file, const Json& header, Warnings& warnings)
    : file_(file), header_(header) {
  if (!std::filesystem::exists(file)) {
    requireWritable(file);
    return;
  }
  if (!std::filesystem::is_regular_file(file)) {
    openPipe();
    return;
  }
  openForWriting(0);
  results_ = parseResults(allOf(descriptor_, file), file);
  if (!results_.header.is_null())
    requireSameHeader(results_.header, file, header, "on the command line");
  if (results_.tornBytes > 0) {
    warnings(tornText(file, results_.tornBytes));
    if (ftruncate(descriptor_, static_cast<off_t>(results_.wholeBytes)) != 0)
      refuse(std::strerror(errno));
  }
}

ResultsFile::~ResultsFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void ResultsFile::refuse(const std::string& reason) const {
  throw UsageError("cannot write '" + file_ + "': " + reason);
}

void ResultsFile::openForWriting(int flags) {
  descriptor_ = open(file_.c_str(), O_RDWR | O_APPEND | O_CLOEXEC | flags, 0666);
  if (descriptor_ < 0) refuse(std::strerror(errno));
  // Unlike flock's, this one is not handed on to workers, and ends with its process.
  struct flock whole = {};
  whole.l_type = F_WRLCK;
  whole.l_whence = SEEK_SET;
  if (fcntl(descriptor_, F_SETLK, &whole) == 0) return;
  if (errno == EACCES || errno == EAGAIN) refuse("another process is writing to it");
  refuse(std::strerror(errno));
}

void ResultsFile::openPipe() {
  requireWritable(file_);
  descriptor_ = open(file_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor_ < 0) refuse(std::strerror(errno));
}

void ResultsFile::writeLine(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t written = write(descriptor_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse(std::strerror(errno));
    done += static_cast<std::size_t>(written);
  }
  if (fdatasync(descriptor_) != 0 && errno != EINVAL) refuse(std::strerror(errno));
}

void ResultsFile::append(const RunResult& result) {
  if (descriptor_ < 0) openForWriting(O_CREAT | O_EXCL);
  if (results_.header.is_null()) {
    writeLine(lineOf(header_));
    results_.header = header_;
  }
  writeLine(lineOf(resultJson(result)));
}

}  // namespace swept
