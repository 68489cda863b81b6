#include <fmt/format.h>

#include <memory>
#include <string>

#include "config/files.hpp"
#include "coordinator/commands.hpp"
#include "report/report_html.hpp"

namespace demecal {
void add_report(CLI::App& app, ExitCode& exit_code) {
  const auto folder = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("report", "rebuild the report a person reads from a results folder");
  command->add_option("dir", *folder, "folder that calibrate wrote")->required();
  command->callback([folder, &exit_code] {
    const std::string json = read_file(*folder + "/report.json");
    write_file(*folder + "/report.html", report_html(json, read_file(*folder + "/history.csv")));
    fmt::print("{}/report.html\n", *folder);
    exit_code = ExitCode::done;
  });
}

}  // namespace demecal
