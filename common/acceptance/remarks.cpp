#include "acceptance/remarks.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <utility>

#include "acceptance/verdict.hpp"
#include "data/certificate_fields.hpp"
#include "data/text.hpp"
#include "parameters/posterior.hpp"
#include "report/evaluation.hpp"

namespace demecal::inline acceptance {
namespace {

class Remarks {
 public:
  Remarks(const Certificate& certificate, const CalibratedModel& model, const DataSet& data, const CertifiedRun& run)
      : certificate_(certificate),
        model_(model),
        data_(data),
        run_(run),
        touches_(certificate.words.of_one == kJudgedLengths.of_one) {}

  std::vector<std::string> all() {
    add_on_model();
    add_on_set();
    if (touches_)
      add("No instrument saw the tool: judged are known lengths between points that the arm touched, one posture at "
          "each end. Errors that leave lengths as they are, such as where the arm stands, are not seen.");
    else
      add_on_measurement();
    if (certificate_.date_is_of_run)
      add("The date of measurement is not stated; the date of this document, " + run_.today + ", stands in its place.");
    for (const UnappliedEffect& one : unapplied_effects(model_.robot, data_)) add(one.sentence + ".");
    add_on_excluded();
    all_.insert(all_.end(), run_.notes.begin(), run_.notes.end());
    return std::move(all_);
  }

 private:
  void add(std::string sentence) { all_.push_back(std::move(sentence)); }

  void add_on_model() {
    if (!touches_)
      add("The errors after are those of motions that this model corrects, the side of approach known; what is not "
          "corrected errs as before.");
    if (!model_.posterior || !model_.interval)
      return add("The model file is of an older version and states no uncertainty.");
    if (model_.interval->fitted && certificate_.uncertainty)
      add("Uncertainties come from the poses to which the model was fitted, since there were no validation poses: they "
          "may be too narrow.");
    if (model_.interval->along_path) add(std::string("Of the stated uncertainties: ") + kAlongPathRemark + '.');
  }

  void add_on_set() {
    const std::string& set = certificate_.judged_set;
    const bool own = is_calibrated_with(model_, data_);
    if (set != "accept")
      add("The data hold no accept poses: the " + set + " poses are judged" + (own ? part_in_model(set) : "."));
    if (own) return;
    if (!run_.sets_stated)
      add(run_.refit_base ? "The data state no sets: which poses are judged was drawn."
                          : "The data state no sets and are not those of the model: all poses are judged.");
    if (model_.pose_marks.empty())
      add("The data are another file than the model was calibrated with: whether any of these poses had a part in the "
          "model is not known here.");
    else if (marked_poses(model_, data_).empty())
      add(
          fmt::format("The data are another file than the model was calibrated with, and hold none of the {} poses by "
                      "which the model knows its own again.",
                      model_.pose_marks.size()));
    else
      add("The data are another file than the model was calibrated with, and hold poses that had a part in it.");
  }

  static std::string part_in_model(const std::string& set) {
    return set == "validation" ? ", which took part in the choice of the model."
                               : ", to which the model was fitted: its error elsewhere may be larger.";
  }

  /// Of positions and lengths that an instrument saw.
  void add_on_measurement() {
    const bool turned = std::ranges::any_of(judged_poses(data_),
                                            [&](std::size_t row) { return data_.poses[row].orientation.has_value(); });
    add(turned ? "Orientations were measured but are not judged: only positions are."
               : "Orientation was not judged: only positions are.");
    if (std::string beyond = beyond_radii_sentence(certificate_); !beyond.empty()) add(std::move(beyond));
    if (!run_.fields.instrument_uncertainty_m)
      add("The instrument's uncertainty is not stated (instrument_uncertainty_mm): errors of the instrument that all "
          "poses share are not in the guard band.");
    if (certificate_.judgement.poses < certificate_.poses.size())
      add(
          fmt::format("{} were measured with several targets, from several sides or under several conditions: of each "
                      "the largest error is judged.",
                      counted(certificate_.judgement.poses, "pose")));
    const auto is_repeated = [](const CertifiedPose& pose) { return pose.measurements > 1; };
    if (std::ranges::none_of(certificate_.poses, is_repeated))
      add("No judged pose was measured repeatedly: the noise in the guard band above the tolerance is what the model's "
          "fit left, which holds the model's error too.");
    else
      add("Of a pose that was measured repeatedly the error is judged that 95 % of its single measurements keep "
          "within, "
          "not that of their mean (AP).");
    if (run_.refit_base)
      add("Base and tool were fitted to this data set's poses that are not judged before anything else.");
    if (!certificate_.before.mean_mm)
      add("So few poses tell neither base nor tool of the arm as its maker describes it: no errors before are stated.");
    else if (placing_poses(data_).empty())
      add("The data hold too few poses beside those that are judged: the errors before are those with the base fitted "
          "to the judged poses themselves.");
    add_on_range();
  }

  void add_on_range() {
    for (const std::string& sentence : widened_sentences(model_, data_, judged_poses(data_))) add(sentence);
  }

  void add_on_excluded() {
    constexpr std::size_t kMostNamed = 10;
    std::vector<std::string> names;
    for (const MeasuredPose& pose : data_.excluded)
      names.push_back(pose.pose_id.empty() ? fmt::format("line {}", pose.line) : pose.pose_id);
    const std::size_t count = names.size();
    if (count == 0) return;
    if (count > kMostNamed) names.resize(kMostNamed);
    add(fmt::format("{} {} excluded in the data set's file: {}{}.", counted(count, "measurement"),
                    count == 1 ? "is" : "are", fmt::join(names, ", "), count > kMostNamed ? " and others" : ""));
  }

  const Certificate& certificate_;
  const CalibratedModel& model_;
  const DataSet& data_;
  const CertifiedRun& run_;
  const bool touches_;
  std::vector<std::string> all_;
};

}  // namespace

std::string beyond_radii_sentence(const Certificate& certificate) {
  std::vector<PoseErrorEntry> entries;
  for (const CertifiedPose& pose : certificate.poses)
    entries.push_back({pose.id, pose.target, certificate.judged_set, {}, pose.after_mm, pose.uncertainty_mm, {}});
  return beyond_radii_sentence(entries);
}

std::vector<std::string> remarks_on(const Certificate& certificate, const CalibratedModel& model, const DataSet& data,
                                    const CertifiedRun& run) {
  return Remarks(certificate, model, data, run).all();
}

}  // namespace demecal::inline acceptance
