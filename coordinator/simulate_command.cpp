#include <fmt/format.h>

#include <memory>
#include <string>

#include "yaml/files.hpp"
#include "config/scenario_file.hpp"
#include "config/data_set_file.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "simulation/simulated_robot.hpp"

namespace demecal {
namespace {

struct SimulateRequest {
  std::string scenario_file, out;
  bool force = false;
};

ExitCode run(const SimulateRequest& request) {
  const Scenario scenario = load_scenario(request.scenario_file);
  const std::vector<std::string> files{"dataset.yaml", "poses.csv", "robot.yaml", "truth.yaml"};
  make_writable(request.out, files, request.force);
  const FilesBeingWritten written(request.out, files);
  const DataSet data = simulate(scenario);
  write_data_set(data, request.out, "Measured on a simulated robot: " + scenario.name);
  write_file(request.out + "/truth.yaml", "# What is true of the data set beside this file; no command reads it\n" +
                                              read_file(request.scenario_file));
  fmt::print("{}: {} poses of {} measured; data set {}/dataset.yaml, truth in {}/truth.yaml\n", scenario.name,
             data.poses.size(), data.robot.name, request.out, request.out);
  return ExitCode::done;
}

}  // namespace

void add_simulate(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<SimulateRequest>();
  CLI::App* command =
      app.add_subcommand("simulate", "measure a simulated robot: a data set, and its truth in a file apart");
  command->add_option("scenario", request->scenario_file, "SCENARIO.yaml")->required();
  command->add_option("--out", request->out, "folder for the data set")->required();
  command->add_flag("--force", request->force,
                    "overwrite files that demecal did not write, or that were changed since");
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal
