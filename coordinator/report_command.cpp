#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "config/files.hpp"
#include "coordinator/commands.hpp"
#include "report/report_html.hpp"

namespace demecal {
void add_report(CLI::App& app, ExitCode& exit_code) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("report", "rebuild the report a person reads from a results folder");
  command->add_option("dir", *folder, "folder that calibrate or diagnose wrote")->required();
  command->callback([folder, &exit_code] {
    const std::string json = read_file(*folder + "/report.json");
    const std::string history = *folder + "/history.csv";  // a diagnosis leaves none
    write_file(*folder + "/report.html", report_html(json, std::filesystem::exists(history) ? read_file(history) : ""));
    fmt::print("{}/report.html\n", *folder);
    exit_code = ExitCode::done;
  });
}

}  // namespace demecal
