// SPDX-License-Identifier: BSD-3-Clause
#include "swept/pages/task_page.hpp"

#include <map>
#include <stdexcept>
#include <utility>

#include "output/whole_file.hpp"
#include "page/page_content.hpp"
#include "page/page_data.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {

struct TaskPage::Data {
  /// What is in several phases, such as the robot's meshes, is in the file once.
  class SharedValues {
   public:
    /// Moves the values of a list here, and leaves their places.
    void take(Json& list) {
      for (Json& value : list) {
        const auto [entry, isNew] = places_.emplace(value.dump(), values_.size());
        if (isNew) values_.push_back(std::move(value));
        value = entry->second;
      }
    }
    const Json& values() const { return values_; }

   private:
    std::map<std::string, std::size_t> places_;
    Json values_ = Json::array();
  };

  PageOptions options;
  std::vector<Finding> findings;
  SharedValues shared;
  Json phases = Json::array();
  double end = 0.0;  ///< s, of the last phase
};

TaskPage::TaskPage(PageOptions options) : data_(std::make_unique<Data>()) {
  data_->options = std::move(options);
}
TaskPage::~TaskPage() = default;
TaskPage::TaskPage(TaskPage&&) noexcept = default;
TaskPage& TaskPage::operator=(TaskPage&&) noexcept = default;

void TaskPage::addPhase(const std::string& label, std::shared_ptr<const Checker> checker,
                        const PiecewisePolynomial& curve, const TrajectoryQuery& query,
                        const std::vector<std::string>& changes) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { addPhase(label, std::move(checker), curve, query, changes); });
  }
  PageOptions own = data_->options;
  own.headline = {};
  Page page(std::move(checker), std::move(own));
  page.addTrajectory(label, curve, query);
  if (!data_->phases.empty() && curve.begin() < data_->end)
    throw std::invalid_argument("'" + label + "' begins at " + shortNumber(curve.begin()) +
                                " s, and the phase before ends at " + shortNumber(data_->end) +
                                " s");
  Json shown = page.data_->json();
  data_->shared.take(shown["geometries"]);
  data_->shared.take(shown["covers"]);
  data_->findings.push_back(page.data_->findings.front());
  data_->end = curve.end();
  Json phase = {{"label", label}, {"begin", curve.begin()}, {"end", curve.end()}};
  phase["changes"] = changes;
  phase["tone"] = shown["tone"];
  phase["data"] = std::move(shown);
  data_->phases.push_back(std::move(phase));
}

std::string TaskPage::html() const {
  if (detail::inForeignEnvironment()) return inDefaultEnvironment([&] { return html(); });
  if (data_->phases.empty()) throw std::invalid_argument("a page of nothing");
  const std::string counted = countsText("phase", data_->findings);
  Json task = {{"title", data_->options.title},
               {"headline", data_->options.headline.empty() ? counted : data_->options.headline},
               {"tone", toString(toneOf(worst(data_->findings).verdict))}};
  task["shared"] = data_->shared.values();
  task["phases"] = data_->phases;
  return taskHtmlOf(std::move(task));
}

void TaskPage::write(const std::filesystem::path& file) const {
  const std::string name = file.string();
  if (file.extension() != ".html" && file.extension() != ".htm")
    throw UsageError("'" + name + "': a page ends in .html or .htm");
  requireWritable(file);
  writeWholeFile(name, html());
}

}  // namespace swept
