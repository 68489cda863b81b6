#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "report/html_text.hpp"
#include "report/sections.hpp"

namespace demecal {
namespace {

std::string counted(std::uint64_t count, const std::string& set) {
  return fmt::format("{} {} pose{}", count, set, count == 1 ? "" : "s");
}

std::string subject(const JsonValue& report, const ErrorStages& errors) {
  std::string text;
  const auto add = [&text](const std::string& words) { text += (text.empty() ? "" : " · ") + words; };
  if (const std::string job = report["job"].text(); !job.empty()) add("job " + escaped(job));
  if (const std::string method = report["method"].text(); method == "direct" || method == "distal")
    add(method + " learning");
  for (std::size_t set = 0; set < errors.poses.size(); ++set) {
    if (errors.poses[set] > 0) add(counted(errors.poses[set], ErrorStages::kSets[set]));
  }
  return "<p class=\"soft\">" + text + "</p>\n";
}

std::string role_of(std::size_t set) {
  if (set == 2) return "These poses took no part in fitting or in choosing the model.";
  if (set == 1) return "These poses took no part in fitting, only in choosing what the model keeps.";
  return "The model was fitted to these same poses: no others were measured to judge it by.";
}

std::string headline(const JsonValue& report, const ErrorStages& errors, const std::optional<Judgement>& judged) {
  if (!judged && report["data_check"]["verdict"].text() == "contradiction")
    return "<p class=\"headline\">Nothing was fitted, and no model was written.</p>\n";
  if (!judged) return "<p class=\"headline\">The report holds no tool error before and after calibration.</p>\n";
  const double before = *judged->before.mean_mm, after = *judged->after.mean_mm;
  const std::string how_much = change(before, after);
  const std::string percent = how_much.starts_with('-') || how_much.starts_with('+') ? how_much.substr(1) : how_much;
  const std::string outcome = before == 0.0 ? "" : ", " + percent + (after <= before ? " less" : " more");
  const std::string set = ErrorStages::kSets[judged->set];
  const std::uint64_t poses = errors.poses[judged->set];
  const std::string measured = poses > 0 ? counted(poses, set) : set + " poses";
  return fmt::format(
      "<p class=\"headline\">Mean tool error on {}: <b>{} mm → {} mm</b>{}.</p>\n"
      "<p class=\"soft\">From the stage “{}” to “{}”. {}</p>\n",
      measured, fixed(before, 3), fixed(after, 3), outcome, judged->from, judged->to, role_of(judged->set));
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
std::string explained_tile(const JsonValue& report, const Judgement& judged) {
  const std::optional<double> floor = report["noise_floor_mm"].number();
  if (!floor || !judged.before.rms_mm || !judged.after.rms_mm) return {};
  const double noise = 3.0 * *floor * *floor;
  const double start = *judged.before.rms_mm * *judged.before.rms_mm - noise;
  const double left = *judged.after.rms_mm * *judged.after.rms_mm - noise;
  if (start <= 0.0) return {};
  return tile("explained", fixed(100.0 * (1.0 - std::max(0.0, left) / start), 1), "%", "of mean-square error");
}

std::string noise_tile(const JsonValue& report) {
  const std::optional<double> floor = report["noise_floor_mm"].number();
  if (!floor) return {};
  return tile("noise floor", fixed(floor, 3), "mm", "per axis; mean " + fixed(noise_mean_mm(report), 3));
}

std::string tiles(const JsonValue& report, const std::optional<Judgement>& judged) {
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

std::string banner(const JsonValue& report) {
  if (!report["runtime"]["interrupted"].truth().value_or(false)) return {};
  return "<p class=\"banner\">The run was interrupted: all figures are of what it had reached.</p>\n";
}

/// What the check of the data found, above all figures.
std::string data_check(const JsonValue& report) {
  const JsonValue check = report["data_check"];
  std::string lines;
  for (const JsonValue& finding : check["findings"].elements())
    lines += "<li>" + escaped(finding["sentence"].text()) + "</li>\n";
  if (lines.empty()) return lines;
  const bool contradiction = check["verdict"].text() == "contradiction";
  return std::string("<div class=\"banner\" id=\"data-check\">") +
         (contradiction ? "The data and the robot's description contradict each other:" : "Look at the data first:") +
         "\n<ul class=\"plain\">\n" + lines + "</ul></div>\n";
}

}  // namespace

std::optional<double> noise_mean_mm(const JsonValue& report) {
  const std::optional<double> floor = report["noise_floor_mm"].number();
  if (!floor) return std::nullopt;
  // The mean length of a vector with three independent normal components (Maxwell's distribution).
  return *floor * std::sqrt(8.0 / std::numbers::pi);
}

std::string opening(const JsonValue& report, const ErrorStages& errors) {
  const std::string robot = report["robot"].text();
  const std::optional<Judgement> judged = judgement(errors);
  return "<p class=\"soft\">Robot calibration</p>\n<h1>" + (robot.empty() ? "Unnamed robot" : escaped(robot)) +
         "</h1>\n" + subject(report, errors) + banner(report) + data_check(report) + headline(report, errors, judged) +
         tiles(report, judged);
}

}  // namespace demecal
