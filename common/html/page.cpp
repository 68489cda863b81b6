#include "html/page.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "data/text.hpp"
#include "html/chart.hpp"
#include "html/markup.hpp"
#include "html/sections.hpp"
#include "report/evaluation.hpp"
#include "report/figures.hpp"

namespace demecal::inline html {
namespace {

std::string subject(const Report& report) {
  std::string text;
  const auto add = [&text](const std::string& words) { text += (text.empty() ? "" : " · ") + words; };
  if (!report.job.empty()) add("job " + escaped(report.job));
  if (report.method == "direct" || report.method == "distal") add(report.method + " learning");
  for (const ReportPoseSet& set : kPoseSets) {
    if (const std::uint64_t rows = report.poses.*set.poses; rows > 0) add(pose_count_words(report, set.name, rows));
  }
  return "<p class=\"soft\">" + text + "</p>\n";
}

std::string role_of(const std::string& set) {
  if (set == "accept") return "These poses took no part in fitting or in choosing the model.";
  if (set == "validation") return "These poses took no part in fitting, only in choosing what the model keeps.";
  return "The model was fitted to these same poses: no others were measured to judge it by.";
}

std::string headline(const Report& report, const std::optional<Improvement>& judged) {
  if (!judged && report.data_check.verdict == "contradiction")
    return "<p class=\"headline\">Nothing was fitted, and no model was written.</p>\n";
  if (!judged) return "<p class=\"headline\">The report holds no tool error before and after calibration.</p>\n";
  const double before = *judged->before.mean_mm, after = *judged->after.mean_mm;
  const std::string how_much = change(before, after);
  const std::string percent = how_much.starts_with('-') || how_much.starts_with('+') ? how_much.substr(1) : how_much;
  const std::string outcome = before == 0.0 ? "" : ", " + percent + (after <= before ? " less" : " more");
  const std::string set = judged->set.name;
  const std::uint64_t poses = report.poses.*judged->set.poses;
  const std::string measured = poses > 0 ? pose_count_words(report, set, poses) : set + " poses";
  return fmt::format(
      "<p class=\"headline\">Mean tool error on {}: <b>{} mm → {} mm</b>{}.</p>\n"
      "<p class=\"soft\">From the stage “{}” to “{}”. {}</p>\n",
      measured, fixed(before, 3), fixed(after, 3), outcome, judged->from, judged->to, role_of(set));
}

std::string tile(const std::string& what, const std::string& value, const std::string& unit, const std::string& below) {
  return fmt::format(
      "<div class=\"tile\"><div class=\"what\">{}</div><div class=\"value\">{} <small>{}</small></div>"
      "<div class=\"from\">{}</div></div>\n",
      what, value, unit, below);
}

std::string error_tile(const std::string& what, std::optional<double> before, std::optional<double> after) {
  if (!after) return {};
  return tile(what, fixed(after, 3), "mm",
              before ? fmt::format("from {} · {}", fixed(before, 3), change(before, after)) : "");
}

/// The share of the error beyond the measurement's noise that the model explains.
std::string explained_tile(const Report& report, const Improvement& judged) {
  const std::optional<double>& floor = report.noise_floor_mm;
  if (!floor || !judged.before.rms_mm || !judged.after.rms_mm) return {};
  const double noise = 3.0 * *floor * *floor;
  const double start = *judged.before.rms_mm * *judged.before.rms_mm - noise;
  const double left = *judged.after.rms_mm * *judged.after.rms_mm - noise;
  if (start <= 0.0) return {};
  return tile("explained", fixed(100.0 * (1.0 - std::max(0.0, left) / start), 1), "%", "of mean-square error");
}

std::string noise_tile(const Report& report) {
  const std::optional<double>& floor = report.noise_floor_mm;
  if (!floor) return {};
  return tile("noise floor", fixed(floor, 3), "mm", "per axis; mean " + fixed(noise_mean_mm(report), 3));
}

std::string tiles(const Report& report, const std::optional<Improvement>& judged) {
  std::string all;
  if (judged) {
    all += error_tile("mean error", judged->before.mean_mm, judged->after.mean_mm);
    all += error_tile("rms error", judged->before.rms_mm, judged->after.rms_mm);
    all += error_tile("P95 error", judged->before.p95_mm, judged->after.p95_mm);
    all += error_tile("largest error", judged->before.max_mm, judged->after.max_mm);
  }
  all += noise_tile(report);
  if (judged) all += explained_tile(report, *judged);
  return all.empty() ? all : "<div class=\"tiles\">\n" + all + "</div>\n";
}

std::string banner(const Report& report) {
  if (!report.runtime.interrupted) return {};
  return "<p class=\"banner\">The run was interrupted: all figures are of what it had reached.</p>\n";
}

/// What the check of the data found, above all figures.
std::string data_check_banner(const Report& report) {
  std::string lines;
  for (const FindingEntry& finding : report.data_check.findings)
    lines += "<li>" + escaped(finding.sentence) + "</li>\n";
  if (lines.empty()) return lines;
  const bool contradiction = report.data_check.verdict == "contradiction";
  return std::string("<div class=\"banner\" id=\"data-check\">") +
         (contradiction ? "The data and the robot's description contradict each other:" : "Look at the data first:") +
         "\n<ul class=\"plain\">\n" + lines + "</ul></div>\n";
}

/// What accept poses and the closed loop's own controls object to, where they do.
std::string doubt(const Report& report) {
  const std::string beyond = beyond_radii_sentence(coverage_of(report.pose_errors)), other = doubt_sentence(report);
  const std::string sentence = beyond + (beyond.empty() || other.empty() ? "" : " ") + other;
  return sentence.empty() ? sentence : "<p class=\"banner\" id=\"doubt\">" + escaped(sentence) + "</p>\n";
}

/// What was calibrated, the error before and after in one sentence, and the figures to judge by.
std::string opening(const Report& report) {
  const std::optional<Improvement> judged = improvement(error_stages(report));
  return "<p class=\"soft\">Robot calibration</p>\n<h1>" +
         (report.robot.empty() ? "Unnamed robot" : escaped(report.robot)) + "</h1>\n" + subject(report) +
         banner(report) + data_check_banner(report) + doubt(report) + headline(report, judged) + tiles(report, judged);
}

std::string page_head(const Report& report) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         (report.robot.empty() ? "Robot" : escaped(report.robot)) + " – calibration report</title>\n<style>" +
         std::string(page_style()) + "</style>\n</head>\n";
}

}  // namespace

