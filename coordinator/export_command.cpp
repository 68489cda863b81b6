#include <fmt/format.h>

#include <map>
#include <memory>
#include <string>

#include "config/files.hpp"
#include "config/model_text.hpp"
#include "coordinator/commands.hpp"
#include "errors/input_error.hpp"
#include "formulas/corrected_arm.hpp"

namespace demecal {
namespace {

struct Request {
  std::string model_file, out, target, format = "text";
};

const std::map<std::string, CodeLanguage>& languages() {
  static const std::map<std::string, CodeLanguage> all{{"text", CodeLanguage::text},
                                                       {"c", CodeLanguage::c},
                                                       {"python", CodeLanguage::python},
                                                       {"matlab", CodeLanguage::matlab}};
  return all;
}

void require_target(const Request& request, const CorrectedRobot& robot) {
  if (robot.tools.contains(request.target)) return;
  std::string known;
  for (const auto& [target, tool] : robot.tools) {
    if (!target.empty()) known += (known.empty() ? "'" : ", '") + target + '\'';
  }
  throw InputError({request.model_file, 0}, request.target,
                   known.empty() ? "is no target of this model, which has but one tool point"
                                 : "is no target of this model; it has " + known);
}

ExitCode run(const Request& request) {
  const CalibratedModel model = load_model(request.model_file);
  require_target(request, model.robot);
  Algebra algebra;
  const CorrectedArm arm = corrected_arm(algebra, model.robot, request.target);
  const std::string title =
      fmt::format("{} as calibrated by the job {} (demecal {})", model.nominal.name, model.job, model.version);
  const std::string code = code_of(listing_of(arm, model.robot, title), languages().at(request.format));
  for (const std::string& note : arm.notes) fmt::print(stderr, "{}: {}\n", request.model_file, note);
  if (request.out.empty()) {
    fmt::print("{}", code);
  } else {
    write_file(request.out, code);
  }
  return ExitCode::done;
}

}  // namespace

void add_export(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<Request>();
  CLI::App* command = app.add_subcommand("export", "the corrected forward model as formulas or code");
  command->add_option("model", request->model_file, "MODEL.yaml")->required();
  command->add_option("--format", request->format, "text, c, python or matlab")
      ->check(CLI::IsMember({"text", "c", "python", "matlab"}))
      ->capture_default_str();
  command->add_option("--out", request->out, "file to write; without it, standard output");
  command->add_option("--target", request->target, "the tool point, where the model has several");
  command->callback([request, &exit_code] { exit_code = run(*request); });
}

}  // namespace demecal
