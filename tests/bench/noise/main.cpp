#include <CLI/CLI.hpp>
#include <iostream>

#include "../run_cases.hpp"
#include "mistaken_case.hpp"
#include "noise_figures.hpp"

namespace {

using namespace demecal;
using namespace demecal::bench;

struct Options {
  int cases = kNoiseCases;
  std::vector<std::string> conditions;
  int threads = 2;
  bool json = false, each = false;
};

/// Cases by their place among the planned ones, whichever thread ran them.
class Bench {
 public:
  explicit Bench(const Options& options)
      : options_(options), arms_(mistaken_arms(DEMECAL_SOURCE_DIR "/configs/robots")) {
    for (const std::string& condition : options.conditions) {
      for (NoiseCase& one : noise_cases(condition, options.cases)) planned_.push_back(std::move(one));
    }
    cases_.resize(planned_.size());
  }

  void run() {
    run_cases(planned_.size(), options_.threads,
              [this](std::size_t i) { cases_[i] = run_noisy_case(planned_[i], arms_); });
  }
  void write() const {
    if (options_.each) {
      for (const NoisyCaseFigures& one : cases_) write_noisy_case(std::cout, one, arms_[one.plan.arm(arms_.size())]);
    }
    const auto a_condition = static_cast<std::ptrdiff_t>(options_.cases);
    for (auto first = cases_.begin(); first != cases_.end(); first += a_condition) {
      const std::vector<NoiseFigure> figures = noise_figures({first, first + a_condition});
      options_.json ? write_noise_json(std::cout, figures) : write_noise_table(std::cout, figures);
    }
  }

 private:
  Options options_;
  std::vector<Robot> arms_;
  std::vector<NoiseCase> planned_;
  std::vector<NoisyCaseFigures> cases_;
};

std::vector<std::string> all_conditions() {
  std::vector<std::string> names;
  for (const NoiseCondition& condition : noise_conditions()) names.push_back(condition.name);
  return names;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "How `demecal diagnose` does under noise as measurements have it: whether it finds what is not there, whether a "
      "few bad poses harm it, whether it finds what it says it would, and whether its intervals hold."};
  Options options;
  app.add_flag("--json", options.json, "one JSON object a figure instead of the table");
  app.add_option("--cases", options.cases, "number of cases of each condition")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--condition", options.conditions, "these conditions only, LIST")
      ->delimiter(',')
      ->check(CLI::IsMember(all_conditions()));
  app.add_option("--threads", options.threads, "cases at a time; figures do not depend on it")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_flag("--each", options.each, "also one JSON object a case: its runs, their rounds and effects");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  if (options.conditions.empty()) options.conditions = all_conditions();
  Bench bench(options);
  bench.run();
  bench.write();
  return 0;
}
