#include "parsed_programs/payload_flow.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace demecal::inline parsed_programs {
namespace {

/// What is carried on all ways that lead somewhere: not reached; a payload; or not told.
struct Carried {
  bool reached = false;
  std::optional<double> kg{};

  bool operator==(const Carried&) const = default;
};

const Carried kNotTold{true, std::nullopt};

bool merge_carried(const Carried& other, Carried& carried) {
  const Carried before = carried;
  if (!carried.reached) {
    carried = other;
  } else if (other.reached && other.kg != carried.kg) {
    carried = kNotTold;
  }
  return carried != before;
}

class PayloadSearch {
 public:
  explicit PayloadSearch(Program& program) : program_(program), way_(program.way) {
    if (way_.empty() || way_.front().begin > 0) {  // what stands before all routines is followed by nothing
      way_.insert(way_.begin(), Stretch{});
      for (std::size_t i = 1; i < way_.size(); ++i) {
        for (std::size_t& next : way_[i].next) ++next;
        for (std::size_t& call : way_[i].calls) ++call;
      }
    }
    for (const PayloadStatement& one : program.payload_statements)
      one.alone_until > 0 ? alone_.push_back(one) : static_cast<void>(statements_[one.begin] = one.kg);
    for (const Target& target : program.targets) {
      motions_.insert(target.order);
      motions_.insert(target.further_motions.begin(), target.further_motions.end());
      for (const auto& [begin, place] : target.near_motions) motions_.insert(begin);
    }
  }

  void run() {
    number_routines();
    find_setting_routines();
    in_.resize(way_.size());
    std::set<std::size_t> led_to;
    for (const Stretch& stretch : way_) {
      led_to.insert(stretch.next.begin(), stretch.next.end());
      led_to.insert(stretch.calls.begin(), stretch.calls.end());
    }
    for (std::size_t i = 0; i < way_.size(); ++i) {
      if (!led_to.contains(i)) enter(i, kNotTold);
    }
    while (!due_.empty()) {
      const std::size_t at = due_.front();
      due_.pop_front();
      visit(at);
    }
    for (std::size_t i = 0; i < way_.size(); ++i) walk(i, behind_calls(i), true);
    for (Target& target : program_.targets) state(target);
  }

 private:
  /// Stretches that lead to each other are of one routine.
  void number_routines() {
    routine_.resize(way_.size());
    for (std::size_t i = 0; i < way_.size(); ++i) routine_[i] = i;
    bool changed = true;
    while (changed) {
      changed = false;
      for (std::size_t i = 0; i < way_.size(); ++i) {
        for (const std::size_t next : way_[i].next) {
          const std::size_t least = std::min(routine_[i], routine_[next]);
          changed = changed || routine_[i] != routine_[next];
          routine_[i] = routine_[next] = least;
        }
      }
    }
  }

  /// Those in which a statement stands, and those that call such.
  void find_setting_routines() {
    for (const auto& [begin, kg] : statements_) {
      const auto next = std::ranges::upper_bound(way_, begin, {}, &Stretch::begin);
      setting_.insert(routine_[static_cast<std::size_t>(next - way_.begin()) - 1]);
    }
    std::size_t before = 0;
    while (setting_.size() > before) {
      before = setting_.size();
      for (std::size_t i = 0; i < way_.size(); ++i) {
        for (const std::size_t call : way_[i].calls)
          if (setting_.contains(routine_[call])) setting_.insert(routine_[i]);
      }
    }
  }

  void enter(std::size_t stretch, const Carried& carried) {
    if (merge_carried(carried, in_[stretch])) due_.push_back(stretch);
  }

  std::size_t end_of(std::size_t stretch) const {
    return stretch + 1 < way_.size() ? way_[stretch + 1].begin : static_cast<std::size_t>(-1);
  }

  /// What is carried once the routines that the stretch calls have ended; unreached where none of them ever does.
  Carried behind_calls(std::size_t stretch) const {
    if (way_[stretch].calls.empty() || !in_[stretch].reached) return in_[stretch];
    Carried carried;
    for (const std::size_t call : way_[stretch].calls) {
      const auto left = exits_.find(routine_[call]);
      if (left == exits_.end()) continue;
      merge_carried(setting_.contains(routine_[call]) ? left->second : in_[stretch], carried);
    }
    return carried;
  }

  void visit(std::size_t at) {
    for (const std::size_t call : way_[at].calls) {
      callers_[routine_[call]].insert(at);
      enter(call, in_[at]);
    }
    const Carried out = walk(at, behind_calls(at), false);
    if (!out.reached) return;
    for (const std::size_t next : way_[at].next) enter(next, out);
    if (!way_[at].leaves || !merge_carried(out, exits_[routine_[at]])) return;
    const std::set<std::size_t>& callers = callers_[routine_[at]];
    due_.insert(due_.end(), callers.begin(), callers.end());
  }

  /// What is carried behind the stretch; notes what is carried at its motions.
  Carried walk(std::size_t stretch, Carried carried, bool notes) {
    const std::size_t end = end_of(stretch);
    auto statement = statements_.lower_bound(way_[stretch].begin);
    auto motion = notes ? motions_.lower_bound(way_[stretch].begin) : motions_.end();
    const auto take_statements = [&](std::size_t before) {
      for (; statement != statements_.end() && statement->first < before; ++statement)
        if (carried.reached) carried.kg = statement->second;
    };
    for (; motion != motions_.end() && *motion < end; ++motion) {
      take_statements(*motion);
      merge_carried(at_motion(*motion, carried), at_motions_[*motion]);
    }
    take_statements(end);
    return carried;
  }

  /// What counts at the motion, `carried` leading there: the innermost statement that holds for it alone.
  Carried at_motion(std::size_t motion, const Carried& carried) const {
    const auto holds = [&](const PayloadStatement& one) { return one.begin <= motion && motion < one.alone_until; };
    const auto alone = std::ranges::find_if(alone_.rbegin(), alone_.rend(), holds);
    if (alone != alone_.rend()) return {true, alone->kg};
    return carried.reached ? carried : kNotTold;
  }

  void state(Target& target) const {
    if (target.payload_kg) return;
    Carried all;
    const auto take = [&](std::size_t motion) {
      const auto found = at_motions_.find(motion);
      merge_carried(found == at_motions_.end() ? kNotTold : found->second, all);
    };
    take(target.order);
    for (const std::size_t motion : target.further_motions) take(motion);
    for (const auto& [begin, place] : target.near_motions) take(begin);
    target.payload_kg = all.kg;
  }

  Program& program_;
  std::vector<Stretch> way_;
  std::map<std::size_t, std::optional<double>> statements_;  ///< by their bytes
  std::vector<PayloadStatement> alone_;                      ///< those that hold for some motions alone
  std::set<std::size_t> motions_;
  std::vector<std::size_t> routine_;  ///< of each stretch
  std::set<std::size_t> setting_;     ///< routines behind which another payload may be carried
  std::vector<Carried> in_;
  std::deque<std::size_t> due_;
  std::map<std::size_t, Carried> exits_;  ///< of each routine
  std::map<std::size_t, std::set<std::size_t>> callers_;
  std::map<std::size_t, Carried> at_motions_;
};

}  // namespace

Program with_followed_payloads(Program program) {
  if (!program.payload_statements.empty()) PayloadSearch(program).run();
  return program;
}

}  // namespace demecal::inline parsed_programs
