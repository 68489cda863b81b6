#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "acceptance/certificate.hpp"
#include "acceptance/iso9283.hpp"
#include "certificate/documents.hpp"
#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "coordinator/child_process.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "coordinator/xml_signature.hpp"
#include "data/certificate_fields.hpp"
#include "data/data_set.hpp"
#include "data_check/check_data.hpp"
#include "data_files/data_set_file.hpp"
#include "data_files/stated_sets.hpp"
#include "errors/input_error.hpp"
#include "fitting/stations.hpp"
#include "kinematics/units.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "report/evaluation.hpp"
#include "report/report.hpp"
#include "terminal/report_text.hpp"
#include "trials/finding.hpp"
#include "updating/fleet_model.hpp"
#include "workflows/workflows.hpp"
#include "yaml/files.hpp"

namespace demecal {
namespace {

struct CertifyRequest {
  std::string model_file, data_file, out;
  SigningFiles signing;
  double tolerance_mm = 0.0;
  bool json = false, refit_base = false, force = false;
};

std::string certified_line(const char* words, const SetErrors& errors) {
  const auto mm = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.3f}", *value) : std::string("–");
  };
  return fmt::format("  {:<34}{:>10}{:>10}{:>10}{:>10}\n", words, mm(errors.mean_mm), mm(errors.rms_mm),
                     mm(errors.p95_mm), mm(errors.max_mm));
}

std::string certificate_summary(const Certificate& certificate) {
  std::string text = verdict_sentence(certificate) + '\n';
  if (const std::string remedy = remedy_sentence(certificate); !remedy.empty()) text += remedy + '\n';
  text += fmt::format("\n  {:<34}{:>10}{:>10}{:>10}{:>10}\n",
                      fmt::format("{} {} measurements, mm", certificate.judged_rows, certificate.judged_set), "mean",
                      "rms", "P95", "largest");
  text += certified_line("before", certificate.before) + certified_line("after", certificate.after);
  if (certificate.uncertainty && certificate.uncertainty->expanded_mm)
    text += fmt::format("  a corrected position is reached to within ± {:.3f} mm (k = 2)\n",
                        *certificate.uncertainty->expanded_mm);
  text += '\n';
  for (const Characteristic& one : certificate.characteristics) {
    const std::string value = one.value_mm ? fmt::format("{:.3f} mm", *one.value_mm) : "not measured";
    text += fmt::format("  {:<5}{:>14}  {}: {}\n", one.symbol, value, one.title, one.basis);
  }
  for (const std::string& remark : certificate.remarks) text += "  - " + remark + '\n';
  if (!certificate.missing.empty())
    text += fmt::format("  not stated, and blank on the certificate (`certificate:` in the job or data set): {}\n",
                        fmt::join(certificate.missing, "; "));
  return text;
}

/// What was written besides the two files that always are, or why nothing was.
std::string print_page(const CertifyRequest& request) {
  const std::optional<std::string> printer = find_printer();
  const std::string pdf = request.out + "/certificate.pdf";
  std::string why = "no printer of pages is installed (weasyprint or chromium)";
  if (printer) {
    if (const std::optional<std::string> bytes = printed(*printer, request.out + "/certificate.html")) {
      write_result(request.out, "certificate.pdf", *bytes);
      return pdf;
    }
    why = *printer + " could not print the page";
  }
  std::filesystem::remove(pdf);  // one of an earlier run would state other figures
  return "no certificate.pdf: " + why;
}

/// Whether the positions were computed and not measured, so that an agreement with them proves nothing: said on
/// standard error.
bool are_computed(const CheckedData& checked) {
  for (const Finding& finding : checked.check.findings) {
    if (finding.kind != FindingKind::computed_positions) continue;
    fmt::print(stderr, "{}: {} No certificate was made; --force makes it all the same.\n", checked.data.file,
               finding.sentence);
    return true;
  }
  return false;
}

/// What is wrong or odd with the data belongs on what is signed.
std::vector<std::string> notes_of_check(const DataCheck& check) {
  constexpr std::size_t kMostNamed = 10;
  std::vector<std::string> notes;
  for (const Finding& finding : check.findings) {
    if (notes.size() == kMostNamed) {
      notes.push_back(fmt::format("The data check found {} more.", check.findings.size() - kMostNamed));
      break;
    }
    notes.push_back("Of the data: " + finding.sentence);
  }
  return notes;
}

