#include <sys/wait.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ostream.h>

#include "../run_cases.hpp"
#include "data_files/data_set_file.hpp"
#include "mistaken_case.hpp"

namespace {

using namespace demecal;
using namespace demecal::bench;
using Json = nlohmann::ordered_json;

struct Options {
  int clean = 160, drawn = 10, threads = 2;
  bool json = false;
  MistakeDraw draw;
  std::string kind;
  std::filesystem::path measured;
};

/// What `demecal diagnose` made of a case.
struct Outcome {
  int exit_code = -1;
  std::string verdict = "none";
  std::vector<std::string> kinds, poses;
  double as_given_mm = 0.0, if_changed_mm = 0.0;
  std::string sentence;
};

double number_of(const Json& value) {
  return value.is_number() ? value.get<double>() : std::nan("");
}

/// The first finding of the true kind, otherwise the first there is.
const Json* telling(const Json& findings, const std::string& kind) {
  for (const Json& finding : findings)
    if (finding["kind"] == kind) return &finding;
  return findings.empty() ? nullptr : &findings.front();
}

Outcome run_case(const MistakenCase& one, const std::filesystem::path& folder) {
  const std::filesystem::path data = write_data_set(one.data, folder / "data", one.what), out = folder / "out";
  const std::string command =
      fmt::format("'{}/bin/demecal' diagnose '{}' --out '{}' --max-effects 0 --quiet >'{}' 2>&1", DEMECAL_BINARY_DIR,
                  data.string(), out.string(), (folder / "log").string());
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  std::ifstream file(out / "report.json");
  if (!file) {
    std::ifstream log(folder / "log");
    std::getline(log, outcome.sentence);
    return outcome;
  }
  const Json check = Json::parse(file)["data_check"];
  outcome.verdict = check["verdict"];
  for (const Json& finding : check["findings"]) {
    outcome.kinds.push_back(finding["kind"]);
    for (const Json& pose : finding["poses"]) outcome.poses.push_back(pose);
  }
  const std::string kind = one.kind ? std::string(to_string(*one.kind)) : "";
  if (const Json* finding = telling(check["findings"], kind)) {
    outcome.as_given_mm = number_of((*finding)["error_mm"]["as_given"]);
    outcome.if_changed_mm = number_of((*finding)["error_mm"]["if_changed"]);
    outcome.sentence = (*finding)["sentence"];
  }
  return outcome;
}

bool is_refused(const Outcome& outcome) {
  return outcome.exit_code == 11 || outcome.exit_code == 12;
}
bool is_named(const Outcome& outcome) {
  return is_refused(outcome) || outcome.verdict == "suspicious";
}
bool is_true(const MistakenCase& one, const Outcome& outcome) {
  return std::ranges::count(outcome.kinds, to_string(*one.kind)) > 0;
}
/// Whether every mistaken pose is named.
bool has_all_poses(const MistakenCase& one, const Outcome& outcome) {
  return std::ranges::all_of(one.poses,
                             [&](const std::string& id) { return std::ranges::count(outcome.poses, id) > 0; });
}

class Bench {
 public:
  Bench(std::vector<MistakenCase> cases, const Options& options)
      : cases_(std::move(cases)), outcomes_(cases_.size()), options_(options) {
    std::string pattern = (std::filesystem::temp_directory_path() / "demecal-mistakes-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder can be made");
    folder_ = pattern;
  }
  ~Bench() { std::filesystem::remove_all(folder_); }

  void run() {
    run_cases(cases_.size(), options_.threads, [this](std::size_t i) {
      const std::filesystem::path folder = folder_ / std::to_string(i);
      outcomes_[i] = run_case(cases_[i], folder);
      std::filesystem::remove_all(folder);
    });
  }

  void write() const {
    for (std::size_t i = 0; i < cases_.size(); ++i) options_.json ? write_json(i) : write_line(i);
    write_totals();
  }

 private:
  void write_json(std::size_t i) const {
    const MistakenCase& one = cases_[i];
    const Outcome& outcome = outcomes_[i];
    const Json line{{"case", one.number},
                    {"arm", one.arm},
                    {"mistake", one.what},
                    {"kind", one.kind ? std::string(to_string(*one.kind)) : "none"},
                    {"exit_code", outcome.exit_code},
                    {"verdict", outcome.verdict},
                    {"named", outcome.kinds},
                    {"poses_named", has_all_poses(one, outcome)},
                    {"error_mm", {{"as_given", outcome.as_given_mm}, {"if_changed", outcome.if_changed_mm}}},
                    {"sentence", outcome.sentence}};
    std::cout << line.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n';
  }

