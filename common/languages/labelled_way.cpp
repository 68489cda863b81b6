#include "languages/labelled_way.hpp"

#include <set>

namespace demecal::inline languages {

void LabelledWay::label(std::size_t at, const std::string& name) {
  labels_.push_back(at);
  flow_.label(at, name);
}

void LabelledWay::jump(std::size_t at, const std::string& name, bool always) {
  jumps_anywhere_ = jumps_anywhere_ || name.empty();
  flow_.jump(at, name, always);
}

void LabelledWay::call(std::size_t at, const std::string& name) {
  calls_[at] = name;
  flow_.call(at, name, true);
}

void LabelledWay::motion(std::size_t at) {
  if (!first_motion_) first_motion_ = at;
  last_motion_ = at;
}

void LabelledWay::note_arrivals(const ProgramText& text, Program& program) const {
  program.joints_lost_at.insert(program.joints_lost_at.end(), lost_.begin(), lost_.end());
  flow_.note_arrivals(program);
  if (jumps_anywhere_) program.joints_lost_at.insert(program.joints_lost_at.end(), labels_.begin(), labels_.end());
  std::set<std::size_t> between = flow_.calls_elsewhere();
  std::erase_if(between,
                [&](std::size_t call) { return !first_motion_ || call < *first_motion_ || call > *last_motion_; });
  if (!between.empty()) note_calls_elsewhere(text, between, calls_, program, "put what they do into this program");
}

}  // namespace demecal::inline languages
