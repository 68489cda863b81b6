#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "html/markup.hpp"
#include "html/sections.hpp"
#include "report/figures.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"

namespace demecal::inline html {
namespace {

/// Rows that stand in the page for readers without scripts: those with the largest errors.
constexpr std::size_t kStaticRows = 200;

std::string option(const std::string& value, const std::string& words) {
  return "<option value=\"" + escaped(value) + "\">" + escaped(words) + "</option>";
}

std::set<std::string> targets_of(const Report& report) {
  std::set<std::string> targets;
  for (const PoseErrorEntry& pose : report.pose_errors) targets.insert(pose.target);
  return targets;
}

std::string filters(const Report& report) {
  std::string targets;
  for (const std::string& target : targets_of(report)) {
    if (!target.empty()) targets += option(target, target);
  }
  return "<div class=\"controls\">\n<label>set <select id=\"pose-set\">" + option("", "all") +
         option("accept", "accept") + option("validation", "validation") + option("calibration", "calibration") +
         "</select></label>\n<label" + (targets.empty() ? " hidden" : "") + ">target <select id=\"pose-target\">" +
         option("", "all") + targets +
         "</select></label>\n<label>pose <input id=\"pose-search\" type=\"search\" size=\"8\"></label>\n"
         "<label><input id=\"pose-flagged\" type=\"checkbox\"> flagged</label>\n"
         "<label><input id=\"pose-beyond\" type=\"checkbox\"> beyond its 95 %</label>\n</div>\n";
}

std::string flag_words(const PoseErrorEntry& pose) {
  std::string text;
  for (std::string flag : pose.flags) {
    if (flag == "outside_measured") flag = "outside what was measured";
    std::ranges::replace(flag, '_', ' ');
    text += (text.empty() ? "" : ", ") + flag;
  }
  return text;
}

std::string pose_row(const PoseErrorEntry& pose) {
  const bool beyond = pose.after_mm && pose.interval95_mm && *pose.after_mm > *pose.interval95_mm;
  return "<tr><th scope=\"row\">" + escaped(pose.id) + (pose.target.empty() ? "" : " " + escaped(pose.target)) +
         "</th><td>" + escaped(pose.set) + "</td><td>" + fixed(pose.before_mm, 3) + "</td><td" +
         (beyond ? " class=\"bad\"" : "") + ">" + fixed(pose.after_mm, 3) + "</td><td>" + fixed(pose.interval95_mm, 3) +
         "</td><td class=\"words\">" + escaped(flag_words(pose)) + "</td></tr>\n";
}

std::string pose_table(const Report& report) {
  std::vector<const PoseErrorEntry*> largest;
  for (const PoseErrorEntry& pose : report.pose_errors) largest.push_back(&pose);
  std::ranges::stable_sort(largest, [](const PoseErrorEntry* one, const PoseErrorEntry* other) {
    return one->after_mm.value_or(-1.0) > other->after_mm.value_or(-1.0);
  });
  largest.resize(std::min(largest.size(), kStaticRows));
  std::string rows, heads;
  for (const PoseErrorEntry* const pose : largest) rows += pose_row(*pose);
  constexpr std::array<std::array<const char*, 2>, 6> kColumns{{{"id", "pose"},
                                                                {"set", "set"},
                                                                {"before", "before, mm"},
                                                                {"after", "after, mm"},
                                                                {"within", "95 % within, mm"},
                                                                {"flags", "flags"}}};
  for (const auto& [key, title] : kColumns) {
    heads += fmt::format("<th{}><button type=\"button\" data-key=\"{}\">{}</button></th>",
                         std::string_view(key) == "after" ? " aria-sort=\"descending\"" : "", key, title);
  }
  return "<div class=\"panel\">\n" + filters(report) + "<div class=\"wide\"><table id=\"pose-errors\">\n<thead><tr>" +
         heads + "</tr></thead>\n<tbody>\n" + rows +
         "</tbody></table></div>\n<div class=\"controls\"><button type=\"button\" id=\"pose-back\" "
         "aria-label=\"previous poses\">‹</button><span id=\"pose-pages\">" +
         fmt::format("the {} largest errors of {}", largest.size(),
                     pose_count_words(report, "", report.pose_errors.size())) +
         "</span><button type=\"button\" id=\"pose-on\" aria-label=\"next poses\">›</button></div>\n</div>\n";
}

/// Where there are several: a row for each point on the tool.
std::string target_table(const Report& report) {
  if (targets_of(report).size() < 2) return {};
  std::map<std::string, std::array<double, 4>> sums;  // count, before, after, largest
  for (const PoseErrorEntry& pose : report.pose_errors) {
    if (!pose.after_mm) continue;
    auto& [count, before, after, largest] = sums[pose.target];
    count += 1.0;
    before += pose.before_mm.value_or(0.0);
    after += *pose.after_mm;
    largest = std::max(largest, *pose.after_mm);
  }
  std::string rows;
  for (const auto& [target, figures] : sums) {
    rows += table_row(target.empty() ? "the robot's tool" : escaped(target),
                      {fixed(figures[0], 0), fixed(figures[1] / figures[0], 3), fixed(figures[2] / figures[0], 3),
                       fixed(figures[3], 3)});
  }
  return "<h3>By target</h3>\n" +
         table_panel("targets",
                     "<th>target</th><th>measurements</th><th>mean before, mm</th><th>mean after, mm</th><th>largest "
                     "after, mm</th>",
                     rows, sums.size());
}

constexpr std::string_view kView = R"html(<div class="panel" id="view">
<canvas id="view-canvas" tabindex="0" role="img" aria-label="The arm and the measured positions with their errors, exaggerated; arrow keys turn it, plus and minus zoom"></canvas>
<div class="controls">
<label>errors <input id="view-exaggeration" type="range" min="0" max="4" step="0.02" value="2"><span id="view-factor"></span></label>
<label>show <select id="view-vectors"><option value="after">after</option><option value="both">before and after</option><option value="before">before</option><option value="none">none</option></select></label>
<label>colour by error <select id="view-colour"><option value="after">after</option><option value="before">before</option></select></label>
<label>slice <select id="view-slice"><option value="">all</option><option value="0">along x</option><option value="1">along y</option><option value="2">along z</option></select></label>
<label>at <input id="view-slice-at" type="range" min="0" max="100" value="50"><span id="view-slice-place"></span></label>
<span class="buttons"><button type="button" data-view="left" aria-label="turn left">←</button><button type="button" data-view="right" aria-label="turn right">→</button><button type="button" data-view="up" aria-label="tilt up">↑</button><button type="button" data-view="down" aria-label="tilt down">↓</button><button type="button" data-view="nearer" aria-label="nearer">+</button><button type="button" data-view="further" aria-label="further">−</button><button type="button" data-view="reset">reset</button></span>
</div>
<p class="note">In the frame of the measurements. Lines lead from a position the way it was missed, grey before and blue after, exaggerated.</p>
</div>
)html";

std::string plots(const Report& report) {
  std::string choices = option("order", "order of measuring");
  for (std::size_t joint = 0; report.arm && joint < report.arm->joints.size(); ++joint)
    choices += option(fmt::format("joint{}", joint), fmt::format("joint {}", joint + 1));
  const auto any = [&report](const auto& has) { return std::ranges::any_of(report.pose_errors, has); };
  if (any([](const PoseErrorEntry& pose) { return pose.place.time_s.has_value(); })) choices += option("time", "time");
  if (any([](const PoseErrorEntry& pose) { return pose.place.temperature_celsius.has_value(); }))
    choices += option("temperature", "temperature");
  if (any([](const PoseErrorEntry& pose) { return !pose.place.position_mm.empty(); }))
    choices += option("x", "measured x") + option("y", "measured y") + option("z", "measured z");
  choices += option("before", "error before");
  return "<div class=\"panel\"><div class=\"pair\">\n<figure><canvas id=\"plot-histogram\" role=\"img\" aria-label=\""
         "How many poses have which error, before and after\"></canvas><figcaption>Poses by error: grey before, blue "
         "after.</figcaption></figure>\n<figure><canvas id=\"plot-cumulative\" role=\"img\" aria-label=\"Share of "
         "poses "
         "within an error, before and after\"></canvas><figcaption>Share of poses within an "
         "error.</figcaption></figure>"
         "\n</div>\n<figure><canvas id=\"plot-against\" role=\"img\" aria-label=\"Error after calibration against what "
         "is chosen below\"></canvas><figcaption>Error after calibration, and its median along the way; by colour: "
         "calibration, validation, accept.</figcaption></figure>\n<div class=\"controls\"><label>against <select "
         "id=\"plot-what\">" +
         choices + "</select></label></div>\n</div>\n";
}

/// Which stages the errors before and after are of.
std::string stages_note(const Report& report) {
  const std::vector<Stage> stages = error_stages(report);
  const Stage* const before = find_stage(stages, "before");
  if (before == nullptr) return "Errors before are those that the closed loop started from.";
  const Stage* const after = find_stage(stages, "after");
  if (after == nullptr)
    return "Errors before and after are the same, those of the stage “" + escaped(before->title) +
           "”: no effect was added to it.";
  return "Errors before are those of the stage “" + escaped(before->title) + "”, those after of “" +
         escaped(after->title) + "”.";
}

/// Where the radii that hold 95 % come from.
std::string radii_note(const Report& report) {
  if (!report.prediction_interval || report.prediction_interval->remark.empty()) return {};
  return "<p class=\"note\" id=\"radii\">Radii that hold 95 %: " + escaped(report.prediction_interval->remark) +
         ".</p>\n";
}

}  // namespace

