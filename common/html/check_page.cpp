#include "html/check_page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <ranges>

#include "html/chart.hpp"
#include "html/markup.hpp"

namespace demecal::inline html {
namespace {

std::string control_chart(const std::vector<CheckRecord>& records) {
  double highest = 2.0;
  for (const CheckRecord& one : records) highest = std::max({highest, 1.1 * one.strain, 1.1 * one.strain_limit});
  LineChart chart = line_chart(0.5, static_cast<double>(records.size()) + 0.5, 0.0, highest, false);
  chart.x.whole = true;
  chart.x_title = "check";
  chart.y_title = "errors over expected ones";
  chart.label = "How far each check strayed from the model, and the limit";
  std::vector<PicturePoint> strain, limit;
  std::string dots;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double x = chart.x(static_cast<double>(i + 1));
    strain.emplace_back(x, chart.y(records[i].strain));
    limit.emplace_back(x, chart.y(records[i].strain_limit));
    dots += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"><title>{}: {}</title></circle>\n",
                        records[i].verdict == "changed" ? "added" : "pose", x, strain.back().second,
                        escaped(records[i].date), escaped(records[i].verdict));
  }
  return chart_svg(chart, polyline(limit, "noise", "exceeded by one unchanged robot in a thousand") +
                              polyline(strain, "island i0", "errors over expected ones") + dots);
}

std::string record_table(const std::vector<CheckRecord>& records) {
  std::string rows;
  for (const CheckRecord& one : std::views::reverse(records))
    rows += table_row(escaped(one.date),
                      {escaped(one.verdict), fixed(one.strain, 2), fixed(one.strain_limit, 2), fixed(one.error_mm, 3),
                       std::to_string(one.poses), escaped(one.cause), escaped(one.data)});
  return table_panel("checks",
                     "<th>date</th><th>verdict</th><th>errors over expected</th><th>limit</th><th>error, mm rms</th>"
                     "<th>poses</th><th>cause</th><th>data</th>",
                     rows, records.size());
}

}  // namespace

std::string check_history_html(const std::vector<CheckRecord>& records) {
  const CheckRecord& last = records.back();
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>Checks of " +
         escaped(last.model) + "</title>\n<style>" + std::string(page_style()) + "</style>\n</head>\n<body>\n<main>\n" +
         "<p class=\"soft\">Checks of " + escaped(last.model) + "</p>\n<h1>" +
         escaped(last.verdict == "changed" ? "The robot has changed" : "The robot is as it was") + "</h1>\n<p>" +
         escaped(last.date) + (last.cause.empty() ? "" : ": " + escaped(last.cause)) + "</p>\n" +
         section(
             "chart", "Errors over expected ones, check by check",
             "<p class=\"legend soft\">1 is what model and noise lead one to expect; dashed: one unchanged robot in a "
             "thousand is beyond it</p>\n" +
                 control_chart(records)) +
         section("record", "The record, the latest first", record_table(records)) + "</main>\n</body>\n</html>\n";
}

}  // namespace demecal::inline html
