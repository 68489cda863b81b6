#include "report/loop_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "kinematics/units.hpp"
#include "report/effect_class.hpp"
#include "report/effect_entry.hpp"
#include "report/json_number.hpp"

namespace demecal {
namespace {

using Json = nlohmann::ordered_json;

Json number_if_any(const std::optional<double>& value) {
  return value ? number_or_null(*value) : Json(nullptr);
}

/// One entry per element of `things`.
template <class Things, class Write>
Json list(const Things& things, Write write) {
  Json entries = Json::array();
  for (const auto& thing : things) entries.push_back(write(thing));
  return entries;
}

Json rival(const Rival& rival, const Robot& robot) {
  Json entry = to_json(effect_entry(rival.effect, robot));
  entry["cosine"] = number_or_null(rival.cosine);
  entry["nats_behind"] = number_or_null(rival.nats_behind);
  return entry;
}

Json intervals(const Round& round, const Robot& robot) {
  const std::vector<CoefficientLabel> labels = labels_of(round.effect, robot);
  Json named = Json::object();
  for (std::size_t i = 0; i < std::min(labels.size(), round.interval.size()); ++i) {
    named[labels[i].name] = {number_or_null(round.interval[i][0]), number_or_null(round.interval[i][1])};
  }
  return named;
}

Json further(const std::optional<FurtherMeasurement>& measurement) {
  if (!measurement) return nullptr;
  return {{"sentence", measurement->sentence}, {"poses", measurement->poses}};
}

Json round_entry(const Round& round, const Robot& robot) {
  Json entry{{"round", round.number},
             {"group", round.group},
             {"verdict", word_of(round.verdict)},
             {"effect", to_json(effect_entry(round.effect, robot))},
             {"diagnosis", round.diagnosis},
             {"formula", round.formula},
             {"reason", round.reason},
             {"implausible", round.implausible}};
  const std::vector<Effect> members = effect_class(round);
  entry["class"] = list(members, [](const Effect& member) {
    return Json{{"kind", member.kind}, {"joint", member.joint < 0 ? Json(nullptr) : Json(member.joint + 1)}};
  });
  entry["class_sentence"] = class_sentence(members);
  entry["rivals"] = list(round.rivals, [&robot](const Rival& one) { return rival(one, robot); });
  entry["p_structure"] = number_or_null(round.p_structure);
  entry["p_family"] = number_or_null(round.p_family);
  entry["permutations"] = round.permutations;
  entry["fall_nats"] = number_or_null(round.fall_nats);
  entry["confirmed"] = number_or_null(round.confirmed);
  entry["confirmed_lower"] = number_or_null(round.confirmed_lower);
  entry["sign_stability"] = number_or_null(round.sign_stability);
  entry["interval"] = intervals(round, robot);
  entry["validation_before_mm"] = number_or_null(round.validation_before_mm);
  entry["validation_after_mm"] = number_or_null(round.validation_after_mm);
  entry["further"] = further(round.further);
  return entry;
}

Json not_found(const NotFound& missing, const Robot& robot) {
  Json entry = to_json(effect_entry(missing.effect, robot));
  entry.erase("amplitude");  // whatever was fitted, it was not found
  entry["smallest_detectable"] = missing.testable ? number_or_null(missing.smallest_detectable) : Json(nullptr);
  entry["unit"] = missing.unit;
  entry["sentence"] = missing.testable ? "" : "not testable with these data";
  return entry;
}

/// Components of the measurements' noise: 0 where there is none of the kind.
Json noise(const LoopOutcome& loop) {
  const double independent_mm = millimetres(loop.independent_m);
  return {{"independent_mm", number_or_null(independent_mm)},
          {"estimated", loop.noise_estimated},
          {"joint_repeatability_mrad", number_or_null(1e3 * loop.noise.joint_rad)},
          {"shared_by_repeats_mm", number_or_null(independent_mm * loop.noise.repeats)},
          {"shared_in_order_mm", number_or_null(independent_mm * loop.noise.order)},
          {"correlation_in_order", number_or_null(loop.noise.correlation)}};
}

}  // namespace

void add_loop(const LoopOutcome& loop, const Robot& described, Json& report) {
  report["rounds"] = list(loop.rounds, [&](const Round& round) { return round_entry(round, described); });
  report["dropped"] = list(loop.dropped, [&](const Effect& one) { return to_json(effect_entry(one, described)); });
  report["not_found"] = list(loop.not_found, [&](const NotFound& one) { return not_found(one, described); });
  report["unseen"] = list(loop.unseen, [](const Unseen& one) {
    return Json{{"kind", one.kind}, {"reason", one.reason}};
  });
  report["decoys"] = list(loop.decoys, [](const Decoy& one) {
    return Json{{"name", one.name},
                {"best_fall_nats", number_or_null(one.best_fall_nats)},
                {"p_left", number_or_null(one.p_left)},
                {"won", one.won}};
  });
  const bool ran = loop.stopped != StopReason::not_run;
  report["stopped"] = word_of(loop.stopped);
  report["lack_of_fit_p"] = number_if_any(loop.lack_of_fit_p);
  report["explained_share"] = number_if_any(loop.explained_share);
  report["structure_left_p"] = ran ? number_or_null(loop.p_structure_left) : Json(nullptr);
  report["noise"] = ran ? noise(loop) : Json(nullptr);
  report["candidates"] = loop.candidates;
  report["permutations"] = loop.permutations;
}

}  // namespace demecal
