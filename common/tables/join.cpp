#include "tables/join.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "tables/time_stamp.hpp"

namespace demecal::inline tables {
namespace {

constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

std::string seconds_text(double value_s) {
  return number_text(std::round(1e3 * value_s) / 1e3) + " s";
}

/// Rows by the names of their points.
std::map<std::string, std::size_t> rows_by_name(const CsvTable& table, const JoinKeys& keys) {
  std::map<std::string, std::size_t> rows;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto [entry, fresh] = rows.emplace(keys.names[row], row);
    if (fresh) continue;
    throw InputError({table.file, table.rows[row].line}, keys.names[row],
                     "names the point of line " + std::to_string(table.rows[entry->second].line) +
                         " again: which of the two belongs to a measurement is not known; give points different names, "
                         "or join by order or time");
  }
  return rows;
}

/// " 'P11' stands there twice, on lines 15 and 42: is one of these the point?" Of the first such name; empty where
/// there is none.
std::string name_that_stands_twice(const CsvTable& table, const std::vector<std::string>& names) {
  std::map<std::string, std::size_t> first;
  for (std::size_t row = 0; row < names.size(); ++row) {
    const auto [entry, fresh] = first.emplace(names[row], row);
    if (fresh) continue;
    return " '" + names[row] + "' stands there twice, on lines " + std::to_string(table.rows[entry->second].line) +
           " and " + std::to_string(table.rows[row].line) + ": is one of these the point?";
  }
  return {};
}

[[noreturn]] void fail_without_partner(const CsvTable& table, std::size_t row, const std::string& name,
                                       const CsvTable& other, std::vector<std::string> names) {
  const std::string twice = name_that_stands_twice(other, names);
  throw InputError({table.file, table.rows[row].line}, name,
                   "is the name of no point of " + other.file + "; the nearest is '" + nearest_name(name, names) +
                       "'." + twice +
                       " Every row needs a partner: take this one out, or state `join: {by: name, unmatched: "
                       "leave_out}` in the data set's file (`demecal template dataset --for` these files writes it)");
}

/// Every row of another table has one of the leading table.
void require_used(const std::vector<CsvTable>& tables, const std::vector<JoinKeys>& keys, std::size_t lead,
                  std::size_t other) {
  std::map<std::string, bool> measured;
  for (const std::string& name : keys[lead].names) measured[name] = true;
  for (std::size_t row = 0; row < tables[other].rows.size(); ++row) {
    const std::string& name = keys[other].names[row];
    if (!measured.contains(name)) fail_without_partner(tables[other], row, name, tables[lead], keys[lead].names);
  }
}

/// A row that the join leaves out: "'P12' (joints.csv:13)".
std::string row_text(const CsvTable& table, const JoinKeys& keys, std::size_t row) {
  return "'" + keys.names[row] + "' (" + table.file + ":" + std::to_string(table.rows[row].line) + ")";
}

/// The rows of other tables that no row of the leading one names.
std::vector<std::string> not_measured(const std::vector<CsvTable>& tables, const std::vector<JoinKeys>& keys,
                                      std::size_t lead) {
  const std::set<std::string> measured(keys[lead].names.begin(), keys[lead].names.end());
  std::vector<std::string> rows;
  for (std::size_t other = 0; other < tables.size(); ++other)
    for (std::size_t row = 0; row < keys[other].names.size(); ++row)
      if (other != lead && !measured.contains(keys[other].names[row]))
        rows.push_back(row_text(tables[other], keys[other], row));
  return rows;
}

/// ": 'P12' (joints.csv:13), ..."; of many the first.
std::string listed_rows(const std::vector<std::string>& rows) {
  constexpr std::size_t kMost = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(rows.size(), kMost); ++i) text += (i == 0 ? ": " : ", ") + rows[i];
  return rows.size() > kMost ? text + ", ..." : text;
}

std::string no_partner_text(std::size_t rows) {
  return rows == 0 ? ""
                   : "; " + std::to_string(rows) + (rows == 1 ? " row has" : " rows have") + " no partner and " +
                         (rows == 1 ? "is" : "are") + " left out";
}

/// Rows of a table in the order of time.
std::vector<std::size_t> by_time(const JoinKeys& keys) {
  std::vector<std::size_t> order(keys.times_s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t row) { return keys.times_s[row]; });
  return order;
}

/// The place in `order` of the row nearest to the time; `order` has one at least.
std::size_t nearest_place(const JoinKeys& keys, const std::vector<std::size_t>& order, double time_s) {
  const auto after = std::ranges::lower_bound(order, time_s, {}, [&](std::size_t row) { return keys.times_s[row]; });
  if (after == order.begin()) return 0;
  const auto place = static_cast<std::size_t>(after - order.begin());
  if (after == order.end()) return place - 1;
  const bool earlier = time_s - keys.times_s[order[place - 1]] <= keys.times_s[order[place]] - time_s;
  return earlier ? place - 1 : place;
}

}  // namespace

