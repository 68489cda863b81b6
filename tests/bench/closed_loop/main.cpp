#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>

#include "../run_cases.hpp"
#include "data_files/robot_file.hpp"
#include "output.hpp"

namespace {

using namespace demecal;
using namespace demecal::bench;

struct Options {
  int cases = 0;
  std::string kind;
  int threads = 2;
  bool json = false, each = false;
};

Robots load_robots(const std::vector<CasePlan>& planned) {
  Robots robots;
  for (const CasePlan& plan : planned) {
    if (robots.contains(plan.robot_file)) continue;
    robots[plan.robot_file] =
        load_robot(std::filesystem::path(DEMECAL_SOURCE_DIR) / "configs/robots" / plan.robot_file);
  }
  return robots;
}

/// Cases by their place among the planned ones, whichever thread ran them.
class Bench {
 public:
  Bench(std::vector<CasePlan> planned, const Options& options)
      : planned_(std::move(planned)), options_(options), robots_(load_robots(planned_)), cases_(planned_.size()) {}

  void run() {
    run_cases(planned_.size(), options_.threads,
              [this](std::size_t i) { cases_[i] = run_case(planned_[i], robots_, options_.kind == kClean); });
  }
  void write() const {
    if (options_.each) {
      for (const CaseFigures& one : cases_) write_case(std::cout, one, robots_.at(one.plan.robot_file));
    }
    const std::vector<Summary> rows = summaries(cases_);
    if (options_.json) return write_json(std::cout, rows);
    write_table(std::cout, rows);
  }

 private:
  std::vector<CasePlan> planned_;
  Options options_;
  Robots robots_;
  std::vector<CaseFigures> cases_;
};

int default_cases(const std::string& kind) {
  if (kind.empty() || kind == kClean) return kCases;
  int cases = 0;
  for (int number = 0; number < kCases; ++number) cases += plan_of(number).kind == kind ? 1 : 0;
  return cases;
}

std::vector<std::string> known_kinds() {
  std::vector<std::string> kinds{kClean};
  for (const KindRow& row : kind_table()) kinds.push_back(row.kind);
  return kinds;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "How the closed loop names undeclared effects of simulated arms: each case hides one (or two) in the "
      "measurements of an arm, at two to four times the size that the same poses could show, and runs without "
      "it too."};
  Options options;
  app.add_flag("--json", options.json, "one JSON object a line instead of the table");
  app.add_option("--cases", options.cases, "number of cases (240)")->check(CLI::PositiveNumber);
  app.add_option("--kind", options.kind, "cases of one kind only")->check(CLI::IsMember(known_kinds()));
  app.add_option("--threads", options.threads, "cases at a time; figures do not depend on it")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_flag("--each", options.each, "also one JSON object a case: its truth, its rounds and its figures");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  const int cases = options.cases > 0 ? options.cases : default_cases(options.kind);
  Bench bench(plans(cases, options.kind), options);
  bench.run();
  bench.write();
  return 0;
}
