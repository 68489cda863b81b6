#include "languages/yaskawa_jbi_base.hpp"

#include <algorithm>
#include <utility>

#include "data/text.hpp"
#include "kinematics/forward.hpp"

namespace demecal::inline languages {
namespace {

/// "BC3" of BC00003, "BP3" of BP003, and of PX003, which stands for P003 and BP003.
std::string base_position_name(std::string_view word) {
  const std::string name = lower_case(word);
  const bool with_axes = name.starts_with("px");
  if (!with_axes && !name.starts_with("bc") && !name.starts_with("bp")) return "";
  const std::string robots = robot_position_name(with_axes ? name : name.substr(1));
  return robots.empty() ? "" : 'B' + robots;
}

}  // namespace

std::string robot_position_name(std::string_view word) {
  constexpr std::size_t kMostDigits = 9;
  std::string name = lower_case(word);
  if (name.starts_with("px")) name.erase(1, 1);  // the name of P with its external axes
  const bool named = name.size() > 1 && name.size() <= kMostDigits + 1 &&
                     (name.front() == 'c' || name.front() == 'p') &&
                     std::all_of(name.begin() + 1, name.end(), is_digit);
  if (!named) return "";
  const std::size_t first = std::min(name.find_first_not_of('0', 1), name.size() - 1);
  return (name.front() == 'c' ? "C" : "P") + name.substr(first);
}

JobBaseAxes::JobBaseAxes(const ReaderInput& input)
    : arm_(input.arm),
      controller_(input.controller),
      rails_(static_cast<std::size_t>(rails_of(input.arm, input.source.file(), "Yaskawa's INFORM"))) {}

void JobBaseAxes::read(const ProgramText& text, const std::string& name, std::size_t begin, std::size_t end,
                       bool pulses) {
  const std::string key = base_position_name(name);
  if (key.empty() || rails_ == 0) return;
  std::vector<Cell>& cells = positions_[key];
  cells.clear();
  if (pulses && controller_.pulses_per_deg.empty()) return;
  while (begin <= end) {
    const std::size_t rail = std::min(cells.size(), rails_ - 1), stop = std::min(text.code().find(',', begin), end);
    CellUnit unit = kMillimetres;
    if (pulses) unit = {unit.size / controller_.pulses_per_deg[rail], 0};
    std::size_t first = begin;
    const std::string_view number = text.trimmed(first, stop);
    cells.push_back(text.number(first, number.size(), unit));
    begin = stop + 1;
  }
  if (cells.size() != rails_) cells.clear();
}

std::string JobBaseAxes::named(const ProgramText& text, std::size_t begin, std::size_t end) {
  for (std::size_t at = begin; at < end; ++at) {
    if (!text.begins_word(at)) continue;
    const std::size_t word_end = std::min(text.word_end(at), end);
    if (std::string name = base_position_name(text.code().substr(at, word_end - at)); !name.empty()) return name;
    at = word_end - 1;
  }
  return "";
}

std::string JobBaseAxes::take(const std::string& key, const std::set<std::string>& named, Target& target) const {
  if (rails_ == 0) return "";
  const std::string where = ", where the rail that carries the arm is to stand";
  if (named.size() > 1) return "motions to it name different positions of the base axis" + where;
  const auto found = positions_.find(named.empty() ? 'B' + key : *named.begin());
  if (found == positions_.end() || found->second.empty())
    return "no BC that the job gives in mm, or in pulses with pulses_per_deg stated, goes with it" + where;
  target.carried = found->second;
  return "";
}

Eigen::Isometry3d JobBaseAxes::robot_frame(const Target& target) const {
  JointVector joints = JointVector::Zero(arm_.size());
  const Eigen::Vector3d start_m = forward(arm_, joints).translation();
  for (std::size_t rail = 0; rail < target.carried.size(); ++rail)
    joints[static_cast<Eigen::Index>(rail)] = target.carried[rail].inside();
  return Eigen::Isometry3d(Eigen::Translation3d(forward(arm_, joints).translation() - start_m));
}

}  // namespace demecal::inline languages
