
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "calibration/calibration.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "coordinator/commands.hpp"
#include "data/data_set.hpp"
#include "errors/input_error.hpp"
#include "terminal/fleet_text.hpp"
#include "updating/fleet_model.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

struct FleetRequest {
  std::vector<std::string> model_files;
  std::string out;
  bool force = false;
};

/// A fleet's file may be written again; nothing else is overwritten unasked.
void require_fleet_file(const FleetRequest& request) {
  if (request.force || !std::filesystem::exists(request.out)) return;
  try {
    if (load_model(request.out).fleet) return;
  } catch (const InputError&) {
    // No model at all: said below.
  }
  throw ArgumentError("--out: " + request.out +
                      " is there already, and not a fleet's file; name another, or give --force to overwrite it");
}

ExitCode run_fleet(const FleetRequest& request) {
  std::vector<NamedModel> models;
  for (const std::string& file : request.model_files) models.push_back({file, load_model(file)});
  require_fleet_file(request);
  CalibratedModel fleet = fleet_model(models);
  std::string hashes;
  for (const FleetMember& one : fleet.fleet->robots) hashes += one.data_sha256 + '\n';
  fleet.data_sha256 = sha256(hashes);
  fleet.version = DEMECAL_VERSION;
  write_file(request.out, model_text(fleet));
  fmt::print("{}: {} robots of the type {}\n{}", request.out, models.size(), fleet.nominal.name, fleet_table(fleet));
  fmt::print("A further robot of the type begins with it: demecal calibrate JOB.yaml --prior {} --out DIR\n",
             request.out);
  return ExitCode::done;
}

}  // namespace

void say_if_fleet(const CalibratedModel& model, const std::string& file) {
  if (!model.fleet) return;
  fmt::print(stderr,
             "{}: the mean of {} robots of the type {}, and no calibrated robot: each of them differs from it (--prior "
             "makes a model of one from a few poses)\n",
             file, model.fleet->robots.size(), model.nominal.name);
}

void add_fleet(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<FleetRequest>();
  CLI::App* command =
      app.add_subcommand("fleet", "the mean and spread of several robots of one type, to begin a further one with");
  command->add_option("models", request->model_files, "MODEL.yaml of every robot, two at least, better five")
      ->required();
  command->add_option("--out", request->out, "fleet.yaml, for calibrate --prior and diagnose --prior")->required();
  command->add_flag("--force", request->force, "overwrite a file that is not a fleet's");
  command->callback([request, &exit_code] { exit_code = run_fleet(*request); });
}

}  // namespace demecal
