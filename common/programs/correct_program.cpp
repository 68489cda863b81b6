#include "programs/correct_program.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <memory>
#include <numeric>
#include <set>
#include <tuple>
#include <type_traits>
#include <utility>

#include "data/data_set.hpp"
#include "data/payload.hpp"
#include "data/text.hpp"
#include "effects/arm_state.hpp"
#include "kinematics/inverse.hpp"
#include "kinematics/units.hpp"
#include "parsed_programs/orientation.hpp"
#include "parsed_programs/payload_flow.hpp"
#include "parsed_programs/program_text.hpp"
#include "programs/approach_sides.hpp"
#include "programs/configuration.hpp"
#include "programs/followed_motions.hpp"
#include "programs/nominal_joints.hpp"
#include "programs/stated_configuration.hpp"
#include "programs/target_correction.hpp"

namespace demecal::inline programs {
namespace {

/// The joint that two configurations differ in most.
std::string differing_joint(const Chain& arm, const JointVector& one, const JointVector& other) {
  Eigen::Index joint = 0;
  (one - other).cwiseAbs().maxCoeff(&joint);
  const Joint& link = arm.joints[static_cast<std::size_t>(joint)];
  return joint_label(static_cast<int>(joint)) + " at " + joint_amount(link, one[joint]) + " or " +
         joint_amount(link, other[joint]);
}

std::string moved_text(const CorrectedTarget& corrected) {
  const Eigen::Vector3d moved_m = corrected.command_tool.translation() - corrected.nominal_tool.translation();
  return "(" + fixed_text(millimetres(moved_m.x()), 3) + ", " + fixed_text(millimetres(moved_m.y()), 3) + ", " +
         fixed_text(millimetres(moved_m.z()), 3) + ") mm";
}

class Corrector {
 public:
  Corrector(const CommandModel& model, const Circumstances& circumstances, std::set<std::string> untold_tools)
      : model_(model), circumstances_(circumstances), untold_tools_(std::move(untold_tools)) {}

  /// `visits`: all to this target, the first first; `line_at`: the line of a visit's byte.
  CorrectedTarget correct(const Target& target, const std::vector<TargetVisit>& visits,
                          const std::function<std::size_t(std::size_t)>& line_at) {
    if (!target.not_sent_to.empty()) return left(target.not_sent_to + "; it is left as it is");
    if (!unknown_frames(target, circumstances_).empty()) return refused(target);
    if (payload_of(target) > most_payload_kg(model_.nominal))
      return left("it would carry " + number_text(payload_of(target)) + " kg, " + above_most_payload(model_.nominal) +
                  "; this line was not corrected; state the payload in kg");
    CorrectedTarget corrected = with_known_frames(target, visits.front(), model_for(target));
    for (std::size_t i = 1; i < visits.size() && !corrected.is_uncorrected(); ++i)
      check_posture(target, visits[i], line_at(visits[i].order), corrected);
    for (std::size_t i = 1; i < visits.size() && !corrected.is_uncorrected(); ++i)
      check_side(target, visits[i], line_at(visits[i].order), corrected);
    if (!corrected.is_uncorrected() && !(target.approach && target.approach->allFinite())) {
      corrected.unknown_side_m = unknown_side_m(model_for(target), corrected);
      if (corrected.error95_m) *corrected.error95_m += 0.5 * corrected.unknown_side_m;
    }
    corrected.texts = cell_texts(target, corrected);
    constexpr double kNegligible_m = 5e-6;
    const double rounded_m = rounding_m(target, model_for(target), corrected);
    if (corrected.error95_m && rounded_m > kNegligible_m) *corrected.error95_m += rounded_m;
    return corrected;
  }

  /// What is to be said of the tools that targets state.
  std::vector<std::string> notes_of_tools() const {
    std::vector<std::string> notes;
    for (const auto& [tool_m, model] : with_tools_)
      if (!model->tool_note.empty()) notes.push_back(model->tool_note);
    return notes;
  }

 private:
  /// The program moves again to a target that was corrected so: leaves it where the joints that it is then reached with
  /// ask for another correction.
  void check_posture(const Target& target, const TargetVisit& visit, std::size_t line, CorrectedTarget& corrected) {
    if (!target.is_pose()) return;
    const CommandModel& model = model_for(target);
    for (const JointVector& joints : visit.found.joints) {
      const CorrectedTarget again = correct_target(target, model, corrected.stop.with_joints(joints));
      if (agree(corrected, again)) {
        if (leave_if_reconfigured(target, model.nominal.chain, again, corrected)) return;
        continue;
      }
      const PoseError difference = pose_error(corrected.command_tool, again.command_tool);
      const bool known = visit.found.from != JointsFrom::undetermined;
      corrected.remarks = {"line " + std::to_string(line) + (known ? " reaches" : " may reach") +
                           " it in another configuration than the first motion does (" +
                           differing_joint(model.nominal.chain, corrected.nominal, again.nominal) +
                           "), and the corrections differ by " +
                           fixed_text(millimetres(difference.head<3>().norm()), 3) + " mm and " +
                           fixed_text(degrees(difference.tail<3>().norm()), 3) +
                           " deg; it was not corrected; a point of its own for each tells them apart"};
      corrected.outcome = CorrectionOutcome::uncorrected;
      return;
    }
  }