JoinedRows join_by_name(const std::vector<CsvTable>& tables, const std::vector<JoinKeys>& keys, std::size_t lead,
                        Unmatched unmatched) {
  JoinedRows joined;
  joined.rows.assign(tables[lead].rows.size(), std::vector<std::size_t>(tables.size(), kNone));
  for (std::size_t row = 0; row < joined.rows.size(); ++row) joined.rows[row][lead] = row;
  for (std::size_t other = 0; other < tables.size(); ++other) {
    if (other == lead) continue;
    const auto rows = rows_by_name(tables[other], keys[other]);
    for (std::size_t row = 0; row < joined.rows.size(); ++row) {
      const auto found = rows.find(keys[lead].names[row]);
      if (found != rows.end()) joined.rows[row][other] = found->second;
      if (found != rows.end() || unmatched == Unmatched::leave_out) continue;
      fail_without_partner(tables[lead], row, keys[lead].names[row], tables[other], keys[other].names);
    }
    if (unmatched == Unmatched::refuse) require_used(tables, keys, lead, other);
  }
  std::vector<std::string> left_out = not_measured(tables, keys, lead);
  std::erase_if(joined.rows, [&](const auto& pose) {
    const bool alone = std::ranges::find(pose, kNone) != pose.end();
    if (alone) left_out.push_back(row_text(tables[lead], keys[lead], pose[lead]));
    return alone;
  });
  if (joined.rows.empty())
    throw InputError({tables[lead].file, 0}, "",
                     "names no point that the other files name: are they of one measurement?");
  joined.sentence = std::to_string(joined.rows.size()) + " rows joined by name" + no_partner_text(left_out.size()) +
                    listed_rows(left_out);
  return joined;
}

JoinedRows join_by_order(const std::vector<CsvTable>& tables, std::size_t lead) {
  const std::size_t count = tables[lead].rows.size();
  for (const CsvTable& table : tables) {
    if (table.rows.size() == count) continue;
    const CsvTable& longer = table.rows.size() > count ? table : tables[lead];
    const CsvTable& shorter = table.rows.size() > count ? tables[lead] : table;
    throw InputError({longer.file, longer.rows[shorter.rows.size()].line}, "",
                     "is row " + std::to_string(shorter.rows.size() + 1) + ", but " + shorter.file + " has only " +
                         std::to_string(shorter.rows.size()) +
                         ": rows joined by order must be equally many. Somewhere before, one may be missing");
  }
  JoinedRows joined;
  for (std::size_t row = 0; row < count; ++row) joined.rows.emplace_back(tables.size(), row);
  joined.sentence = std::to_string(count) + " rows joined by their order";
  return joined;
}

JoinedRows join_by_time(const std::vector<CsvTable>& tables, const std::vector<JoinKeys>& keys, std::size_t lead,
                        const JoinRule& rule, double offset_s) {
  JoinedRows joined;
  joined.rows.assign(tables[lead].rows.size(), std::vector<std::size_t>(tables.size(), kNone));
  double widest_s = 0.0;
  for (std::size_t other = 0; other < tables.size(); ++other) {
    const std::vector<std::size_t> order = by_time(keys[other]);
    for (std::size_t row = 0; row < joined.rows.size(); ++row) {
      const double time_s = keys[lead].times_s[row] - (other == lead ? 0.0 : offset_s);
      const std::size_t found = other == lead ? row : order[nearest_place(keys[other], order, time_s)];
      const double apart_s = std::abs(keys[other].times_s[found] - time_s);
      if (other == lead || apart_s <= rule.within_s) {
        joined.rows[row][other] = found;
        if (other != lead) widest_s = std::max(widest_s, apart_s);
      } else if (rule.unmatched == Unmatched::refuse) {
        throw InputError(
            {tables[lead].file, tables[lead].rows[row].line}, seconds_text(keys[lead].times_s[row]),
            "has no row of " + tables[other].file + " within " + seconds_text(rule.within_s) + ": the nearest, line " +
                std::to_string(tables[other].rows[found].line) + ", is " + seconds_text(apart_s) +
                " away. Do both clocks agree? `offset_s` under `join` says by how much they differ, `auto` "
                "finds it");
      }
    }
  }
  const std::size_t left_out =
      std::erase_if(joined.rows, [](const auto& pose) { return std::ranges::find(pose, kNone) != pose.end(); });
  if (joined.rows.empty())
    throw InputError({tables[lead].file, 0}, "",
                     "has no row within " + seconds_text(rule.within_s) + " of another file's");
  joined.sentence = std::to_string(joined.rows.size()) + " rows joined by time, at most " + seconds_text(widest_s) +
                    " apart" + no_partner_text(left_out);
  return joined;
}

WholeDays find_whole_days(const JoinKeys& lead, const JoinKeys& other, double within_s, double offset_s) {
  WholeDays found;
  const std::vector<std::size_t> order = by_time(other);
  if (order.empty()) return found;
  for (const int days : {0, -1, 1}) {
    std::size_t partners = 0;
    for (const double lead_s : lead.times_s) {
      const double time_s = lead_s - offset_s - kDay_s * days;
      const double apart_s = std::abs(other.times_s[order[nearest_place(other, order, time_s)]] - time_s);
      if (apart_s <= within_s) ++partners;
    }
    if (days == 0) found.as_given = partners;
    if (days == 0 || partners > found.partners) found = {days, partners, found.as_given};
  }
  return found;
}

}  // namespace demecal::inline tables
