#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>

#include "yaml/files.hpp"
#include "coordinator/commands.hpp"
#include "coordinator/result_folder.hpp"
#include "html/page.hpp"
#include "report/history.hpp"

namespace demecal {
void add_report(CLI::App& app, ExitCode& exit_code) {
  const auto folder = std::make_shared<std::string>();
  const auto force = std::make_shared<bool>(false);
  CLI::App* command = app.add_subcommand("report", "rebuild the report a person reads from a results folder");
  command->add_option("dir", *folder, "folder that calibrate or diagnose wrote")->required();
  command->add_flag("--force", *force, "overwrite a report.html that demecal did not write, or that was changed since");
  command->callback([folder, force, &exit_code] {
    const Report report = read_report(read_file(*folder + "/report.json"), "report.json");
    const std::string history = *folder + "/history.csv";  // a diagnosis leaves none
    const std::string page =
        report_html(report, read_fitness(std::filesystem::exists(history) ? read_file(history) : ""));
    make_writable(*folder, {"report.html"}, *force);
    write_result(*folder, "report.html", page);
    fmt::print("{}/report.html\n", *folder);
    exit_code = ExitCode::done;
  });
}

}  // namespace demecal
