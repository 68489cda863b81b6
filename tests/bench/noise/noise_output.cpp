#include <fmt/ostream.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "closed_loop/score.hpp"
#include "noise_figures.hpp"

namespace demecal::bench {
namespace {

using Line = nlohmann::ordered_json;

Line optional_json(const std::optional<double>& value) {
  return value ? Line(*value) : Line(nullptr);
}

Line effects_json(const std::vector<Effect>& effects, const Robot& robot) {
  Line all = Line::array();
  for (const Effect& effect : effects) all.push_back({{"effect", words(effect, robot)}, {"values", effect.values}});
  return all;
}

Line rounds_json(const std::vector<Round>& rounds, const Robot& robot) {
  Line all = Line::array();
  for (const Round& round : rounds) {
    all.push_back({{"verdict", to_string(round.verdict)},
                   {"effect", words(round.effect, robot)},
                   {"p_family", round.p_family},
                   {"fall_nats", round.gain_nats},
                   {"interval", round.interval},
                   {"reason", round.reason}});
  }
  return all;
}

Line run_line(const DiagnosisFigures& run, const Robot& robot) {
  return {
      {"refused", run.refused},
      {"failed", run.failed},
      {"first_p", run.first_p},
      {"clean_before_mm", run.clean_before_mm},
      {"clean_after_mm", run.clean_after_mm},
      {"accept", run.accept},
      {"within", run.within},
      {"seconds", run.seconds},
      {"effects", effects_json(run.effects, robot)},
      {"noise", {run.noise.joint_rad, run.noise.repeats, run.noise.order, run.noise.correlation, run.independent_m}},
      {"rounds", rounds_json(run.rounds, robot)}};
}

}  // namespace

void write_noise_table(std::ostream& out, const std::vector<NoiseFigure>& figures) {
  for (const NoiseFigure& figure : figures)
    write_bound(out, figure.condition + ": " + figure.name, figure.value, figure.bound);
}

void write_noise_json(std::ostream& out, const std::vector<NoiseFigure>& figures) {
  for (const NoiseFigure& figure : figures) {
    const Line line = {{"condition", figure.condition},
                       {"figure", figure.name},
                       {"cases", figure.cases},
                       {"value", figure.value},
                       {"at_least", optional_json(figure.bound.at_least)},
                       {"at_most", optional_json(figure.bound.at_most)},
                       {"kept", figure.bound.holds() ? Line(figure.bound.kept_by(figure.value)) : Line(nullptr)}};
    out << line.dump() << '\n';
  }
}

void write_noisy_case(std::ostream& out, const NoisyCaseFigures& figures, const Robot& robot) {
  Line line = {{"condition", figures.plan.condition.name},
               {"case", figures.plan.number},
               {"arm", figures.arm},
               {"false_effects", figures.false_effects},
               {"clean", run_line(figures.clean, robot)}};
  if (figures.bad) line["bad"] = run_line(*figures.bad, robot);
  if (figures.bad_poses_named) line["bad_poses_named"] = *figures.bad_poses_named;
  if (figures.plan.condition.question == Question::power || figures.plan.condition.question == Question::intervals)
    line["injected"] = Line::array();
  for (const InjectedEffect& injected : figures.injected) {
    line["injected"].push_back({{"share_of_limit", injected.share_of_limit},
                                {"truth", effects_json({injected.truth}, robot)[0]},
                                {"named", injected.named},
                                {"covered", injected.covered ? Line(*injected.covered) : Line(nullptr)},
                                {"run", run_line(injected.run, robot)}});
  }
  out << line.dump() << '\n';
}

}  // namespace demecal::bench
