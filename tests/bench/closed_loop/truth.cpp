#include "truth.hpp"

#include <cmath>
#include <functional>

#include "errors/check.hpp"

namespace demecal::bench {
namespace {

constexpr double kGoTogether = 0.95;

double named_value(const Effect& effect, const Robot& robot, std::string_view name) {
  const auto labels = law_of(effect).coefficients(effect, robot);
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i].name == name) return effect.value(i);
  }
  return 0.0;
}

int other_joint(const Effect& effect) {
  const auto from = effect.settings.find("from");
  return from == effect.settings.end() ? 0 : static_cast<int>(from->second);
}

using Values = std::function<double(std::string_view)>;

void inject_geometry(Scenario& scenario, int joint, const Values& coefficient) {
  const std::vector<std::pair<LinkParameter, double>> errors{{LinkParameter::d, coefficient("d_m")},
                                                             {LinkParameter::a, coefficient("a_m")},
                                                             {LinkParameter::alpha, coefficient("alpha_rad")},
                                                             {LinkParameter::beta, coefficient("beta_rad")}};
  for (const auto& [parameter, value] : errors) {
    if (value != 0.0) scenario.geometry.push_back({joint, parameter, value});
  }
}

bool inject_gears(Scenario& scenario, const Effect& truth, const Values& coefficient) {
  const int joint = truth.joint;
  if (truth.kind == "joint_offset") {
    scenario.joint_errors.push_back({joint, constant_tree(truth.value(0))});
  } else if (truth.kind == "gain") {
    scenario.gains.push_back({joint, truth.value(0)});
  } else if (truth.kind == "eccentricity") {
    scenario.eccentricities.push_back(
        {joint, static_cast<int>(truth.setting("order")), coefficient("cosine_rad"), coefficient("sine_rad")});
  } else if (truth.kind == "gear_harmonic") {
    scenario.gear_harmonics.push_back(
        {joint, truth.setting("ratio"), coefficient("cosine_rad"), coefficient("sine_rad")});
  } else if (truth.kind == "coupling") {
    scenario.couplings.push_back(
        {joint, other_joint(truth) - 1, coefficient("share"), coefficient("cosine_rad"), coefficient("sine_rad")});
  } else if (truth.kind == "backlash") {
    scenario.backlash.push_back({joint, coefficient("width_rad")});
  } else if (truth.kind == "hysteresis") {
    const double friction = coefficient("friction_rad");
    scenario.hysteresis.push_back({joint, friction, coefficient("friction_rad_per_nm") / friction});
  } else if (truth.kind == "symbolic") {
    scenario.symbolic.push_back({joint, apply(Primitive::multiply, constant_tree(truth.value(0)), truth.formula)});
  } else {
    return false;
  }
  return true;
}

bool inject_arm(Scenario& scenario, const Effect& truth, const Values& coefficient) {
  const int joint = truth.joint;
  if (truth.kind == "geometry") {
    inject_geometry(scenario, joint, coefficient);
  } else if (truth.kind == "compliance") {
    scenario.compliance.push_back({joint, coefficient("rad_per_nm")});
  } else if (truth.kind == "link_bending") {
    scenario.link_bending.push_back({joint, coefficient("x_rad_per_nm"), coefficient("y_rad_per_nm")});
  } else if (truth.kind == "axis_wobble") {
    scenario.axis_wobble.push_back({joint,
                                    static_cast<int>(truth.setting("order")),
                                    {coefficient("cosine_x_rad"), coefficient("cosine_y_rad")},
                                    {coefficient("sine_x_rad"), coefficient("sine_y_rad")}});
  } else if (truth.kind == "thermal_offset") {
    scenario.thermal_offsets.push_back({joint, coefficient("rad_per_kelvin")});
  } else if (truth.kind == "thermal_length") {
    scenario.thermal_lengths.push_back({joint, coefficient("share_per_kelvin")});
  } else {
    return false;
  }
  return true;
}

bool inject_instrument(Scenario& scenario, const Effect& truth, const Values& coefficient) {
  if (truth.kind == "tool") {
    scenario.tool_error_m = {coefficient("x_m"), coefficient("y_m"), coefficient("z_m")};
  } else if (truth.kind == "drift") {
    scenario.drift = {{coefficient("x_m_per_s"), coefficient("y_m_per_s"), coefficient("z_m_per_s")},
                      {coefficient("rx_rad_per_s"), coefficient("ry_rad_per_s"), coefficient("rz_rad_per_s")}};
  } else if (truth.kind == "sensor_scale") {
    scenario.sensor_scale.share = coefficient("share");
  } else {
    return false;
  }
  return true;
}

}  // namespace

void inject(Scenario& scenario, const Effect& truth) {
  const Values coefficient = [&](std::string_view name) { return named_value(truth, scenario.robot, name); };
  const bool known = inject_gears(scenario, truth, coefficient) || inject_arm(scenario, truth, coefficient) ||
                     inject_instrument(scenario, truth, coefficient);
  DEMECAL_CHECK(known, truth.kind);
}

bool is_truth(const Effect& found, const Effect& truth, const Robot& robot, const std::vector<ArmState>& states) {
  if (found.kind != truth.kind || found.joint != truth.joint) return false;
  if (truth.kind == "coupling" || truth.kind == "backlash") return other_joint(found) == other_joint(truth);
  if (truth.kind == "gear_harmonic") return found.setting("ratio") == truth.setting("ratio");
  if (truth.kind != "symbolic") return true;
  Effect unit = found;
  if (unit.values.empty()) unit.values.assign(law_of(found).coefficients(found, robot).size(), 1.0);
  return go_together(joint_motion(truth, robot, states), joint_motion(unit, robot, states));
}

bool go_together(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  const Eigen::VectorXd a = one.array() - one.mean(), b = other.array() - other.mean();
  return std::abs(a.dot(b)) > kGoTogether * a.norm() * b.norm();
}

std::vector<ArmState> states_of(const DataSet& data, PoseSet set) {
  std::vector<ArmState> states;
  for (const std::size_t index : poses_of(data, set)) {
    states.push_back(arm_state(data.robot, Stop(data.poses[index])));
    states.back().tool_in_sensor_m = *data.poses[index].position_m;
  }
  return states;
}

Eigen::VectorXd joint_motion(const Effect& effect, const Robot& robot, const std::vector<ArmState>& states) {
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(states.size()));
  std::vector<UnitMotion> units;
  for (std::size_t i = 0; i < states.size(); ++i) {
    units.clear();
    append_unit_motions(effect, robot, states[i], units);
    for (const UnitMotion& unit : units) {
      motion[static_cast<Eigen::Index>(i)] += unit.size * effect.value(static_cast<std::size_t>(unit.coefficient));
    }
  }
  return motion;
}

double spread(const Eigen::VectorXd& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

}  // namespace demecal::bench