  void write_line(std::size_t i) const {
    const MistakenCase& one = cases_[i];
    const Outcome& outcome = outcomes_[i];
    const bool right = one.kind ? is_named(outcome) && is_true(one, outcome) && has_all_poses(one, outcome)
                                : !is_named(outcome) && outcome.exit_code == 0;
    if (!one.kind && right) return;
    std::string kinds;
    for (const std::string& kind : outcome.kinds)
      if (kinds.find(kind) == std::string::npos) kinds += (kinds.empty() ? "" : " ") + kind;
    fmt::print(std::cout, "{} {:<18} {:<46} exit {:>3}  {:<40} {:>9.2f} -> {:.2f} mm\n", right ? ' ' : '!', one.arm,
               one.what, outcome.exit_code, kinds, outcome.as_given_mm, outcome.if_changed_mm);
    if (!right) fmt::print(std::cout, "    {}\n", outcome.sentence);
  }

  void write_totals() const {
    int made = 0, named = 0, right = 0, poses = 0, single = 0, clean = 0, refused = 0, suspicious = 0;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      const Outcome& outcome = outcomes_[i];
      if (cases_[i].kind) {
        ++made;
        named += is_named(outcome) ? 1 : 0;
        right += is_true(cases_[i], outcome) ? 1 : 0;
        single += cases_[i].poses.empty() ? 0 : 1;
        poses += !cases_[i].poses.empty() && has_all_poses(cases_[i], outcome) ? 1 : 0;
      } else {
        ++clean;
        refused += outcome.exit_code != 0 ? 1 : 0;
        suspicious += outcome.verdict == "suspicious" ? 1 : 0;
      }
    }
    if (options_.json) {
      std::cout << Json{{"mistakes", made},          {"refused_or_named", named}, {"kind_right", right},
                        {"of_single_poses", single}, {"all_poses_named", poses},  {"unmistaken", clean},
                        {"refused", refused},        {"suspicious", suspicious}}
                << '\n';
      return;
    }
    fmt::print(std::cout,
               "\nmistakes {}: refused or named {} (bound: all), kind right {} (bound: 95 %); of {} with single poses "
               "all named in {}\n",
               made, named, right, single, poses);
    fmt::print(std::cout, "unmistaken {}: refused {} (bound: none), suspicious {} (bound: 2 %)\n", clean, refused,
               suspicious);
  }

  std::vector<MistakenCase> cases_;
  std::vector<Outcome> outcomes_;
  Options options_;
  std::filesystem::path folder_;
};

/// Data sets of measured robots, where there are some: whole, and drawn from.
std::vector<MistakenCase> measured_cases(const Options& options) {
  std::vector<MistakenCase> cases;
  for (const char* file : {"ur5-tracker/ur5-grid.yaml", "wam-tracker/wam-grid.yaml", "ur10-leica/series-a.yaml",
                           "ur10-leica/series-b.yaml", "ur10-leica/series-c.yaml"}) {
    if (!std::filesystem::exists(options.measured / file)) continue;
    const DataSet data = load_data_set(options.measured / file);
    cases.push_back({.number = 0, .arm = data.robot.name, .what = data.name + ", whole", .kind = {}, .data = data});
    for (MistakenCase& one : drawn_cases(data, options.drawn, options.draw)) cases.push_back(std::move(one));
  }
  return cases;
}

std::vector<MistakenCase> all_cases(const Options& options) {
  const std::vector<Robot> arms = mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots");
  std::vector<MistakenCase> cases = mistaken_cases(arms, options.draw);
  for (MistakenCase& one : unmistaken_cases(arms, options.clean, options.draw)) cases.push_back(std::move(one));
  for (MistakenCase& one : measured_cases(options)) cases.push_back(std::move(one));
  if (options.kind.empty()) return cases;
  std::erase_if(cases, [&](const MistakenCase& one) {
    return (one.kind ? std::string(to_string(*one.kind)) : "none") != options.kind;
  });
  return cases;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Whether mistakes in data sets are noticed: each case has one, or none; `demecal diagnose` runs on it, and what "
      "it says is compared with what was done."};
  Options options;
  options.measured = DEMECAL_SOURCE_DIR "/../shared/data";
  app.add_flag("--json", options.json, "one JSON object a case instead of the table");
  app.add_option("--kind", options.kind, "mistakes of one kind only; `none`: the unmistaken");
  app.add_option("--clean", options.clean, "simulated data sets without a mistake")->capture_default_str();
  app.add_option("--drawn", options.drawn, "data sets drawn from each measured one")->capture_default_str();
  app.add_option("--measured", options.measured, "folder of measured robots; left out where it is not there");
  app.add_option("--threads", options.threads, "cases at a time")->capture_default_str()->check(CLI::PositiveNumber);
  app.add_option("--seed", options.draw.seed, "another draw than the one that figures are stated of")
      ->capture_default_str();
  app.add_option("--poses", options.draw.poses, "calibration, validation and accept poses of mistaken data sets")
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  Bench bench(all_cases(options), options);
  bench.run();
  bench.write();
  return 0;
}
