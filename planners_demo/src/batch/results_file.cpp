// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

#include "batch/results_header.hpp"
#include "command_line/exit_code.hpp"
#include "output/whole_file.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

constexpr std::string_view kHeaderBegin = R"({"format":"swept bench planners")";

/// True for a file that holds only the torn beginning of a header.
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

/// Each line is checked as soon as it is read: a file of another kind may never end.
class Lines {
 public:
  explicit Lines(std::string file) : file_(std::move(file)) {}

  void add(std::string_view text) {
    for (std::size_t end; (end = text.find('\n')) != std::string_view::npos;) {
      rest_.append(text.substr(0, end));
      addLine();
      text.remove_prefix(end + 1);
    }
    rest_.append(text);
    if (number_ == 0 && !isTornHeader(rest_)) requireHeader({}, file_);
    if (rest_.size() > kMaxTextBytes)
      throw InputError(file_, number_ + 1,
                       "the line has more than " + std::to_string(kMaxTextBytes) +
                           " bytes, which are the most that are read of one");
  }

  Results end() {
    results_.tornBytes = rest_.size();
    return std::move(results_);
  }

 private:
  void addLine() {
    results_.wholeBytes += rest_.size() + 1;
    const std::string line = std::exchange(rest_, {});
    if (++number_ > 1) return addRun(results_, known_, line, file_, number_);
    requireModestJson(line, file_);
    results_.header = Json::parse(line, nullptr, false);
    requireHeader(results_.header, file_);
  }

  std::string file_;
  Results results_;
  std::map<RunKey, std::string> known_;
  int number_ = 0;    ///< of the last line with an end
  std::string rest_;  ///< what is there of the next one
};

/// Works also for pipes, and for files larger than a text file may be.
Results allOf(int descriptor, const std::string& file) {
  Lines lines(file);
  std::array<char, 65536> buffer{};
  for (ssize_t count; (count = read(descriptor, buffer.data(), buffer.size())) != 0;) {
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuseToRead(file);
    lines.add({buffer.data(), static_cast<std::size_t>(count)});
  }
  return lines.end();
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

Results readResults(const std::string& file, Warnings& warnings) {
  if (!std::filesystem::exists(file)) throw InputError(file, 0, "file not found");
  const Input input(file);
  Results results = allOf(input.descriptor(), file);
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
  results_ = allOf(descriptor_, file);
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
  // Unlike a lock by flock, this one is not inherited by workers, and ends with its process.
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
