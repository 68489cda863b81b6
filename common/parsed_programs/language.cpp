#include "parsed_programs/language.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <iomanip>
#include <optional>
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

bool has_six_revolute_joints(const Chain& arm, int rails) {
  constexpr int kSix = 6;
  if (arm.size() != kSix + rails || arm.positioner > 0) return false;
  for (int joint = 0; joint < arm.size(); ++joint) {
    if (is_revolute(arm, joint) != (joint >= rails)) return false;
  }
  return true;
}

std::optional<CarriedStop> carried_stop(const Chain& arm, const JointVector& joints) {
  constexpr int kSix = 6;
  const int rails = arm.size() - kSix;
  if (rails < 0 || !has_six_revolute_joints(arm, rails)) return std::nullopt;
  CarriedStop stop{arm, joints.head(rails), joints.tail(kSix)};
  stop.arm.joints.erase(stop.arm.joints.begin(), stop.arm.joints.begin() + rails);
  return stop;
}

std::vector<std::string> rail_texts(const CarriedStop& stop) {
  constexpr int kDecimals = 4;
  std::vector<std::string> texts;
  for (const double place_m : stop.rails) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(kDecimals) << millimetres(place_m) + 0.0;
    texts.push_back(text.str());
  }
  return texts;
}

}  // namespace demecal::inline parsed_programs