  /// Says so where the side that it then comes from asks for another correction.
  void check_side(const Target& target, const TargetVisit& visit, std::size_t line, CorrectedTarget& corrected) {
    const bool known = corrected.from != JointsFrom::undetermined;
    if (!known || approach_of(target, visit.approach) == corrected.stop.approach) return;
    const CorrectedTarget again = correct_target(target, model_for(target), stop_at(target, visit, corrected.nominal));
    if (again.is_uncorrected() || agree(corrected, again)) return;
    const PoseError difference = pose_error(corrected.command_tool, again.command_tool);
    corrected.remarks.push_back("line " + std::to_string(line) +
                                " comes to it from another side than the first motion does, and the " +
                                "corrections differ by " + fixed_text(millimetres(difference.head<3>().norm()), 3) +
                                " mm: it has that of the first; a point of its own for each side tells them apart");
  }

  static CorrectedTarget left(std::string sentence) {
    CorrectedTarget corrected;
    corrected.outcome = CorrectionOutcome::uncorrected;
    corrected.remarks.push_back(std::move(sentence));
    return corrected;
  }

  CorrectedTarget refused(const Target& target) const {
    const bool frame = target.is_pose() && !target.frames.unknown_frame.empty();
    return left(unknown_frames(target, circumstances_) + "; this line was not corrected" +
                (frame || target.frames.several_tools ? "" : remedy_of_tools()));
  }

  std::string remedy_of_tools() const {
    if (untold_tools_.size() < 2) return "; --tool-mm states the tool";
    std::string names;
    for (const std::string& name : untold_tools_) names += (names.empty() ? "" : ", ") + name;
    return "; --tool-mm states one tool, and the program has " + std::to_string(untold_tools_.size()) +
           " that are not known (" + names + "): --frames states each";
  }

  /// The model with the tool that the target states: one that the user names beside it is none of the target's.
  const CommandModel& model_for(const Target& target) {
    if (!target.frames.tool) return model_;
    const Eigen::Vector3d tool_m = target.frames.tool->translation();
    for (const auto& [known_m, model] : with_tools_) {
      if (known_m == tool_m) return *model;
    }
    const CommandModel& own = circumstances_.own_tool != nullptr ? *circumstances_.own_tool : model_;
    with_tools_.emplace_back(tool_m, std::make_unique<CommandModel>(with_stated_tool(own, tool_m)));
    return *with_tools_.back().second;
  }

  CorrectedTarget with_known_frames(const Target& target, const TargetVisit& visit, const CommandModel& model) {
    const Configurations& found = visit.found;
    if (found.joints.empty()) return {};
    if (target.is_pose() && found.from != JointsFrom::line && contradictions(target.hint, found.joints.front()) > 0)
      return left(
          "no joints were found that reach the pose in the configuration that is stated; this line was not corrected");
    if (!found.contradicted_by.empty())
      return left("the arm's configuration, stated as '" + target.hint.configuration + "', would be the one that '" +
                  found.contradicted_by + "' states elsewhere; one of them is not so, and this line was not corrected");
    std::vector<CorrectedTarget> alternatives;
    for (const JointVector& joints : found.joints)
      alternatives.push_back(correct_target(target, model, stop_at(target, visit, joints)));
    CorrectedTarget corrected = std::move(alternatives.front());
    corrected.from = found.from;
    for (std::size_t i = 1; i < alternatives.size(); ++i) {
      if (agree(corrected, alternatives[i])) continue;
      leave_undetermined(target, model.nominal.chain, alternatives, i, corrected);
      return corrected;
    }
    if (leave_if_reconfigured(target, model.nominal.chain, corrected, corrected)) return corrected;
    for (std::size_t i = 1; i < alternatives.size(); ++i)
      if (leave_if_reconfigured(target, model.nominal.chain, alternatives[i], corrected)) break;
    return corrected;
  }

  /// Leaves a target that is, corrected in this way, not in the configuration that it states.
  static bool leave_if_reconfigured(const Target& target, const Chain& arm, const CorrectedTarget& way,
                                    CorrectedTarget& corrected) {
    const std::string why = leaving_stated(target, arm, way.nominal, way.command);
    if (why.empty()) return false;
    corrected.remarks = {why};
    corrected.outcome = CorrectionOutcome::uncorrected;
    return true;
  }

  /// Whether the program's numbers come out the same.
  static bool agree(const CorrectedTarget& one, const CorrectedTarget& other) {
    constexpr double kTolerance_m = 5e-5, kTolerance_rad = 5e-4;
    const PoseError difference = pose_error(one.command_tool, other.command_tool);
    return difference.head<3>().norm() <= kTolerance_m && difference.tail<3>().norm() <= kTolerance_rad;
  }