std::string where_section(const Report& report) {
  if (report.pose_errors.empty()) return {};
  const std::string opening =
      "<p class=\"note\">" + stages_note(report) +
      " All of it is in pose-errors.csv, too. The table filters the pictures with it.</p>\n" + radii_note(report) +
      "<p class=\"pose-name\" id=\"pose-name\" aria-live=\"polite\">Point at a pose, or pick one in the table.</p>\n";
  return section("where", "Where the errors are",
                 opening + std::string(kView) + plots(report) + pose_table(report) + target_table(report) +
                     "<script type=\"application/json\" id=\"pose-data\">\n" + pose_data(report) +
                     "</script>\n<script>\n" + std::string(pose_core_script()) + std::string(pose_table_script()) +
                     std::string(pose_view_script()) + std::string(pose_plots_script()) + "</script>\n");
}

std::string folded(const std::string& title, const std::string& body) {
  if (body.empty()) return {};
  return "<details class=\"folded\"><summary>" + title + "</summary>\n" + body + "</details>\n";
}

namespace {

/// A bar as long as the spread, of the longest.
std::string spread_bar(const std::optional<double>& mm, double longest_mm, const char* colour) {
  constexpr double kWidest = 160.0;
  const double width = longest_mm > 0.0 ? kWidest * mm.value_or(0.0) / longest_mm : 0.0;
  return "<svg width=\"160\" height=\"8\" role=\"img\" aria-label=\"" + fixed(mm, 3) + " mm\"><rect width=\"" +
         fixed(width, 1) + "\" height=\"8\" fill=\"" + colour + "\"/></svg>";
}

std::string spreads(const Report& report) {
  double longest_mm = 0.0;
  for (const ContactEntry& one : report.contacts)
    longest_mm = std::max({longest_mm, one.before_rms_mm.value_or(0.0), one.after_rms_mm.value_or(0.0)});
  std::string rows;
  for (const ContactEntry& one : report.contacts) {
    rows += table_row(escaped(one.contact),
                      {escaped(one.set), escaped(one.kind), std::to_string(one.poses), fixed(one.registered_rms_mm, 3),
                       fixed(one.before_rms_mm, 3), fixed(one.after_rms_mm, 3),
                       spread_bar(one.before_rms_mm, longest_mm, "#b9c2cc") + "<br>" +
                           spread_bar(one.after_rms_mm, longest_mm, "#2f6fab")});
  }
  return table_panel("contacts",
                     "<th>contact</th><th>set</th><th>kind</th><th>poses</th><th>tool fitted, mm rms</th>"
                     "<th>before, mm rms</th><th>after, mm rms</th><th>before and after</th>",
                     rows, report.contacts.size());
}

std::string lengths_table(const Report& report) {
  if (report.length_errors.empty()) return {};
  std::string rows;
  for (const LengthErrorEntry& one : report.length_errors) {
    const std::string between =
        one.between.size() == 2 ? escaped(one.between.front()) + " to " + escaped(one.between.back()) : "";
    rows += table_row(between, {escaped(one.set), fixed(one.known_mm, 3), fixed(one.sigma_mm, 3),
                                fixed(one.before_mm, 3), fixed(one.error_mm, 3)});
  }
  return table_panel("lengths",
                     "<th>length between</th><th>set</th><th>known, mm</th><th>its uncertainty, mm</th>"
                     "<th>error before, mm</th><th>error after, mm</th>",
                     rows, report.length_errors.size());
}

void add_station_row(const StationEntry& station, const char* set, const SetErrors ErrorBySet::*errors,
                     std::string& rows) {
  if (!(station.after.*errors).rms_mm) return;
  rows += table_row(escaped(station.name),
                    {set, fixed((station.registered.*errors).rms_mm, 3), fixed((station.before.*errors).rms_mm, 3),
                     fixed((station.after.*errors).rms_mm, 3), fixed((station.after.*errors).max_mm, 3)});
}

}  // namespace

std::string stations_section(const Report& report) {
  if (report.stations.empty()) return {};
  std::string rows;
  for (const StationEntry& one : report.stations) {
    add_station_row(one, "calibration", &ErrorBySet::calibration, rows);
    add_station_row(one, "validation", &ErrorBySet::validation, rows);
    add_station_row(one, "accept", &ErrorBySet::accept, rows);
  }
  return section("stations", "Stations",
                 "<p class=\"note\">" + escaped(station_noise_sentence(report.stations)) + "</p>\n" +
                     table_panel("stations",
                                 "<th>station</th><th>set</th><th>tool fitted, mm rms</th><th>before, mm rms</th>"
                                 "<th>after, mm rms</th><th>after, largest, mm</th>",
                                 rows, report.stations.size()));
}

std::string contacts_section(const Report& report) {
  if (report.contacts.empty()) return {};
  std::string notes;
  for (const std::string& note : report.contact_notes) notes += "<li>" + escaped(note) + "</li>\n";
  return section("contacts-touched", "Contacts",
                 "<ul class=\"plain\">\n" + notes + "</ul>\n" + spreads(report) + lengths_table(report));
}

}  // namespace demecal::inline html