/// Days are written as YYYY-MM-DD, which sorts.
void require_past_date(const CertificateFields& fields, const std::string& file) {
  if (fields.text("date") > today())
    throw InputError({file, 0}, fields.text("date"),
                     "is after today, " + today() + ": certificate.date is the day of the measurement");
}

ExitCode run_certify(const CertifyRequest& request) {
  const bool is_signed = !request.signing.key.empty();
  const std::string signer = is_signed ? require_signer() : std::string();
  if (!std::isfinite(request.tolerance_mm)) throw ArgumentError("--tolerance must be a number of mm above 0");
  CalibratedModel model = load_model(request.model_file);
  require_one_robot(model, request.model_file, "certify");
  CheckedData checked = load_checked(request.data_file);
  const DataSet& data = checked.data;
  const CorrectedRobot seen = seen_from_stations(model.robot, model.stations, data);
  if (model.posterior) model.posterior = posterior_seen(*model.posterior, model.robot, seen, model.stations, data);
  model.robot = seen;
  require_same_arm(model.robot, data);
  if (refuses(checked, request.force, ShownFindings::all)) return ExitCode::contradiction;
  if (!request.force && are_computed(checked)) return ExitCode::contradiction;
  if (!request.force) require_alike_arm(model, data);
  if (!request.force && !request.refit_base) require_alike_tool(model, data);
  make_writable(request.out, {"certificate.html", "certificate.xml", "certificate.pdf"}, request.force);
  check_fitted(data, model.robot, model.posterior, model.interval, checked.check);
  std::vector<std::string> notes = notes_of_check(checked.check);
  const CertificateFields fields = stated_fields(load_certificate(request.data_file), model, data, notes);
  require_past_date(fields, request.data_file);
  const Certificate certificate = make_certificate(model, data,
                                                   {.fields = fields,
                                                    .tolerance_m = metres(request.tolerance_mm),
                                                    .today = today(),
                                                    .model_sha256 = sha256(read_file(request.model_file)),
                                                    .refit_base = request.refit_base,
                                                    .sets_stated = states_sets(request.data_file),
                                                    .notes = notes});
  std::string xml = dcc_xml(certificate);
  if (is_signed) xml = signed_document(signer, with_empty_signature(std::move(xml)), request.signing);
  fmt::print(stderr, "{}", to_terminal(data_check_entry(checked.check), ShownFindings::all));
  write_result(request.out, "certificate.html", certificate_html(certificate));
  write_result(request.out, "certificate.xml", xml);
  const std::string pdf = print_page(request);
  if (request.json) {
    fmt::print("{}", to_json(certificate));
  } else {
    // The verdict once more: the last line is what a list of jobs shows of a run.
    fmt::print("{}\n{}/certificate.html\n{}/certificate.xml{}\n{}\n{}\n", certificate_summary(certificate), request.out,
               request.out, is_signed ? " (signed)" : "", pdf, verdict_sentence(certificate));
  }
  return ExitCode::done;
}

}  // namespace

void add_certify(CLI::App& app, ExitCode& exit_code) {
  const auto request = std::make_shared<CertifyRequest>();
  CLI::App* command = app.add_subcommand("certify", "whether a calibrated robot keeps a tolerance, as a certificate");
  command->add_option("model", request->model_file, "MODEL.yaml")->required();
  command->add_option("data", request->data_file, "DATASET.yaml; its accept poses are judged, where it has some")
      ->required();
  command
      ->add_option("--tolerance", request->tolerance_mm,
                   "mm that 95 % of position errors are to stay within; of errors of known lengths where poses only "
                   "touch something")
      ->required()
      ->check(above_zero());
  command->add_option("--out", request->out, "folder of certificate.html, .xml and .pdf")->required();
  command->add_flag("--json", request->json, "one line of JSON");
  command->add_flag("--refit-base", request->refit_base,
                    "fit base and tool to the poses that are not judged first, where the instrument was moved");
  CLI::Option* key = command->add_option(
      "--sign", request->signing.key, "RSA key in PEM, without a passphrase, to sign certificate.xml with, by xmlsec1");
  CLI::Option* certificate =
      command->add_option("--certificate", request->signing.certificate,
                          "of --sign: its X.509 certificate in PEM, which certificate.xml then holds");
  key->needs(certificate);
  certificate->needs(key);
  add_force(*command, request->force);
  command->callback([request, &exit_code] { exit_code = run_certify(*request); });
}

}  // namespace demecal
