// The tables of the closed loop on the report's page: each empty where the report has nothing for it.
#pragma once

#include <string>

#include "report/json_value.hpp"

namespace demecal {

/// A row per round: verdict, effect with its diagnosis, size, p, error before and after, rivals. Where several rounds
/// were judged together, their group stands above them.
std::string rounds_table(const JsonValue& report);
/// A row per round with an effect: its law, its numbers with errors and intervals, and what it was judged by.
std::string evidence_table(const JsonValue& report);
/// What to measure next, an entry per effect that has rivals.
std::string further_list(const JsonValue& report);

/// Effects looked for and not found, with the smallest that would have shown.
std::string not_found_table(const JsonValue& report);
/// Kinds of effects that the data cannot show, with the reason.
std::string unseen_table(const JsonValue& report);
/// How the controls fared.
std::string decoys_table(const JsonValue& report);

/// A panel with a table of that id; its rows scroll below its head where they are many.
std::string table_panel(const std::string& id, const std::string& head_cells, const std::string& rows,
                        std::size_t row_count);

}  // namespace demecal
