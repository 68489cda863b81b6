// The parts of the report's page, in its order: each the HTML of one part, empty where the report has nothing for it;
// and the scripts of the part on single poses, which stand in it one after the other as one function.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "report/figures.hpp"
#include "report/history.hpp"
#include "report/report.hpp"

namespace demecal::inline html {

/// The tool error from stage to stage, as table and bars.
std::string stages_section(const Report& report);
/// What was touched: the spread of every contact before and after, known lengths, and what contacts cannot tell.
std::string contacts_section(const Report& report);
/// The errors of each station's poses, where there are several.
std::string stations_section(const Report& report);
/// The causes of the error, and what none explains.
std::string causes_section(const Report& report);
/// How the closed loop found them, round by round.
std::string loop_section(const Report& report);
/// What the closed loop looked for and did not find, could not have found, and its controls.
std::string not_found_section(const Report& report);
/// Every joint's error, correction and evolution.
std::string joints_section(const Report& report, const FitnessHistory& history);
/// The identified numbers, and what these poses cannot identify.
std::string parameters_section(const Report& report);
/// What to measure next, and the poses that deserve a look, by name.
std::string todo_section(const Report& report);
/// Every pose with its error: a view of the arm, plots, and a table that sorts and filters; with their script.
std::string where_section(const Report& report);
/// What the script of where_section() reads: JSON without a character that HTML could take for markup.
std::string pose_data(const Report& report);
/// What only those who want to know how open; empty where `body` is. Opened in print.
std::string folded(const std::string& title, const std::string& body);
/// What the run took, and what repeats it.
std::string run_section(const Report& report);

/// "40 calibration poses", or "40 calibration poses of 3 targets": poses by their ids, each of which may have been
/// measured by several targets. `set`: a set's name, or empty for all.
std::string pose_count_words(const Report& report, const std::string& set, std::uint64_t rows);

/// The mean tool error (mm) that the measurement's noise alone makes, from the floor's standard deviation per axis.
std::optional<double> noise_mean_mm(const Report& report);

/// A row per round: verdict, effect with its diagnosis, size, p, error before and after, rivals. Where several rounds
/// were judged together, their group stands above them.
std::string rounds_table(const Report& report);
/// A row per round with an effect: its law, its numbers with errors and intervals, and what it was judged by.
std::string evidence_table(const Report& report);
/// What to measure next, an entry per effect that has rivals.
std::string next_measurements_list(const Report& report);

/// Effects looked for and not found, with the smallest that would have shown.
std::string not_found_table(const Report& report);
/// Kinds of effects that the data cannot show, with the reason.
std::string untestable_table(const Report& report);
/// How the controls fared.
std::string decoys_table(const Report& report);

/// What all parts share: the data, the choice of poses, colours; see pose_data().
std::string_view pose_core_script();
/// The table that sorts, filters and turns pages.
std::string_view pose_table_script();
/// The arm with its error vectors, turned by pointer, keys or buttons.
std::string_view pose_view_script();
/// Histogram, cumulative curve, and errors against what was measured.
std::string_view pose_plots_script();

}  // namespace demecal::inline html
