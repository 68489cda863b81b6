#include "parsed_programs/language.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <iomanip>
#include <sstream>

#include "kinematics/units.hpp"

namespace demecal::inline parsed_programs {

std::string joints_text(const Chain& arm, const JointVector& joints, std::string_view separator,
                        const std::vector<std::string>& names) {
  constexpr int kDecimals = 4;
  std::ostringstream text;
  text << std::fixed << std::setprecision(kDecimals);
  for (int i = 0; i < arm.size(); ++i) {
    if (i > 0) text << separator;
    if (!names.empty()) text << names[static_cast<std::size_t>(i)] << ' ';
    text << (is_revolute(arm, i) ? degrees(joints[i]) : millimetres(joints[i])) + 0.0;
  }
  return text.str();
}

std::string joints_text_si(const JointVector& joints, std::string_view separator) {
  constexpr int kDecimals = 8;
  std::ostringstream text;
  text << std::fixed << std::setprecision(kDecimals);
  for (Eigen::Index i = 0; i < joints.size(); ++i) text << (i > 0 ? separator : "") << joints[i];
  return text.str();
}

std::vector<std::string> numbered_names(std::string_view stem, int count) {
  std::vector<std::string> names;
  for (int i = 1; i <= count; ++i) names.push_back(std::string(stem) + std::to_string(i));
  return names;
}

bool has_six_revolute_joints(const Chain& arm) {
  constexpr int kSix = 6;
  return arm.size() == kSix && std::ranges::all_of(arm.joints, [](const Joint& joint) { return is_revolute(joint); });
}

}  // namespace demecal::inline parsed_programs
