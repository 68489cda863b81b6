#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "../run_cases.hpp"
#include "closed_loop/summary.hpp"
#include "config/scenario_file.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/robot_file.hpp"
#include "evolution_case.hpp"
#include "simulation/simulated_robot.hpp"

namespace {

using namespace demecal;
using namespace demecal::bench;

constexpr std::array<const char*, 3> kRobots{"puma761.yaml", "ur10.yaml", "elbow-offset.yaml"};
constexpr std::size_t kMostOfFront = 10;
const std::filesystem::path kConfigs = std::filesystem::path(DEMECAL_SOURCE_DIR) / "configs";

/// A data set with what is declared of it.
struct NamedArm {
  const char* name;
  const char* file;
  bool simulated;     ///< the file is a scenario of the project, else a data set of the shared data
  bool registration;  ///< of a tracker; contacts have none
  bool joint_corrections;
};
constexpr std::array<NamedArm, 9> kNamed{{{"ur5", "ur5-tracker/ur5-grid.yaml", false, true, true},
                                          {"wam", "wam-tracker/wam-grid.yaml", false, true, true},
                                          {"ur10 A", "ur10-leica/series-a.yaml", false, true, false},
                                          {"ur10 B", "ur10-leica/series-b.yaml", false, true, false},
                                          {"ur10 C", "ur10-leica/series-c.yaml", false, true, false},
                                          {"panda-1", "panda-sockets/panda-1/dataset.yaml", false, false, false},
                                          {"panda-4", "panda-sockets/panda-4/dataset.yaml", false, false, false},
                                          {"demo", "demo.yaml", true, true, true},
                                          {"jumps", "jumps.yaml", true, true, true}}};

struct Options {
  int arms = 30;
  int seeds = 1;
  std::string data = std::string(DEMECAL_SOURCE_DIR) + "/../shared/data";
  std::vector<std::string> only;
  std::vector<int> numbers;  ///< of simulated arms; none: all
  std::size_t causes = 0;    ///< of every simulated arm; 0: varied_mixture()
  bool outside = false;      ///< where the causes are given
  int threads = 2;
  bool json = false;
};

nlohmann::json json_of(const EvolutionFigures& figures, bool simulated) {
  nlohmann::json front = nlohmann::json::array();
  for (const FrontPoint& point : figures.front)
    front.push_back({{"causes", point.causes},
                     {"validation_rms_mm", point.validation_rms_mm},
                     {"accept_rms_mm", point.accept_rms_mm.value_or(0.0)},
                     {"chosen", point.chosen}});
  nlohmann::json json{{"causes", figures.causes},       {"effects", figures.effects},
                      {"accept_mm", figures.accept_mm}, {"validation_mm", figures.validation_mm},
                      {"seconds", figures.seconds},     {"front", front}};
  json["fitted_mm"] = figures.fitted_mm;
  if (const CorrectionFigures& made = figures.corrections; made.joints > 0)
    json["corrections"] = {{"joints", made.joints},
                           {"most_nodes", made.most_nodes},
                           {"joints_with_short_form", made.shortened},
                           {"accept_with_short_forms_over_that_without", made.accept_with_short_forms},
                           {"least_term_rad", made.least_term_rad},
                           {"most_bound_over_limit", made.most_bound_over_limit}};
  if (simulated) {
    json["true_causes_named"] = figures.true_causes_named;
    json["missed"] = figures.missed;
    json["false_effects"] = figures.false_effects;
    json["exact_but_for_class"] = figures.is_exact_but_for_class;
  }
  return json;
}

/// Cases in the order of their numbers, whichever thread ran them.
class Bench {
 public:
  explicit Bench(const Options& options) : options_(options) {
    for (int seed = 1; seed <= options.seeds; ++seed)
      for (const NamedArm& arm : kNamed)
        if (is_wanted(arm.name) && (arm.simulated || std::filesystem::exists(options.data)))
          plan(arm, static_cast<std::uint64_t>(seed));
    for (int number = 0; number < options.arms && is_wanted("simulated"); ++number) {
      if (!options.numbers.empty() && std::ranges::count(options.numbers, number) == 0) continue;
      const Mixture mixture =
          options.causes == 0 ? varied_mixture(number) : Mixture{.causes = options.causes, .outside = options.outside};
      tasks_.emplace_back([number, mixture] {
        return run_simulated(
            number, mixture,
            load_robot(kConfigs / "robots" / kRobots[static_cast<std::size_t>(number) % kRobots.size()]));
      });
    }
    cases_.resize(tasks_.size());
  }

  void run() {
    run_cases(tasks_.size(), options_.threads, [this](std::size_t i) { cases_[i] = tasks_[i](); });
  }
  void write() const;

