#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "closed_calibration/calibrated_model.hpp"
#include "config/model_file.hpp"
#include "data/data_set.hpp"
#include "data/text.hpp"
#include "errors/input_error.hpp"
#include "expression/bound.hpp"
#include "expression/text.hpp"
#include "fitting/fit.hpp"
#include "kinematics/angles.hpp"
#include "kinematics/chain.hpp"
#include "kinematics/units.hpp"
#include "parameters/declared_model.hpp"
#include "parameters/posterior.hpp"
#include "prediction/corrected_robot.hpp"
#include "yaml/yaml_node.hpp"
#include "yaml/yaml_text.hpp"

namespace demecal::inline config {
namespace {

using Kind = ParameterId::Kind;

/// Six digits: a covariance deserves no more.
std::string short_number(double value) {
  constexpr int kDigits = 6;
  std::array<char, 32> buffer;
  const auto end =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, kDigits);
  return {buffer.data(), end.ptr};
}

std::string range_text(const Joint& joint, const Interval& range) {
  const double ends[] = {range.lower, range.upper};
  return std::string(is_revolute(joint) ? "range_rad: " : "range_m: ") + yaml_numbers(ends);
}

Interval read_ends(const YamlNode& node) {
  const std::vector<double> ends = node.numbers();
  if (ends.size() != 2 || !(ends[0] <= ends[1])) node.fail("must be two numbers, the lower first");
  return {ends[0], ends[1]};
}

Interval read_range(const YamlNode& node, const Joint& joint) {
  return read_ends(node.at(is_revolute(joint) ? "range_rad" : "range_m"));
}

std::string term_text(const CorrectionTerm& term, const Chain& chain) {
  std::string text = "{joint: " + std::to_string(term.joint + 1) +
                     ", expression: " + yaml_text(to_string(term.shape.formula())) + ", " +
                     range_text(chain.joints[static_cast<std::size_t>(term.joint)], term.shape.range_rad());
  if (term.shape.branch().wraps) text += ", branch_centre_rad: " + number_text(term.shape.branch().centre_rad);
  return text + "}";
}

CorrectionTerm read_term(const YamlNode& node, const Chain& chain) {
  node.with_keys({"joint", "expression", "range_rad", "range_m", "branch_centre_rad"});
  const auto joint = static_cast<std::size_t>(joint_at(node, "joint", chain));
  AngleBranch branch;
  if (const YamlNode* centre = node.find("branch_centre_rad")) branch = {true, centre->number()};
  const YamlNode& expression = node.at("expression");
  try {
    return {static_cast<int>(joint), {parse(expression.text()), branch, read_range(node, chain.joints[joint])}};
  } catch (const InputError& error) {
    expression.fail(error.what());
  }
}

/// Every number that a model of this robot can have been fitted with.
std::vector<ParameterId> possible_parameters(const CorrectedRobot& robot) {
  std::vector<ParameterId> ids;
  for (int joint = 0; joint < robot.chain.size(); ++joint) {
    for (int link = 0; link < kLinkParameters; ++link)
      ids.push_back({Kind::link, joint, static_cast<LinkParameter>(link), {}});
  }
  for (const Kind kind : {Kind::base_translation, Kind::base_rotation}) {
    for (int axis = 0; axis < 3; ++axis) ids.push_back({kind, axis, LinkParameter::theta, {}});
  }
  for (const auto& [target, tool] : robot.tools) {
    for (const Kind kind : {Kind::tool_translation, Kind::tool_rotation}) {
      for (int axis = 0; axis < 3; ++axis) ids.push_back({kind, axis, LinkParameter::theta, target});
    }
  }
  for (ParameterId& id : effect_parameters(robot)) ids.push_back(std::move(id));
  return ids;
}

/// The first of the possible numbers of that name; it is taken out, since two effects may have one name.
ParameterId take_parameter(const YamlNode& name, std::vector<ParameterId>& possible) {
  for (auto id = possible.begin(); id != possible.end(); ++id) {
    if (id->name() != name.text()) continue;
    ParameterId taken = std::move(*id);
    possible.erase(id);
    return taken;
  }
  name.fail("names no number of this model");
}

void read_pose_counts(const YamlNode& entry, CalibratedModel& model) {
  entry.with_keys({"joint", "per_5_deg"});
  const int joint = joint_at(entry, "joint", model.nominal.chain);
  if (!is_revolute(model.nominal.chain, joint)) entry.fail("joint", "must be revolute");
  std::vector<int>& counts = model.pose_counts[joint];
  if (!counts.empty()) entry.fail("joint", "has its counts already");
  for (const YamlNode& count : entry.at("per_5_deg").list(kTurnSteps))
    counts.push_back(static_cast<int>(count.whole_number(0, 100'000'000)));
}

/// In hexadecimal digits, and in quotes: some look like numbers.
std::string mark_text(std::uint64_t mark) {
  std::array<char, 16> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), mark, 16).ptr;
  return '"' + std::string(digits.data(), end) + '"';
}

