#include "report/report_html.hpp"

#include "report/html_text.hpp"
#include "report/page_style.hpp"
#include "report/sections.hpp"

namespace demecal {
namespace {

JsonValue read_report(const std::string& text) {
  JsonValue report = JsonValue::parse(text, "report.json");
  const JsonValue version = report["demecal_report"];
  if (version.count() != 1) version.refuse("must be 1, the version of the reports that this program reads");
  return report;
}

std::string head(const JsonValue& report) {
  const std::string robot = report["robot"].text();
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         (robot.empty() ? "Robot" : escaped(robot)) + " – calibration report</title>\n<style>" +
         std::string(page_style()) + "</style>\n</head>\n";
}

}  // namespace

std::string report_html(const std::string& report_json, const std::string& history_csv) {
  const JsonValue report = read_report(report_json);
  const ErrorStages errors = error_stages(report);
  return head(report) + "<body>\n<main>\n" + opening(report, errors) + stages_section(report, errors) +
         loop_section(report) + joints_section(report, read_fitness(history_csv)) + parameters_section(report) +
         poses_section(report) + run_section(report) + "</main>\n</body>\n</html>\n";
}

}  // namespace demecal
