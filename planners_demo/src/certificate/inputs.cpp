// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/inputs.hpp"

#include <optional>
#include <string>
#include <vector>

#include "input/task.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

/// Of an `--attach`: whether its shape is a mesh file.
bool isFile(const std::string& attached) {
  for (const char* type : {"box:", "sphere:", "cylinder:"})
    if (attached.starts_with(type)) return false;
  return attached.find('@') != std::string::npos;
}

/// Reads or writes the fields of Arguments that count, one after the other.
class Writer {
 public:
  explicit Writer(const fs::path& pathFile) : folder_(fs::absolute(pathFile).parent_path()) {}

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
  std::string relative(const std::string& name) const {
    return fs::absolute(name).lexically_normal().lexically_proximate(folder_).string();
  }
  fs::path folder_;
  Json json_ = Json::object();
};

class Reader {
 public:
  Reader(const Json& json, const fs::path& pathFile) : json_(json), pathFile_(pathFile) {
    if (!json.is_object()) refuse("inputs");
  }

  void file(const char* key, std::string& name) {
    text(key, name);
    if (!name.empty()) name = absolute(name);
  }
  void files(const char* key, std::vector<std::string>& names) {
    texts(key, names);
    for (std::string& name : names) name = absolute(name);
  }
  template <typename Value>
  void value(const char* key, std::optional<Value>& value) {
    if (!json_.contains(key)) return;
    if (!json_[key].is_number()) refuse(key);
    value = json_[key].get<Value>();
  }
  void text(const char* key, std::string& text) {
    if (!json_.contains(key)) return;
    if (!json_[key].is_string()) refuse(key);
    text = json_[key].get<std::string>();
  }
  void texts(const char* key, std::vector<std::string>& texts) {
    if (!json_.contains(key)) return;
    if (!json_[key].is_array()) refuse(key);
    for (const Json& item : json_[key]) {
      if (!item.is_string()) refuse(key);
      texts.push_back(item.get<std::string>());
    }
  }
  void packages(const char* key, std::vector<std::string>& packages) {
    texts(key, packages);
    for (std::string& package : packages) {
      const std::size_t folder = package.find('=') + 1;
      package = package.substr(0, folder) + absolute(package.substr(folder));
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
  std::string absolute(const std::string& name) const {
    return (pathFile_.parent_path() / name).lexically_normal().string();
  }
  [[noreturn]] void refuse(const std::string& key) const {
    throw InputError(pathFile_.string(), 0,
                     "inputs: " + key + " is not what a path file has there");
  }
  const Json& json_;
  fs::path pathFile_;
};

template <typename Visitor, typename Args>
void visit(Visitor& visitor, Args& args) {
  visitor.file("robot", args.robot);
  visitor.packages("packages", args.packages);
  visitor.text("group", args.group);
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
}

}  // namespace

Json inputsJson(const Arguments& args, const fs::path& pathFile) {
  Writer writer(pathFile);
  visit(writer, args);
  const std::string srdf = chooseSrdf(args).file;
  if (srdf.empty())
    writer.text("srdf", "none");
  else
    writer.file("srdf", srdf);
  Json json = writer.json();
  json["margin"] = args.margin;
  json["tolerance"] = args.tolerance;
  return json;
}

Arguments inputsOf(const Json& inputs, const fs::path& pathFile) {
  Arguments args;
  Reader reader(inputs, pathFile);
  visit(reader, args);
  std::string srdf;
  reader.text("srdf", srdf);
  args.srdf = srdf;
  if (srdf != "none") reader.file("srdf", args.srdf);
  std::optional<double> margin, tolerance;
  reader.value("margin", margin);
  reader.value("tolerance", tolerance);
  args.margin = margin.value_or(args.margin);
  args.tolerance = tolerance.value_or(args.tolerance);
  return args;
}

}  // namespace swept
