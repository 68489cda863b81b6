// The tables of the closed loop on the report's page: each empty where the report has nothing for it.
#pragma once

#include <string>

#include "report/report.hpp"

namespace demecal {

/// A row per round: verdict, effect with its diagnosis, size, p, error before and after, rivals. Where several rounds
/// were judged together, their group stands above them.
std::string rounds_table(const Report& report);
/// A row per round with an effect: its law, its numbers with errors and intervals, and what it was judged by.
std::string evidence_table(const Report& report);
/// What to measure next, an entry per effect that has rivals.
std::string further_list(const Report& report);

/// Effects looked for and not found, with the smallest that would have shown.
std::string not_found_table(const Report& report);
/// Kinds of effects that the data cannot show, with the reason.
std::string unseen_table(const Report& report);
/// How the controls fared.
std::string decoys_table(const Report& report);

}  // namespace demecal
