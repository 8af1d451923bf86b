// SPDX-License-Identifier: BSD-3-Clause
#include "io/urdfdom_parse.hpp"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <mutex>
#include <new>
#include <thread>

#include "swept/robot_model/foreign_text.hpp"

namespace swept::detail {

namespace {

/// Collects what this thread logs through console_bridge, whose handler is global; what other
/// threads log meanwhile still reaches the handler that was there before.
class LogCapture final : public console_bridge::OutputHandler {
 public:
  LogCapture()
      : thread_(std::this_thread::get_id()), previous_(console_bridge::getOutputHandler()) {
    console_bridge::useOutputHandler(this);
  }
  ~LogCapture() override { console_bridge::useOutputHandler(previous_); }
  LogCapture(const LogCapture&) = delete;
  LogCapture& operator=(const LogCapture&) = delete;

  void log(const std::string& text, console_bridge::LogLevel level, const char* file,
           int line) override {
    if (std::this_thread::get_id() != thread_) {
      if (previous_ != nullptr) previous_->log(text, level, file, line);
    } else if (level == console_bridge::CONSOLE_BRIDGE_LOG_ERROR) {
      errors_ += (errors_.empty() ? "" : "; ") + text;
    }
  }
  const std::string& errors() const { return errors_; }

 private:
  std::thread::id thread_;
  console_bridge::OutputHandler* previous_;
  std::string errors_;
};

}  // namespace

urdf::ModelInterfaceSharedPtr parseWithUrdfdom(const std::string& text, const InputSource& source) {
  // One at a time, so that captures are put back in the reverse order of their making.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  const LogCapture capture;
  std::string reason;
  try {
    if (auto model = urdf::parseURDF(text)) return model;
    reason = capture.errors();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    reason = error.what();
  }
  source.fail(1, "urdfdom refuses the robot: " +
                     (reason.empty() ? "no reason given" : foreignText(reason)));
}

}  // namespace swept::detail
