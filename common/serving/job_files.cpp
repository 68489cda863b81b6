#include "serving/job_files.hpp"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <sstream>

#include "errors/input_error.hpp"

namespace demecal::inline serving {
namespace {

/// The parts of a path, less those that lead nowhere.
std::vector<std::string> parts_of_path(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream path(text);
  for (std::string part; std::getline(path, part, '/');) {
    if (!part.empty() && part != ".") parts.push_back(part);
  }
  return parts;
}

bool leads_elsewhere(const std::string& text) {
  return text.starts_with('/') || std::ranges::count(parts_of_path(text), "..") > 0;
}

/// `key` is the nearest one above the node that has a name.
void check(const YamlNode& node, const std::string& key, const std::set<std::string>& uploaded) {
  if (node.kind == YamlNode::Kind::scalar) {
    if (node.scalar.find('\0') != std::string::npos)
      node.fail("", "may name uploaded files only, and holds a byte that ends a name");
    if (leads_elsewhere(node.scalar)) node.fail("may name uploaded files only: no absolute path, and none with `..`");
    const std::vector<std::string> parts = parts_of_path(node.scalar);
    const std::string name = parts.size() == 1 ? parts.front() : "";  // all uploaded files lie in one folder
    const bool is_table = key == "poses" || key == "file";
    if (!is_table && uploaded.contains(name) && !is_yaml_name(name))
      node.fail("names a file that is read as YAML here: its name must end in .yaml");
  }
  for (const YamlNode& child : node.children) check(child, child.name.empty() ? key : child.name, uploaded);
}

}  // namespace

bool is_yaml_name(const std::string& name) {
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

void check_named_files(const YamlNode& file, const std::set<std::string>& uploaded) {
  check(file, "", uploaded);
}

JobFiles find_job(const std::map<std::string, YamlNode>& files) {
  JobFiles found;
  for (const auto& [name, root] : files) {
    if (root.kind != YamlNode::Kind::map || root.find("demecal_job") == nullptr) continue;
    if (!found.job.empty())
      throw InputError(
          {name, 0}, "",
          "is a second job beside " + found.job + ": a run is of one (demecal_job: 1), so remove the other");
    found.job = name;
    const YamlNode* const data = root.find("data");
    const YamlNode* const stations =
        data != nullptr && data->kind == YamlNode::Kind::map ? data->find("stations") : data;
    if (stations == nullptr) continue;
    if (stations->kind == YamlNode::Kind::scalar) found.data.push_back(stations->scalar);
    for (const YamlNode& station : stations->children) found.data.push_back(station.scalar);
  }
  if (found.job.empty()) throw InputError({}, "", "there is no job: upload a JOB.yaml (demecal_job: 1)");
  return found;
}

namespace {

using Json = nlohmann::ordered_json;

/// What is there of these keys, or null.
Json members(const Json& from, std::initializer_list<const char*> keys) {
  Json found = Json::object();
  for (const char* const key : keys) found[key] = from.is_object() && from.contains(key) ? from[key] : Json();
  return found;
}

Json report_row(const std::string& job, const std::string& text) {
  const Json report = Json::parse(text, nullptr, false);
  if (!report.is_object() || !report.contains("error_mm")) return {{"job", job}, {"readable", false}};
  Json made{{"job", job}, {"readable", true}};
  made.update(members(report, {"robot", "method", "seed", "data_sha256", "version"}));
  const Json& errors = report["error_mm"];
  for (const char* const stage : {"registered", "before", "after"}) {
    const Json sets = members(errors, {stage})[stage];
    for (const char* const set : {"calibration", "validation", "accept"})
      made["error_mm"][stage][set] = members(members(sets, {set})[set], {"mean", "rms", "p95", "max"});
  }
  return made;
}

}  // namespace

std::string comparison_text(const std::vector<std::pair<std::string, std::string>>& reports) {
  Json rows = Json::array();
  for (const auto& [job, text] : reports) rows.push_back(report_row(job, text));
  return Json{{"demecal_jobs_comparison", 1}, {"jobs", std::move(rows)}}.dump() + '\n';
}

}  // namespace demecal::inline serving