std::optional<double> noise_mean_mm(const Report& report) {
  if (!report.noise_floor_mm) return std::nullopt;
  // The mean length of a vector with three independent normal components (Maxwell's distribution).
  return *report.noise_floor_mm * std::sqrt(8.0 / std::numbers::pi);
}

std::string pose_count_words(const Report& report, const std::string& set, std::uint64_t rows) {
  std::set<std::string> ids, targets;
  for (const PoseErrorEntry& pose : report.pose_errors) {
    if (!set.empty() && pose.set != set) continue;
    ids.insert(pose.id);
    targets.insert(pose.target);
  }
  const std::string what = (set.empty() ? "" : set + " ") + "pose";
  if (targets.size() < 2) return counted(rows, what);
  return counted(ids.size(), what) + fmt::format(" of {} targets", targets.size());
}

std::string report_html(const Report& report, const FitnessHistory& history) {
  return page_head(report) + "<body>\n<main>\n" + opening(report) + causes_section(report) + where_section(report) +
         todo_section(report) + stations_section(report) + contacts_section(report) + stages_section(report) +
         folded("How it was found, round by round", loop_section(report)) +
         folded("What was not found", not_found_section(report)) +
         folded("Corrections of the joints", joints_section(report, history)) +
         folded("Identified numbers", parameters_section(report)) + folded("The run", run_section(report)) +
         "</main>\n</body>\n</html>\n";
}

namespace {

std::string other_model_line(const LineChart& chart, double check, const std::string& model) {
  return fmt::format(
      "<line class=\"zero\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\"><title>from here by "
      "{3}</title></line>\n",
      chart.x(check), chart.y.from_px, chart.y.to_px, escaped(model));
}

std::string control_chart(const std::vector<CheckRecord>& records) {
  double highest = 2.0;
  for (const CheckRecord& one : records) highest = std::max({highest, 1.1 * one.strain, 1.1 * one.strain_limit});
  LineChart chart = line_chart(0.5, static_cast<double>(records.size()) + 0.5, 0.0, highest, false);
  chart.x.whole = true;
  chart.x_title = "check";
  chart.y_title = "errors over expected ones";
  chart.label = "How far each check strayed from the model, and the limit";
  std::vector<PicturePoint> strain, limit;
  std::string dots, lines;
  const auto end_lines = [&] {  // what strays from one model is no sequel to what strayed from another
    lines += polyline(limit, "noise", "exceeded by one unchanged robot in a thousand") +
             polyline(strain, "island i0", "errors over expected ones");
    strain.clear();
    limit.clear();
  };
  for (std::size_t i = 0; i < records.size(); ++i) {
    const double x = chart.x(static_cast<double>(i + 1));
    if (i > 0 && !records[i].of_model_of(records[i - 1])) {
      end_lines();
      lines += other_model_line(chart, static_cast<double>(i) + 0.5, records[i].model);
    }
    strain.emplace_back(x, chart.y(records[i].strain));
    limit.emplace_back(x, chart.y(records[i].strain_limit));
    dots += fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"><title>{}: {}</title></circle>\n",
                        records[i].verdict == "changed" ? "added" : "pose", x, strain.back().second,
                        escaped(records[i].date), escaped(records[i].verdict));
  }
  end_lines();
  return chart_svg(chart, lines + dots);
}

std::string record_table(const std::vector<CheckRecord>& records) {
  std::string rows;
  for (auto one = records.rbegin(); one != records.rend(); ++one)
    rows += table_row(escaped(one->date), {escaped(one->verdict), fixed(one->strain, 2), fixed(one->strain_limit, 2),
                                           fixed(one->error_mm, 3), std::to_string(one->poses), escaped(one->cause),
                                           escaped(one->data), escaped(one->model)});
  return table_panel("checks",
                     "<th>date</th><th>verdict</th><th>errors over expected</th><th>limit</th><th>error, mm rms</th>"
                     "<th>poses</th><th>cause</th><th>data</th><th>model</th>",
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
             "thousand is beyond it; a line upright: from there on by another model</p>\n" +
                 control_chart(records)) +
         section("record", "The record, the latest first", record_table(records)) + "</main>\n</body>\n</html>\n";
}

}  // namespace demecal::inline html
