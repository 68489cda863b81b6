#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>

#include "config/files.hpp"
#include "config/model_text.hpp"
#include "coordinator/commands.hpp"
#include "errors/input_error.hpp"
#include "programs/read_program.hpp"
#include "programs/summary.hpp"

namespace demecal {
namespace {

struct ApplyRequest {
  std::string model_file, program_file, out, language;
  bool json = false, strict = false;
  double payload_kg = 0.0;
  std::optional<double> temperature_celsius;
  std::vector<double> tool_mm;
};

/// The bounds that the model states of its joint corrections.
std::vector<double> bounds_of(const CalibratedModel& model) {
  std::vector<double> bounds(model.joints.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (model.joints[i].kept && model.joints[i].bound_rad > 0.0) bounds[i] = model.joints[i].bound_rad;
  }
  return bounds;
}

CommandModel model_of(const ApplyRequest& request) {
  const CalibratedModel model = load_model(request.model_file);
  std::optional<Eigen::Vector3d> tool_m;
  if (!request.tool_mm.empty()) tool_m = 1e-3 * Eigen::Map<const Eigen::Vector3d>(request.tool_mm.data());
  const CorrectedRobot robot =
      model.declared.registration ? without_base(model.robot, model.nominal.chain) : model.robot;
  return command_model(model.nominal, robot, bounds_of(model), tool_m);
}

Language language_asked(const ApplyRequest& request, const std::string& text) {
  if (!request.language.empty()) return *language_named(request.language);
  const std::optional<Language> language = language_of(text, request.program_file);
  if (!language) {
    throw InputError({request.program_file, 0}, "",
                     "is in no language that can be told; name it with --language (val2, csv, krl, rapid, urscript)");
  }
  return *language;
}

ExitCode run(const ApplyRequest& request) {
  const CommandModel model = model_of(request);
  const std::string text = read_file(request.program_file);
  Program program = read_program(language_asked(request, text), text, request.program_file, model.nominal.chain);
  const CorrectedProgram corrected =
      correct_program(text, std::move(program), model,
                      {.payload_kg = request.payload_kg, .temperature_celsius = request.temperature_celsius});
  for (const Remark& warning : corrected.warnings) fmt::print(stderr, "{}", warning_text(corrected, warning));
  const std::size_t warnings = corrected.warnings.size();
  if (request.strict && warnings > 0) {
    fmt::print(stderr, "{}: nothing was written, because of {} warning{} and --strict\n", request.program_file,
               warnings, warnings == 1 ? "" : "s");
    return ExitCode::bad_input;
  }
  write_file(request.out, corrected.text);
  fmt::print("{}", request.json ? summary_json(corrected, model.nominal.chain)
                                : summary_table(corrected, model.nominal.chain));
  return ExitCode::done;
}

}  // namespace

void add_apply(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<ApplyRequest>();
  CLI::App* command = app.add_subcommand("apply", "correct a robot program, so that the real robot goes where it says");
  command->add_option("model", request->model_file, "MODEL.yaml")->required();
  command
      ->add_option("program", request->program_file,
                   "VAL II, CSV, KUKA KRL, ABB RAPID or URScript; poses are of the tool point in the base frame")
      ->required();
  command->add_option("--out", request->out, "the corrected program")->required();
  command->add_option("--language", request->language, "where the file's ending and words do not say it")
      ->check(CLI::IsMember({"val2", "csv", "krl", "rapid", "urscript"}, CLI::ignore_case));
  command->add_flag("--strict", request->strict, "write nothing where there is a warning (exit code 11)");
  command->add_flag("--json", request->json, "the summary as one line of JSON");
  command->add_option("--payload-kg", request->payload_kg, "what the tool carries, where the file does not say it")
      ->check(CLI::Range(0.0, 1e5));
  command
      ->add_option("--temperature-celsius", request->temperature_celsius,
                   "of the arm; without it the one that the model is made for")
      ->check(CLI::Range(-273.15, 1000.0));
  command
      ->add_option("--tool-mm", request->tool_mm,
                   "X Y Z of the program's tool point on the flange, where it is not the tool that was measured")
      ->expected(3);
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal
