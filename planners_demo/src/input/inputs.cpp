// SPDX-License-Identifier: BSD-3-Clause
#include "input/inputs.hpp"

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "input/state_lists.hpp"
#include "input/task.hpp"
#include "input/work_cells.hpp"
#include "output/whole_file.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

constexpr int kMostProblems = std::numeric_limits<int>::max();

constexpr const char* kWithoutDefaultContacts = "without_default_contacts";

/// Of an `--attach`: whether its shape is a mesh file.
bool isFile(const std::string& attached) {
  for (const char* type : {"box:", "sphere:", "cylinder:"})
    if (attached.starts_with(type)) return false;
  return attached.find('@') != std::string::npos;
}

/// Reads or writes the fields of Arguments that count, one after the other.
class Writer {
 public:
  explicit Writer(const fs::path& file)
      : folder_(fs::weakly_canonical(fs::absolute(endOfLinks(file)).parent_path())) {}

  void file(const char* key, const std::string& name) {
    if (!name.empty()) json_[key] = relative(name);
  }
  void files(const char* key, const std::vector<std::string>& names) {
    for (const std::string& name : names) json_[key].push_back(relative(name));
  }
  template <typename Value>
  void value(const char* key, const std::optional<Value>& value) {
    if (value) json_[key] = *value;
  }
  void text(const char* key, const std::string& text) {
    if (!text.empty()) json_[key] = text;
  }
  void flag(const char* key, bool flag) {
    if (flag) json_[key] = true;
  }
  void texts(const char* key, const std::vector<std::string>& texts) {
    if (!texts.empty()) json_[key] = texts;
  }
  void packages(const char* key, const std::vector<std::string>& packages) {
    for (const std::string& package : packages) {
      const std::size_t folder = package.find('=') + 1;
      json_[key].push_back(package.substr(0, folder) + relative(package.substr(folder)));
    }
  }
  void attached(const char* key, const std::vector<std::string>& attached) {
    for (const std::string& text : attached) {
      const std::size_t at = text.rfind('@');
      json_[key].push_back(isFile(text) ? relative(text.substr(0, at)) + text.substr(at) : text);
    }
  }
  Json json() const { return json_; }

 private:
  /// Folders as they are without symbolic links, behind which `..` is another folder than it looks
  /// like. A file keeps its own name: what it names is looked for beside it.
  std::string relative(const std::string& name) const {
    const fs::path path = fs::absolute(name);
    return (fs::weakly_canonical(path.parent_path()) / path.filename())
        .lexically_normal()
        .lexically_proximate(folder_)
        .string();
  }
  fs::path folder_;
  Json json_ = Json::object();
};

class Reader {
 public:
  explicit Reader(const JsonValue& json)
      : json_(json), folder_(endOfLinks(json.file()).parent_path()) {
    if (!json.isObject()) json.refuse("an object");
  }

  void file(const char* key, std::string& name) {
    text(key, name);
    if (!name.empty()) name = absolute(name);
  }
  void files(const char* key, std::vector<std::string>& names) {
    texts(key, names);
    for (std::string& name : names) name = absolute(name);
  }
  void value(const char* key, std::optional<double>& value) {
    if (json_.has(key)) value = json_.at(key).notNegative();
  }
  void value(const char* key, std::optional<int>& value) {
    if (json_.has(key)) value = static_cast<int>(json_.at(key).whole(0, kMostProblems));
  }
  void text(const char* key, std::string& text) {
    if (json_.has(key)) text = json_.at(key).text();
  }
  void flag(const char* key, bool& flag) {
    if (json_.has(key)) flag = json_.at(key).boolean();
  }
  void texts(const char* key, std::vector<std::string>& texts) {
    if (!json_.has(key)) return;
    for (const JsonValue& item : json_.at(key).elements()) texts.push_back(item.text());
  }
  void packages(const char* key, std::vector<std::string>& packages) {
    texts(key, packages);
    for (std::string& package : packages) {
      const std::size_t folder = package.find('=') + 1;
      package.replace(folder, std::string::npos, absolute(package.substr(folder)));
    }
  }
  void attached(const char* key, std::vector<std::string>& attached) {
    texts(key, attached);
    for (std::string& text : attached) {
      const std::size_t at = text.rfind('@');
      if (isFile(text)) text = absolute(text.substr(0, at)) + text.substr(at);
    }
  }