std::uint64_t read_mark(const YamlNode& node) {
  const std::string text = node.text();
  std::uint64_t mark = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), mark, 16);
  if (error != std::errc() || end != text.data() + text.size()) node.fail("must be hexadecimal digits, 16 at most");
  return mark;
}

}  // namespace

std::string posterior_text(const CalibratedModel& model) {
  std::ostringstream text;
  if (const auto& carried = model.robot.payloads_kg) {
    const double ends[] = {carried->lower, carried->upper};
    text << "measured_payload_kg: " << yaml_numbers(ends) << '\n';
  }
  if (const auto& warmth = model.robot.temperatures_celsius) {
    const double ends[] = {warmth->lower, warmth->upper};
    text << "measured_temperature_celsius: " << yaml_numbers(ends) << '\n';
  }
  if (!model.measured.empty()) text << "measured_ranges:\n";
  for (std::size_t joint = 0; joint < model.measured.size(); ++joint) {
    text << "  - {joint: " << joint + 1 << ", " << range_text(model.nominal.chain.joints[joint], model.measured[joint])
         << "}\n";
  }
  if (!model.measured_gaps.empty()) text << "measured_gaps:\n";
  for (const auto& [joint, gaps] : model.measured_gaps) {
    for (const Interval& gap : gaps)
      text << "  - {joint: " << joint + 1 << ", "
           << range_text(model.nominal.chain.joints[static_cast<std::size_t>(joint)], gap) << "}\n";
  }
  if (!model.pose_counts.empty()) text << "pose_counts:\n";
  for (const auto& [joint, counts] : model.pose_counts) {
    std::vector<std::string> numbers;
    for (const int count : counts) numbers.push_back(std::to_string(count));
    text << "  - {joint: " << joint + 1 << ", per_5_deg: " << yaml_list(numbers) << "}\n";
  }
  if (!model.pose_marks.empty()) {
    std::vector<std::string> marks;
    for (const std::uint64_t mark : model.pose_marks) marks.push_back(mark_text(mark));
    text << "pose_marks: " << yaml_list(marks) << '\n';
  }
  if (!model.posterior) return text.str();
  const Posterior& posterior = *model.posterior;
  std::vector<std::string> names, terms;
  for (const ParameterId& id : posterior.ids) names.push_back(yaml_text(id.name()));
  text << "# Covariance of these numbers, then of the terms: triangle * transposed triangle, in m and rad (SI)\n"
       << "posterior:\n  numbers: " << yaml_list(names) << "\n  terms:" << (posterior.terms.empty() ? " []\n" : "\n");
  for (const CorrectionTerm& term : posterior.terms) text << "    - " << term_text(term, model.nominal.chain) << '\n';
  text << "  triangle:" << (posterior.factor.rows() == 0 ? " []\n" : "\n");
  for (Eigen::Index row = 0; row < posterior.factor.rows(); ++row) {
    std::vector<std::string> numbers;
    for (Eigen::Index column = 0; column <= row; ++column)
      numbers.push_back(short_number(posterior.factor(row, column)));
    text << "    - " << yaml_list(numbers) << '\n';
  }
  return text.str();
}