  static void leave_undetermined(const Target& target, const Chain& arm,
                                 const std::vector<CorrectedTarget>& alternatives, std::size_t other,
                                 CorrectedTarget& corrected) {
    const std::string& words = target.hint.configuration;
    const PoseError difference = pose_error(corrected.command_tool, alternatives[other].command_tool);
    corrected.remarks = {
        "the arm's configuration" +
        (words.empty() ? "" : ", stated as '" + words + "', which does not mean the same on all arms,") +
        " is not known (" + differing_joint(arm, corrected.nominal, alternatives[other].nominal) +
        "), and the corrections differ by " + fixed_text(millimetres(difference.head<3>().norm()), 3) + " mm and " +
        fixed_text(degrees(difference.tail<3>().norm()), 3) + " deg: " + moved_text(corrected) + " or " +
        moved_text(alternatives[other]) + "; this line was not corrected; " +
        (words.empty() ? "a joint move to joints near its own before it, or --near, tells"
                       : "joints within 0.5 rad of its own tell, before it or by --near")};
    corrected.outcome = CorrectionOutcome::uncorrected;
  }

  double payload_of(const Target& target) const {
    return target.payload_kg.value_or(circumstances_.payload_kg.value_or(0.0));
  }

  Stop stop_at(const Target& target, const TargetVisit& visit, const JointVector& joints) const {
    Stop stop(joints);
    stop.approach = approach_of(target, visit.approach);
    stop.payload_kg = payload_of(target);
    stop.payload_stated = target.payload_kg || circumstances_.payload_kg;
    stop.temperature_celsius =
        target.temperature_celsius ? target.temperature_celsius : circumstances_.temperature_celsius;
    stop.time_s = target.time_s;
    return stop;
  }

  const CommandModel& model_;
  Circumstances circumstances_;
  std::set<std::string> untold_tools_;
  std::vector<std::pair<Eigen::Vector3d, std::unique_ptr<CommandModel>>> with_tools_;
};

/// The line of a byte, from 1, in its own file.
std::size_t line_at(std::string_view text, const Program& program, std::size_t offset) {
  const std::size_t file = program.file_at(offset), begin = file == 0 ? 0 : program.further[file - 1].begin;
  const std::string_view before = text.substr(std::min(begin, text.size()), offset - std::min(begin, offset));
  return 1 + static_cast<std::size_t>(std::ranges::count(before, '\n'));
}

}  // namespace

CorrectedProgram correct_program(std::string_view text, Program program, const CommandModel& model,
                                 const Circumstances& circumstances) {
  CorrectedProgram result{with_followed_payloads(std::move(program)), {}, {}, {}};
  const std::set<std::string> tools = untold_tools(result.program);
  Circumstances with_tool = circumstances;
  with_tool.tool_given = circumstances.tool_given && tools.size() < 2;
  Corrector corrector(model, with_tool, tools);
  for (std::string& sentence : warnings_of(result.program, model, circumstances)) {
    result.warnings.push_back({kWholeProgram, "", std::move(sentence)});
  }
  for (const std::vector<Remark>* remarks : {&result.program.uncorrected, &result.program.remarks})
    result.warnings.insert(result.warnings.end(), remarks->begin(), remarks->end());
  result.targets.resize(result.program.targets.size());
  std::vector<bool> turned(result.targets.size());
  const auto line = [&](std::size_t offset) { return line_at(text, result.program, offset); };
  const auto correct = [&](std::size_t target, const std::vector<TargetVisit>& visits) {
    return corrector.correct(result.program.targets[target], visits, line);
  };
  const TargetVisits visits = corrected_by_sides(result.program, model, with_tool, correct, result.targets, turned);
  UnknownSides unknown, differing, turning;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const Target& target = result.program.targets[i];
    const bool differs = visits[i].front().differing_sides;
    note_unknown_side(target, result.targets[i], turned[i] ? turning : differs ? differing : unknown);
    for (std::string& sentence : warnings_of(result.targets[i], model)) {
      result.warnings.push_back({target.place, target.name, std::move(sentence)});
    }
  }
  for (std::string& note : corrector.notes_of_tools()) result.warnings.push_back({kWholeProgram, "", std::move(note)});
  for (const auto& [sides, why] :
       {std::pair{&unknown, "is not told"}, {&differing, "depends on the way there"}, {&turning, kTurnedBackWords}}) {
    if (sides->targets.empty()) continue;
    result.warnings.push_back({kWholeProgram, "", unknown_side_sentence(result.program, *sides, why)});
  }
  std::stable_sort(result.warnings.begin(), result.warnings.end(), [](const Remark& one, const Remark& other) {
    return std::tie(one.place.file, one.place.line, one.place.column) <
           std::tie(other.place.file, other.place.line, other.place.column);
  });
  result.text = replaced(text, result.program, result.targets);
  return result;
}

}  // namespace demecal::inline programs
