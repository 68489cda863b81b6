#include "output.hpp"

#include <fmt/ostream.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "summary.hpp"

namespace demecal::bench {
namespace {

using Json = nlohmann::ordered_json;

void write_bounds(std::ostream& out, const Summary& row) {
  if (row.kind == kClean || row.kind == "single") {
    const std::string name = row.kind + ": accept poses within their 95 %";
    write_bound(out, name, share(row.within, row.accept), {.at_least = 0.93, .at_most = 0.97});
  }
  if (row.kind == kClean) {
    write_bound(out, "clean: share with an effect added", share(row.cases - row.named, row.cases), {.at_most = 0.05});
  } else if (row.kind == kPair) {
    write_bound(out, "pair: share with both found", share(row.named, row.cases), {.at_least = 0.90});
  } else if (row.kind == "single") {
    write_bound(out, "single: share named, where it can be", share(row.named_eligible, row.eligible),
                {.at_least = 0.95});
    write_bound(out, "single: share named or among the rivals", share(row.in_class, row.cases), {.at_least = 0.98});
    write_bound(out, "single: error after over floor, median", quantile(row.after_over_floor, 0.5), {.at_most = 1.05});
    write_bound(out, "single: error after over floor, 95 %", quantile(row.after_over_floor, 0.95), {.at_most = 1.15});
  }
}

Json effect_json(const Effect& effect, const Robot& robot) {
  return {{"effect", words(effect, robot)}, {"values", effect.values}};
}

Json round_json(const Round& round, const Robot& robot) {
  Json rivals = Json::array();
  for (const Rival& rival : round.rivals) {
    rivals.push_back(
        {{"effect", words(rival.effect, robot)}, {"cosine", rival.cosine}, {"nats_behind", rival.nats_behind}});
  }
  return {{"verdict", to_string(round.verdict)},
          {"effect", words(round.effect, robot)},
          {"fall_nats", round.gain_nats},
          {"p_family", round.p_family},
          {"reason", round.reason},
          {"rivals", rivals}};
}

Json run_json(const LoopFigures& run, const Robot& robot) {
  Json rounds = Json::array(), effects = Json::array();
  for (const Round& round : run.rounds) rounds.push_back(round_json(round, robot));
  for (const Effect& effect : run.final_effects) effects.push_back(effect_json(effect, robot));
  return {{"named", run.score.named},
          {"eligible", run.score.eligible},
          {"in_class", run.score.in_class},
          {"false_additions", run.score.false_additions},
          {"before_over_floor", run.before_over_floor},
          {"after_over_floor", run.after_over_floor},
          {"seconds", run.seconds},
          {"effects", effects},
          {"rounds", rounds}};
}

}  // namespace

void write_table(std::ostream& out, const std::vector<Summary>& rows) {
  const char* heading = "{:<15}{:>6}{:>8}{:>9}{:>9}{:>10}{:>10}{:>14}{:>13}{:>7}{:>8}\n";
  out << fmt::format(fmt::runtime(heading), "", "", "can be", "of them", "of all", "in class", "cases w.",
                     "before/floor", "after/floor", "", "/clean");
  out << fmt::format(fmt::runtime(heading), "kind", "cases", "told", "named %", "named %", "%", "false", "median",
                     "median", "95 %", "median");
  for (const Summary& row : rows) {
    fmt::print(out, "{:<15}{:>6}{:>8}{:>9.1f}{:>9.1f}{:>10.1f}{:>10}{:>14.3f}{:>13.3f}{:>7.3f}{:>8.3f}\n", row.kind,
               row.cases, row.eligible, 100.0 * share(row.named_eligible, row.eligible),
               100.0 * share(row.named, row.cases), 100.0 * share(row.in_class, row.cases), row.with_false,
               quantile(row.before_over_floor, 0.5), quantile(row.after_over_floor, 0.5),
               quantile(row.after_over_floor, 0.95), quantile(row.after_over_clean, 0.5));
  }
  out << '\n';
  for (const Summary& row : rows) write_bounds(out, row);
}

void write_json(std::ostream& out, const std::vector<Summary>& rows) {
  for (const Summary& row : rows) {
    const bool all_told = row.kind == kPair || row.kind == kOutside;
    const Json line = {{"kind", row.kind},
                       {"cases", row.cases},
                       {"named", all_told ? share(row.named, row.cases) : share(row.named_eligible, row.eligible)},
                       {"in_class", share(row.in_class, row.cases)},
                       {"after_over_floor_median", quantile(row.after_over_floor, 0.5)},
                       {"after_over_floor_p95", quantile(row.after_over_floor, 0.95)},
                       {"after_over_clean_median", quantile(row.after_over_clean, 0.5)},
                       {"before_over_floor_median", quantile(row.before_over_floor, 0.5)},
                       {"eligible_cases", row.eligible},
                       {"named_cases", row.named},
                       {"in_class_cases", row.in_class},
                       {"cases_with_false_additions", row.with_false},
                       {"false_additions", row.false_additions},
                       {"accept_poses", row.accept},
                       {"accept_within_interval95", share(row.within, row.accept)}};
    out << line.dump() << '\n';
  }
}

void write_case(std::ostream& out, const CaseFigures& figures, const Robot& robot) {
  Json line = {{"case", figures.plan.number}, {"case_kind", figures.plan.kind}, {"robot", figures.plan.robot_file}};
  line["truth"] = Json::array();
  for (const Effect& truth : figures.truths) line["truth"].push_back(effect_json(truth, robot));
  line["clean"] = run_json(figures.clean, robot);
  if (!figures.truths.empty()) line["run"] = run_json(figures.run, robot);
  out << line.dump() << '\n';
}

}  // namespace demecal::bench