 private:
  bool is_wanted(const std::string& name) const {
    return options_.only.empty() || std::ranges::count(options_.only, name) > 0;
  }
  void plan(const NamedArm& arm, std::uint64_t seed) {
    tasks_.emplace_back([this, arm, seed]() -> std::optional<EvolutionCase> {
      const DeclaredModel declared{.registration = arm.registration,
                                   .tool = true,
                                   .joint_offset = true,
                                   .geometry = true,
                                   .joint_corrections = arm.joint_corrections};
      const DataSet data = arm.simulated ? simulate(load_scenario(kConfigs / "scenarios" / arm.file))
                                         : load_data_set(options_.data + "/" + arm.file);
      return run_measured(arm.name, data, declared, seed);
    });
  }
  void write_json() const;
  void write_table() const;
  void write_seeds() const;
  void write_corrections() const;
  void write_fronts() const;
  void write_totals() const;

  Options options_;
  std::vector<std::function<std::optional<EvolutionCase>()>> tasks_;
  std::vector<std::optional<EvolutionCase>> cases_;
};

void Bench::write_json() const {
  for (const auto& one : cases_) {
    if (!one) continue;
    const bool simulated = one->true_causes > 0;
    std::cout << nlohmann::json{{"name", one->name},
                                {"seed", one->seed},
                                {"true_causes", one->true_causes},
                                {"outside", one->outside},
                                {"without", json_of(one->without, simulated)},
                                {"validation_of_first_mm", one->without.validation_of_first_mm},
                                {"fitted_of_truth_mm", one->fitted_of_truth_mm},
                                {"accept_of_truth_mm", one->accept_of_truth_mm},
                                {"with", json_of(one->with, simulated)}}
              << '\n';
  }
}

void Bench::write_table() const {
  fmt::print("{:<22}{:>32}{:>32}\n", "", "without evolution", "with evolution");
  fmt::print("{:<22}{:>7}{:>9}{:>9}{:>7}{:>7}{:>9}{:>9}{:>7}{:>12}\n", "arm", "causes", "effects", "accept", "s",
             "causes", "effects", "accept", "s", "true named");
  for (const auto& one : cases_) {
    if (!one) continue;
    const auto side = [](const EvolutionFigures& figures) {
      return fmt::format("{:>7}{:>9}{:>9.4f}{:>7.1f}", figures.causes, figures.effects, figures.accept_mm,
                         figures.seconds);
    };
    const std::string named = one->true_causes == 0 ? ""
                                                    : fmt::format("{}/{}+{}", one->with.true_causes_named,
                                                                  one->true_causes, one->with.false_effects.size());
    const std::string name = one->true_causes == 0 ? fmt::format("{}, seed {}", one->name, one->seed) : one->name;
    fmt::print("{:<22}{}{}{:>12}\n", name, side(one->without), side(one->with), named);
  }
}

/// Medians over the seeds of every data set.
void Bench::write_seeds() const {
  fmt::print("\n{:<22}{:>7}{:>42}\n", "", "", "error with evolution over that without");
  fmt::print("{:<22}{:>7}{:>16}{:>13}{:>18}{:>13}\n", "data set", "seeds", "accept, median", "largest",
             "validation, median", "largest");
  for (const NamedArm& arm : kNamed) {
    std::vector<double> accept, validation;
    for (const auto& one : cases_) {
      if (!one || one->name != arm.name) continue;
      accept.push_back(one->with.accept_mm / one->without.accept_mm);
      validation.push_back(one->with.validation_mm / one->without.validation_mm);
    }
    if (accept.empty()) continue;
    fmt::print("{:<22}{:>7}{:>16.3f}{:>13.3f}{:>18.3f}{:>13.3f}\n", arm.name, accept.size(), quantile(accept, 0.5),
               quantile(accept, 1.0), quantile(validation, 0.5), quantile(validation, 1.0));
  }
}

/// Of models with joint corrections, the worst of all seeds.
void Bench::write_corrections() const {
  std::string rows;
  for (const auto& one : cases_) {
    if (!one || one->with.corrections.joints == 0) continue;
    const CorrectionFigures& made = one->with.corrections;
    rows += fmt::format("{:<22}{:>7}{:>13}{:>13}{:>17.3f}{:>20.2f}{:>15.2f}\n", one->name, made.joints, made.most_nodes,
                        made.shortened, made.accept_with_short_forms, 1e6 * made.least_term_rad,
                        made.most_bound_over_limit);
  }
  if (rows.empty()) return;
  fmt::print("\njoint corrections\n{:<22}{:>7}{:>13}{:>13}{:>17}{:>20}{:>15}\n{}", "arm", "joints", "most nodes",
             "short forms", "accept with them", "least term, urad", "bound / limit", rows);
}

void Bench::write_fronts() const {
  fmt::print("validation error of the front with evolution, over that\n{:<10}{:>22}{:>10}{:>34}{:>10}\n", "",
             "without it, median", "largest", "of the causes added first, median", "largest");
  for (std::size_t causes = 1; causes <= kMostOfFront; ++causes) {
    std::vector<double> pruned, first;
    for (const auto& one : cases_) {
      if (!one) continue;
      pruned.push_back(one->with.validation_with(causes) / one->without.validation_with(causes));
      first.push_back(one->with.validation_with(causes) / one->without.validation_with_first(causes));
    }
    fmt::print("{:>3} causes{:>22.3f}{:>10.3f}{:>34.3f}{:>10.3f}\n", causes, quantile(pruned, 0.5),
               quantile(pruned, 1.0), quantile(first, 0.5), quantile(first, 1.0));
  }
}

void Bench::write_totals() const {
  std::vector<double> accept, all_named_with, all_named_without, class_with, class_without, outside, truth, mistaken;
  for (const auto& one : cases_) {
    if (!one) continue;
    accept.push_back(one->with.accept_mm / one->without.accept_mm);
    if (one->true_causes == 0) continue;
    const auto is_exact = [&](const EvolutionFigures& figures) {
      return figures.true_causes_named == one->true_causes && figures.false_effects.empty() ? 1.0 : 0.0;
    };
    all_named_with.push_back(is_exact(one->with));
    all_named_without.push_back(is_exact(one->without));
    class_with.push_back(one->with.is_exact_but_for_class ? 1.0 : 0.0);
    class_without.push_back(one->without.is_exact_but_for_class ? 1.0 : 0.0);
    truth.push_back(one->accept_of_truth_mm / one->with.accept_mm);
    if (is_exact(one->with) == 0.0) mistaken.push_back(one->fitted_of_truth_mm / one->with.fitted_mm);
    if (one->outside) outside.push_back(one->with.outside_named ? 1.0 : 0.0);
  }
  const auto mean = [](const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
  };
  fmt::print("\naccept error with evolution over that without: median {:.3f}, largest {:.3f}\n", quantile(accept, 0.5),
             quantile(accept, 1.0));
  write_fronts();
  if (all_named_with.empty()) return;
  fmt::print("simulated arms of which all causes are named and nothing else: {:.3f} without, {:.3f} with\n",
             mean(all_named_without), mean(all_named_with));
  fmt::print(
      "the same where one that these poses do not tell from it (cosine .98) may stand in a cause's place: "
      "{:.3f} without, {:.3f} with\n",
      mean(class_without), mean(class_with));
  fmt::print("the true causes, fitted, leave {:.3f} times the accept error in the median, {:.3f} at most\n",
             quantile(truth, 0.5), quantile(truth, 1.0));
  if (!mistaken.empty())
    fmt::print("where not named exactly ({} arms) {:.3f} times that of all poses fitted, {:.3f} to {:.3f}\n",
               mistaken.size(), quantile(mistaken, 0.5), quantile(mistaken, 0.0), quantile(mistaken, 1.0));
  if (!outside.empty())
    fmt::print("laws outside the catalogue that are recovered, with evolution: {:.3f} of {}\n", mean(outside),
               outside.size());
}

void Bench::write() const {
  if (options_.json) return write_json();
  write_table();
  write_seeds();
  write_corrections();
  write_totals();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "What the search for explanations earns: measured robots of the shared data, two scenarios, and simulated arms "
      "with three to six undeclared causes, diagnosed with it and without it."};
  Options options;
  app.add_flag("--json", options.json, "one JSON object an arm instead of the table");
  app.add_option("--arms", options.arms, "simulated arms")->capture_default_str()->check(CLI::NonNegativeNumber);
  app.add_option("--seeds", options.seeds, "of every measured robot and scenario")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--data", options.data, "folder of the measured robots; without it only simulated arms are run");
  app.add_option("--only", options.only, "names of measured robots or scenarios, or simulated");
  app.add_option("--numbers", options.numbers, "only these of the simulated arms, from 0");
  app.add_option("--causes", options.causes, "of every simulated arm; 0: three to six, one in half of them outside")
      ->capture_default_str();
  app.add_flag("--outside", options.outside, "with --causes: one of them is outside the catalogue");
  app.add_option("--threads", options.threads, "arms at a time; figures but times do not depend on it")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 10;
  }
  Bench bench(options);
  bench.run();
  bench.write();
  return 0;
}