void read_posterior(const YamlNode& file, CalibratedModel& model) {
  if (const YamlNode* carried = file.find("measured_payload_kg")) model.robot.payloads_kg = read_ends(*carried);
  if (const YamlNode* warmth = file.find("measured_temperature_celsius"))
    model.robot.temperatures_celsius = read_ends(*warmth);
  if (const YamlNode* ranges = file.find("measured_ranges")) {
    const Chain& chain = model.nominal.chain;
    for (const YamlNode& entry : ranges->list(chain.joints.size())) {
      entry.with_keys({"joint", "range_rad", "range_m"});
      const auto joint = static_cast<std::size_t>(joint_at(entry, "joint", chain));
      if (joint != model.measured.size()) entry.fail("", "must name the joints in order");
      model.measured.push_back(read_range(entry, chain.joints[joint]));
    }
  }
  if (const YamlNode* gaps = file.find("measured_gaps")) {
    const Chain& chain = model.nominal.chain;
    for (const YamlNode& entry : gaps->list()) {
      entry.with_keys({"joint", "range_rad", "range_m"});
      const int joint = joint_at(entry, "joint", chain);
      model.measured_gaps[joint].push_back(read_range(entry, chain.joints[static_cast<std::size_t>(joint)]));
    }
  }
  if (const YamlNode* counts = file.find("pose_counts")) {
    for (const YamlNode& entry : counts->list()) read_pose_counts(entry, model);
  }
  if (const YamlNode* marks = file.find("pose_marks")) {
    for (const YamlNode& mark : marks->list()) model.pose_marks.push_back(read_mark(mark));
    std::ranges::sort(model.pose_marks);
  }
  const YamlNode* node = file.find("posterior");
  if (node == nullptr) return;
  node->with_keys({"numbers", "terms", "triangle"});
  Posterior posterior;
  std::vector<ParameterId> possible = possible_parameters(model.robot);
  for (const YamlNode& name : node->at("numbers").list()) posterior.ids.push_back(take_parameter(name, possible));
  for (const YamlNode& term : node->at("terms").list()) posterior.terms.push_back(read_term(term, model.nominal.chain));
  const std::size_t size = posterior.ids.size() + posterior.terms.size();
  posterior.factor.setZero(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  Eigen::Index row = 0;
  for (const YamlNode& entry : node->at("triangle").list(size)) {
    const std::vector<double> numbers = entry.numbers();
    if (std::ssize(numbers) != row + 1) entry.fail("", "must have " + std::to_string(row + 1) + " numbers");
    for (Eigen::Index column = 0; column <= row; ++column)
      posterior.factor(row, column) = numbers[static_cast<std::size_t>(column)];
    ++row;
  }
  model.posterior = std::move(posterior);
}

std::string station_noise_text(const PredictionInterval& interval) {
  if (interval.station_noise_m.empty()) return {};
  std::string text;
  for (const auto& [station, noise_m] : interval.station_noise_m)
    text += (text.empty() ? "{" : ", {") + (station.empty() ? "" : "station: " + yaml_text(station) + ", ") +
            "noise_mm: " + millimetres_text(noise_m) + "}";
  return ", station_noise: [" + text + "]";
}

std::string prediction_text(const CalibratedModel& model) {
  if (!model.interval) return {};
  const PredictionInterval& interval = *model.interval;
  return "# Radius that holds 95 % of the errors at a pose: quantile * root of (what the posterior gives there + noise "
         "+ "
         "model error)\nprediction_interval: {quantile: " +
         number_text(interval.quantile) + ", noise_mm: " + millimetres_text(interval.noise_m) +
         ", distance_noise_mm: " + millimetres_text(interval.distance_noise_m) +
         ", model_error_mm: " + millimetres_text(interval.model_error_m) +
         ", poses: " + std::to_string(interval.poses) + ", gross_errors: " + std::to_string(interval.gross_errors) +
         ", told_by: " + (interval.fitted ? "calibration" : "validation") + station_noise_text(interval) +
         (interval.along_path ? ", along_path: true" : "") + "}\n";
}

void read_prediction(const YamlNode& file, CalibratedModel& model) {
  const YamlNode* node = file.find("prediction_interval");
  if (node == nullptr) return;
  constexpr int kMostPoses = 1'000'000'000;
  node->with_keys({"quantile", "noise_mm", "distance_noise_mm", "model_error_mm", "poses", "gross_errors", "told_by",
                   "station_noise", "along_path"});
  const auto length_m = [&](const char* key) { return metres(node->at(key).non_negative()); };
  const auto count = [&](const char* key) {
    return static_cast<std::size_t>(node->at(key).whole_number(0, kMostPoses));
  };
  model.interval =
      PredictionInterval{.quantile = node->at("quantile").non_negative(),
                         .noise_m = length_m("noise_mm"),
                         .distance_noise_m = length_m("distance_noise_mm"),
                         .model_error_m = length_m("model_error_mm"),
                         .poses = count("poses"),
                         .gross_errors = count("gross_errors"),
                         .fitted = node->at("told_by").one_of<bool>({{"validation", false}, {"calibration", true}})};
  if (const YamlNode* path = node->find("along_path")) model.interval->along_path = path->boolean();
  if (const YamlNode* stations = node->find("station_noise")) {
    for (const YamlNode& one : stations->list()) {
      one.with_keys({"station", "noise_mm"});
      const YamlNode* station = one.find("station");
      model.interval->station_noise_m[station != nullptr ? station->text() : std::string()] =
          metres(one.at("noise_mm").non_negative());
    }
  }
}

}  // namespace demecal::inline config
