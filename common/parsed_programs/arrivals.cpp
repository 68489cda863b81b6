#include "parsed_programs/arrivals.hpp"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace demecal::inline parsed_programs {
namespace {

/// The motions that the arm may come from; or one of them is not known.
struct Origins {
  bool unknown = false;
  std::set<std::size_t> motions{};
  bool operator==(const Origins&) const = default;
};

const Origins kUnknown{true, {}};

void join(const Origins& other, Origins& origins) {
  constexpr std::size_t kMost = 16;
  origins.motions.insert(other.motions.begin(), other.motions.end());
  if (origins.unknown || other.unknown || origins.motions.size() > kMost) origins = kUnknown;
}

class ArrivalSearch {
 public:
  explicit ArrivalSearch(const Program& program)
      : program_(program), unknown_(program.joints_lost_at.begin(), program.joints_lost_at.end()) {
    for (const Target& target : program.targets) {
      motions_.insert(target.order);
      motions_.insert(target.further_motions.begin(), target.further_motions.end());
      for (const auto& [begin, place] : target.near_motions) motions_.insert(begin);
    }
  }

  std::map<std::size_t, std::vector<std::size_t>> all() {
    if (program_.way.empty()) {
      run(0, static_cast<std::size_t>(-1), kUnknown);
      return std::move(found_);
    }
    run(0, program_.way.front().begin, kUnknown);
    follow();
    for (std::size_t i = 0; i < program_.way.size(); ++i)
      run(program_.way[i].begin, end_of(i), reached_[i] ? in_[i] : kUnknown);
    return std::move(found_);
  }

 private:
  std::size_t end_of(std::size_t stretch) const {
    return stretch + 1 < program_.way.size() ? program_.way[stretch + 1].begin : static_cast<std::size_t>(-1);
  }

  /// Notes the origins of the motions in [begin, end), before which they are `origins`; returns those behind them.
  Origins run(std::size_t begin, std::size_t end, Origins origins) {
    auto motion = motions_.lower_bound(begin);
    auto unknown = unknown_.lower_bound(begin);
    const auto is_due = [&](const auto& at, const std::set<std::size_t>& all) { return at != all.end() && *at < end; };
    while (is_due(motion, motions_) || is_due(unknown, unknown_)) {
      if (!is_due(motion, motions_) || (is_due(unknown, unknown_) && *unknown < *motion)) {
        origins = kUnknown;
        ++unknown;
        continue;
      }
      const auto elsewhere = [&](std::size_t from) { return program_.file_at(from) != program_.file_at(*motion); };
      if (std::ranges::any_of(origins.motions, elsewhere)) origins = kUnknown;
      found_[*motion].assign(origins.motions.begin(), origins.motions.end());
      origins = {false, {*motion}};
      ++motion;
    }
    return origins;
  }

  /// The origins before each stretch, from those that come behind no other.
  void follow() {
    in_.resize(program_.way.size());
    reached_.assign(program_.way.size(), false);
    std::set<std::size_t> behind_others;
    for (const Stretch& stretch : program_.way) behind_others.insert(stretch.next.begin(), stretch.next.end());
    std::deque<std::size_t> due;
    for (std::size_t i = 0; i < program_.way.size(); ++i) {
      if (behind_others.contains(i)) continue;
      in_[i] = kUnknown;
      reached_[i] = true;
      due.push_back(i);
    }
    while (!due.empty()) {
      const std::size_t at = due.front();
      due.pop_front();
      const Origins out = run(program_.way[at].begin, end_of(at), in_[at]);
      for (const std::size_t next : program_.way[at].next) {
        const Origins before = in_[next];
        join(out, in_[next]);
        if (reached_[next] && in_[next] == before) continue;
        reached_[next] = true;
        due.push_back(next);
      }
    }
  }

  const Program& program_;
  std::set<std::size_t> motions_, unknown_;
  std::vector<Origins> in_;
  std::vector<bool> reached_;
  std::map<std::size_t, std::vector<std::size_t>> found_;
};

}  // namespace

std::map<std::size_t, std::vector<std::size_t>> arrivals(const Program& program) {
  return ArrivalSearch(program).all();
}

}  // namespace demecal::inline parsed_programs