 private:
  /// The short form only where symbolic links let it be the same place.
  std::string absolute(const std::string& name) const {
    const fs::path path = folder_ / name;
    const fs::path shorter = path.lexically_normal();
    const bool same =
        fs::weakly_canonical(path.parent_path()) == fs::weakly_canonical(shorter.parent_path());
    return (same ? shorter : path).string();
  }
  const JsonValue& json_;
  fs::path folder_;
};

template <typename Visitor, typename Args>
void visit(Visitor& visitor, Args& args) {
  visitor.file("robot", args.robot);
  visitor.flag("xacro", args.xacro);
  visitor.texts("xacro_args", args.xacroArguments);
  visitor.packages("packages", args.packages);
  visitor.text("group", args.group);
  visitor.text("joints", args.joints);
  visitor.text("chain", args.chain);
  visitor.file("scene", args.scene);
  visitor.files("clouds", args.clouds);
  visitor.value("point_radius", args.pointRadius);
  visitor.text("cloud_pose", args.cloudPose);
  visitor.value("self_filter", args.selfFilter);
  visitor.value("occluded", args.occluded);
  visitor.file("problems", args.problems);
  visitor.text("set", args.set);
  visitor.value("index", args.index);
  visitor.file("request", args.request);
  visitor.texts("states", args.states);
  visitor.texts("pad", args.pads);
  visitor.texts("scale", args.scales);
  visitor.texts("allow", args.allowed);
  visitor.attached("attach", args.attached);
  visitor.texts("stand", args.standing);
  visitor.text("tracking", args.tracking);
  visitor.file("controllers", args.controllers);
  visitor.texts("keep_upright", args.keepUpright);
  visitor.texts("keep_level", args.keepLevel);
  visitor.texts("stay_in", args.stayIn);
  visitor.texts("stay_on", args.stayOn);
}

}  // namespace

Json inputsJson(const Arguments& args, const fs::path& file) {
  Writer writer(file);
  visit(writer, args);
  const std::string srdf = chooseSrdf(args).file;
  if (srdf.empty())
    writer.text("srdf", "none");
  else
    writer.file("srdf", srdf);
  Json json = writer.json();
  // Files that do not say so are older, and about all pairs.
  if (leavesOutDefaultContacts(args)) json[kWithoutDefaultContacts] = true;
  json["margin"] = args.margin;
  if (args.selfMargin) json["margin_self"] = *args.selfMargin;
  if (args.worldMargin) json["margin_world"] = *args.worldMargin;
  json["tolerance"] = args.tolerance;
  return json;
}

Json inputsOfPath(const Arguments& args, const fs::path& file, std::span<const double> from,
                  std::span<const double> to) {
  Arguments inputs = args;
  inputs.states = {stateText(from), stateText(to)};
  return inputsJson(inputs, file);
}

Arguments inputsOf(const JsonValue& inputs) {
  Arguments args;
  Reader reader(inputs);
  visit(reader, args);
  if (args.robot.empty()) inputs.at("robot").refuse("a URDF file");
  reader.text("srdf", args.srdf);
  if (args.srdf != "none") reader.file("srdf", args.srdf);
  const bool leavesOut =
      inputs.has(kWithoutDefaultContacts) && inputs.at(kWithoutDefaultContacts).boolean();
  args.keepDefaultContacts = !leavesOut && !isWorkCell(args) && chooseSrdf(args).file.empty();
  std::optional<double> margin, tolerance;
  reader.value("margin", margin);
  reader.value("margin_self", args.selfMargin);
  reader.value("margin_world", args.worldMargin);
  reader.value("tolerance", tolerance);
  args.margin = margin.value_or(args.margin);
  args.tolerance = tolerance.value_or(args.tolerance);
  return args;
}

}  // namespace swept
