#include "coordinator/written_files.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <sstream>

#include "yaml/files.hpp"

namespace demecal {
namespace {

constexpr const char* kList = ".demecal-files";
/// In place of a hash: of a file that is being written.
constexpr const char* kAnything = "----------------------------------------------------------------";

/// Words near the beginning of files by which those of earlier versions are known.
struct Mark {
  const char* name;
  const char* words;
};
constexpr std::array<Mark, 8> kMarks{{{"model.yaml", "demecal_model:"},
                                      {"report.json", "\"demecal_report\":"},
                                      {"report.html", "calibration report</title>"},
                                      {"events.jsonl", "\"demecal_events\":"},
                                      {"study.json", "\"demecal_study\":"},
                                      {"comparison.json", "\"demecal_comparison\":"},
                                      {"dataset.yaml", "# Measured on a simulated robot"},
                                      {"dataset.yaml", "# Prepared from raw measurements"}}};

bool has_mark(const std::string& folder, const Mark& mark) {
  constexpr std::size_t kBeginning = 4096;
  const std::string path = folder + "/" + mark.name;
  return std::filesystem::is_regular_file(path) &&
         read_file(path).substr(0, kBeginning).find(mark.words) != std::string::npos;
}

/// The file that tells for one which has no mark of its own.
std::string witness_of(const std::string& name) {
  const auto is_its = [&name](const Mark& mark) { return mark.name == name; };
  if (std::ranges::any_of(kMarks, is_its)) return name;
  if (name == "study.csv") return "study.json";
  const bool result = name == "history.csv" || name == "distal.csv" || name == "proposed.csv";
  return result ? "report.json" : "dataset.yaml";
}

bool is_of_earlier_version(const std::string& folder, const std::string& name) {
  const std::string witness = witness_of(name);
  return std::ranges::any_of(kMarks, [&](const Mark& mark) { return mark.name == witness && has_mark(folder, mark); });
}

}  // namespace

WrittenFiles::WrittenFiles(std::string folder) : folder_(std::move(folder)) {
  if (!std::filesystem::exists(path_of(kList))) {
    take_over();
    return;
  }
  std::istringstream lines(read_file(path_of(kList)));
  std::string hash, name;
  while (lines >> hash >> std::ws && std::getline(lines, name)) hashes_[name].insert(hash);
}

/// What an earlier version left, which kept no list, is as if listed.
void WrittenFiles::take_over() {
  if (!std::filesystem::is_directory(folder_)) return;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder_)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_regular_file() && is_of_earlier_version(folder_, name))
      hashes_[name] = {sha256(read_file(entry.path()))};
  }
}

bool WrittenFiles::is_ours(const std::string& name) const {
  const auto known = hashes_.find(name);
  if (known == hashes_.end()) return false;
  return known->second.contains(kAnything) || known->second.contains(sha256(read_file(path_of(name))));
}

std::vector<std::string> WrittenFiles::strangers(const std::vector<std::string>& names) const {
  std::vector<std::string> found;
  for (const std::string& name : names) {
    if (std::filesystem::exists(path_of(name)) && !is_ours(name)) found.push_back(name);
  }
  return found;
}

void WrittenFiles::write(const std::string& name, const std::string& bytes) {
  hashes_[name].insert(sha256(bytes));
  save();
  write_file(path_of(name), bytes);
  note_as_is(name);
}

void WrittenFiles::begin(const std::string& name) {
  hashes_[name] = {kAnything};
  save();
}

void WrittenFiles::note_as_is(const std::string& name) {
  if (std::filesystem::exists(path_of(name))) {
    hashes_[name] = {sha256(read_file(path_of(name)))};
  } else {
    hashes_.erase(name);
  }
  save();
}

void WrittenFiles::save() const {
  std::string text;
  for (const auto& [name, hashes] : hashes_) {
    for (const std::string& hash : hashes) text += hash + "  " + name + "\n";
  }
  write_file(path_of(kList), text);
}

}  // namespace demecal
