#include "score.hpp"

#include <algorithm>

#include "truth.hpp"

namespace demecal::bench {
namespace {

constexpr double kAlike = 0.9;

class Judge {
 public:
  Judge(const Robot& robot, const std::vector<ArmState>& states) : robot_(robot), states_(states) {}

  bool same(const Effect& found, const Effect& truth) const { return is_truth(found, truth, robot_, states_); }
  bool is_true(const Effect& found, const std::vector<Effect>& truths) const {
    return std::ranges::any_of(truths, [&](const Effect& truth) { return same(found, truth); });
  }
  bool is_found(const Effect& truth, const std::vector<Effect>& effects) const {
    return std::ranges::any_of(effects, [&](const Effect& effect) { return same(effect, truth); });
  }
  bool is_rival(const Effect& truth, const Round& round) const {
    return std::ranges::any_of(round.rivals, [&](const Rival& rival) { return same(rival.effect, truth); });
  }

 private:
  const Robot& robot_;
  const std::vector<ArmState>& states_;
};

/// Whether no effect of another name would explain the same; other forms of the named one are no rivals here.
bool separable(const Round& round, const Judge& judge) {
  return std::ranges::all_of(round.rivals, [&](const Rival& rival) {
    return rival.cosine < kAlike || judge.same(rival.effect, round.effect);
  });
}

}  // namespace

const Round* first_added(const LoopOutcome& outcome) {
  const auto round = std::ranges::find(outcome.rounds, Verdict::added, &Round::verdict);
  return round == outcome.rounds.end() ? nullptr : &*round;
}

Score score(const LoopOutcome& outcome, const std::vector<Effect>& final_effects, const std::vector<Effect>& truths,
            const Robot& robot, const std::vector<ArmState>& states) {
  const Judge judge(robot, states);
  Score score;
  score.false_additions = static_cast<int>(
      std::ranges::count_if(final_effects, [&](const Effect& effect) { return !judge.is_true(effect, truths); }));
  const Round* first = first_added(outcome);
  if (truths.empty()) {
    score.named = score.in_class = first == nullptr;
    score.eligible = true;
    return score;
  }
  score.eligible = first == nullptr || separable(*first, judge);
  if (truths.size() == 1) {
    score.named = first != nullptr && judge.same(first->effect, truths[0]);
    score.in_class = score.named || (first != nullptr && judge.is_rival(truths[0], *first));
    return score;
  }
  score.named = std::ranges::all_of(truths, [&](const Effect& truth) { return judge.is_found(truth, final_effects); });
  score.in_class = std::ranges::all_of(truths, [&](const Effect& truth) {
    return judge.is_found(truth, final_effects) || std::ranges::any_of(outcome.rounds, [&](const Round& round) {
             return round.verdict == Verdict::added && judge.is_rival(truth, round);
           });
  });
  return score;
}

std::string words(const Effect& effect, const Robot& robot) {
  std::string text = effect.kind;
  if (effect.joint >= 0) text += " joint " + std::to_string(effect.joint + 1);
  if (!effect.form.empty()) text += ' ' + effect.form;
  for (const char* setting : {"from", "ratio", "order"}) {
    if (!effect.settings.contains(setting)) continue;
    text += std::string(" ") + setting + ' ' + std::to_string(static_cast<int>(effect.setting(setting)));
  }
  if (!effect.formula.empty()) text += ' ' + to_string(effect.formula, symbolic_variables(robot.chain));
  return text;
}

}  // namespace demecal::bench
