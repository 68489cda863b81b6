#include "data/data_set.hpp"
#include "html/page.hpp"
#include "kinematics/chain.hpp"
#include "parameters/declared_model.hpp"
#include "planning/cell.hpp"
#include "planning/information.hpp"
#include "planning/plan.hpp"

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "html/chart.hpp"
#include "html/markup.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/units.hpp"
#include "studies/plan_report.hpp"

namespace demecal::inline html {
namespace {

std::string list_of(const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string items;
  for (const std::string& sentence : sentences) items += "<li>" + escaped(sentence) + "</li>\n";
  return "<ul class=\"plain\">\n" + items + "</ul>\n";
}

std::string plan_tile(const std::string& what, double value_mm, const std::string& below) {
  return fmt::format(
      "<div class=\"tile\"><div class=\"what\">{}</div><div class=\"value\">{:.3g} <small>mm</small></div>"
      "<div class=\"from\">{}</div></div>\n",
      what, value_mm, below);
}

std::string curve_chart(const Plan& plan) {
  if (plan.curve.size() < 2) return {};
  double lowest = 1e9, highest = 0.0;
  for (const CurvePoint& point : plan.curve) {
    lowest = std::min({lowest, millimetres(point.planned.mean_m), millimetres(point.random_rms_m)});
    highest = std::max({highest, millimetres(point.planned.p95_m), millimetres(point.random_rms_m)});
  }
  LineChart chart = line_chart(plan.curve.front().poses, plan.curve.back().poses, lowest, highest, true);
  chart.x_title = "calibration poses";
  chart.y_title = "predicted error, mm";
  chart.label = "Predicted error against the number of poses";
  std::vector<PicturePoint> mean, p95, random;
  std::string dots;
  for (const CurvePoint& point : plan.curve) {
    const double x = chart.x(point.poses);
    mean.emplace_back(x, chart.y(millimetres(point.planned.mean_m)));
    p95.emplace_back(x, chart.y(millimetres(point.planned.p95_m)));
    random.emplace_back(x, chart.y(millimetres(point.random_rms_m)));
    if (point.poses == static_cast<int>(plan.counts[0]))
      dots += fmt::format("<circle class=\"added\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/>\n", x, mean.back().second);
  }
  return chart_svg(chart, polyline(random, "noise", "as many poses at random, rms") +
                              polyline(p95, "island i1", "planned, 95 % below") +
                              polyline(mean, "island i0", "planned, mean") + dots);
}

/// The arm and the tool points, seen along one axis of the base frame.
std::string view(const Plan& plan, const Robot& robot, int across, int up, const std::string& label) {
  constexpr double kSize = 340.0, kMargin = 16.0;
  Eigen::AlignedBox3d box(Eigen::Vector3d::Zero());
  std::vector<Eigen::Vector3d> tools;
  for (const PlannedStop& stop : plan.stops) {
    tools.push_back(tool_position(robot.chain, stop.pose.joints));
    box.extend(tools.back());
  }
  const double scale = (kSize - 2.0 * kMargin) / std::max({box.sizes()[across], box.sizes()[up], 1e-3});
  const auto x = [&](const Eigen::Vector3d& point) { return kMargin + scale * (point[across] - box.min()[across]); };
  const auto y = [&](const Eigen::Vector3d& point) { return kSize - kMargin - scale * (point[up] - box.min()[up]); };
  std::string marks;
  const std::vector<double> thin(robot.chain.joints.size() + 1, 0.0);
  const std::size_t shown = std::min<std::size_t>(plan.stops.size(), 3);
  for (std::size_t i = 0; i < shown; ++i) {
    const JointVector& joints =
        plan.stops[i * (plan.stops.size() - 1) / std::max<std::size_t>(shown - 1, 1)].pose.joints;
    std::vector<PicturePoint> line;
    for (const ArmPart& part : arm_parts(robot.chain, joints, thin, {robot.chain.tool_m})) {
      if (line.empty()) line.emplace_back(x(part.body.from_m), y(part.body.from_m));
      line.emplace_back(x(part.body.to_m), y(part.body.to_m));
    }
    marks += polyline(line, i == 0 ? "curve" : "noise", "the arm at a pose");
  }
  constexpr const char* kClasses[] = {"i0", "i1", "i2"};
  for (std::size_t i = 0; i < tools.size(); ++i)
    marks +=
        fmt::format("<circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.2\"><title>{}, {}{}</title></circle>\n",
                    kClasses[static_cast<std::size_t>(plan.stops[i].set)], x(tools[i]), y(tools[i]),
                    escaped(plan.stops[i].id), to_string(plan.stops[i].set),
                    plan.stops[i].pose.socket ? ", " + plan.sockets[*plan.stops[i].pose.socket].name : "");
  return fmt::format(
      "<figure><svg class=\"chart\" viewBox=\"0 0 {0} {0}\" role=\"img\" aria-label=\"{1}\">{2}</svg>"
      "<figcaption class=\"soft\">{1}</figcaption></figure>\n",
      kSize, escaped(label), marks);
}

std::string numbers_table(const Plan& plan) {
  std::string rows;
  for (const PredictedNumber& number : plan.numbers) {
    if (number.id.kind == ParameterId::Kind::effect) continue;
    const NumberUnit unit = error_unit(number.id);
    rows += table_row(
        escaped(number.id.name()),
        {fmt::format("{:.2g} {}", number.standard_error * unit.per_inside, unit.unit),
         number.identifiable ? "<span class=\"badge yes\">yes</span>" : "<span class=\"badge no\">no</span>"});
  }
  return table_panel("numbers", "<th class=\"words\">number</th><th>standard error</th><th>identifiable</th>", rows,
                     plan.numbers.size());
}

std::string poses_table(const Plan& plan, const Robot& robot) {
  std::string rows;
  for (const PlannedStop& stop : plan.stops) {
    std::string joints;
    for (int i = 0; i < robot.chain.size(); ++i) {
      const double value = stop.pose.joints[i];
      joints += fmt::format("{}{:.3f}", i > 0 ? ", " : "",
                            (is_revolute(robot.chain, i) ? degrees(value) : millimetres(value)) + 0.0);
    }
    const Eigen::Vector3d tool_mm = 1e3 * tool_position(robot.chain, stop.pose.joints);
    std::string set(to_string(stop.set));
    if (stop.pose.socket) set += ", " + plan.sockets[*stop.pose.socket].name;
    rows += table_row(escaped(stop.id),
                      {set, joints, fmt::format("{:.0f}, {:.0f}, {:.0f}", tool_mm.x(), tool_mm.y(), tool_mm.z())});
  }
  return table_panel("poses", "<th class=\"words\">pose</th><th>set</th><th>joints, deg (mm)</th><th>tool, mm</th>",
                     rows, plan.stops.size());
}

std::string plan_head(const Plan& plan, const PlanRequest& request) {
  std::string warnings = list_of(plan.warnings);
  if (!warnings.empty()) warnings = "<div class=\"banner\">Before you measure:\n" + warnings + "</div>\n";
  return fmt::format(
      "<p class=\"soft\">Measurement plan</p>\n<h1>{}</h1>\n<p class=\"soft\">{} calibration, {} validation, {} accept "
      "poses; seed {}</p>\n{}<p class=\"headline\">Predicted mean error of the tool after calibration: <b>{:.3g} mm</b>"
      "</p>\n<div class=\"tiles\">\n{}{}{}{}{}</div>\n",
      escaped(request.robot.name), plan.counts[0], plan.counts[1], plan.counts[2], request.seed, warnings,
      millimetres(plan.predicted.mean_m), plan_tile("rms error", millimetres(plan.predicted.rms_m), "planned poses"),
      plan_tile("95 % below", millimetres(plan.predicted.p95_m), "planned poses"),
      plan_tile("rms error", millimetres(plan.random_rms_m), "as many poses at random"),
      plan_tile("rms error", millimetres(plan.bound_rms_m),
                fmt::format("lower bound for any {} poses", plan.counts[0])),
      plan_tile("measurement noise", millimetres(plan.noise_m), "per axis"));
}

}  // namespace

std::string plan_html(const Plan& plan, const PlanRequest& request) {
  const std::string legend =
      "<p class=\"legend soft\">blue: mean, orange: 95 % below, dashed: as many poses at random (rms); the dot is this "
      "plan</p>\n";
  const std::string chart = curve_chart(plan);
  std::vector<std::string> sizes;
  for (const DetectableSize& one : plan.detectable) sizes.push_back(detectable_text(one, request.robot));
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" +
         escaped(request.robot.name) + " – measurement plan</title>\n<style>" + std::string(page_style()) +
         "</style>\n</head>\n<body>\n<main>\n" + plan_head(plan, request) +
         section("curve", "Error against the number of poses", chart.empty() ? chart : legend + chart) +
         section("sockets", "Where the sockets stand",
                 list_of(socket_sentences(plan)) +
                     (plan.by_places.empty() ? std::string()
                                             : "<p class=\"soft\">As many random poses at " +
                                                   escaped(places_sentence(plan)) + " (predicted rms error).</p>\n")) +
         section("unknown", "What these poses will not tell", list_of(unidentified_sentences(plan))) +
         section("detectable", "What would be found nine times in ten", list_of(sizes)) +
         section("known", "How well each number will be known", numbers_table(plan)) +
         section("picture", "The arm and the poses",
                 "<div class=\"pair\">\n" + view(plan, request.robot, 0, 1, "from above: base x to the right, y up") +
                     view(plan, request.robot, 0, 2, "from the side: base x to the right, z up") + "</div>\n") +
         section("assumed", "What the plan rests on", list_of(plan.assumptions)) +
         section("stops", "Poses, in the order of measuring", poses_table(plan, request.robot)) +
         "</main>\n</body>\n</html>\n";
}

}  // namespace demecal::inline html
