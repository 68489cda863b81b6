#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "acceptance/certificate.hpp"
#include "acceptance/iso9283.hpp"
#include "acceptance/verdict.hpp"
#include "kinematics/units.hpp"
#include "report/error_fields.hpp"
#include "report/json.hpp"

namespace demecal::inline acceptance {

void fields(auto& visit, Like<Condition> auto& one) {
  visit("name", one.name, "lower", one.lower, "upper", one.upper, "unit", one.unit);
}

void fields(auto& visit, Like<Characteristic> auto& one) {
  visit("symbol", one.symbol, "title", one.title, "clause", one.clause, "value_mm", one.value_mm, "basis", one.basis);
}

void fields(auto& visit, Like<CertifiedPose> auto& pose) {
  visit("id", pose.id, "target", pose.target, "measurements", pose.measurements, "before_mm", pose.before_mm,
        "after_mm", pose.after_mm, "single_mm", pose.single_mm, "interval95_mm", pose.uncertainty_mm, "beyond",
        pose.beyond, "approach", pose.approach, "payload_kg", pose.payload_kg, "temperature_celsius",
        pose.temperature_celsius);
}

namespace {

std::optional<double> millimetres_if_any(const std::optional<double>& value_m) {
  if (!value_m) return std::nullopt;
  return millimetres(*value_m);
}

}  // namespace

void fields(auto& visit, Like<Judgement> auto& judged) {
  visit("verdict", std::string(to_string(judged.verdict)), "tolerance_mm", millimetres(judged.tolerance_m),
        "share_of_poses", kAcceptedShare, "confidence", kConfidence, "error_mm", millimetres(judged.error_m),
        "lower_mm", millimetres_if_any(judged.lower_m), "upper_mm", millimetres_if_any(judged.upper_m),
        "guard_below_mm", millimetres(judged.guard_below_m), "guard_above_mm", millimetres(judged.guard_above_m),
        "poses", judged.poses, "beyond", judged.beyond, "assumes_normal", judged.assumes_normal, "withheld",
        judged.withheld);
}

void fields(auto& visit, Like<Certificate> auto& certificate) {
  visit("robot", certificate.robot, "data", certificate.data_name, "data_sha256", certificate.data_sha256,
        "model_sha256", certificate.model_sha256, "version", certificate.version, "measured_on",
        certificate.measured_on, "issued_on", certificate.issued_on, "judged_set", certificate.judged_set, "judged",
        certificate.words.quantity, "judgement", certificate.judgement, "poses_to_decide", certificate.poses_to_decide,
        "sentence", verdict_sentence(certificate), "remedy", remedy_sentence(certificate));
  visit.within("error_mm", [&](auto& error) { error("before", certificate.before, "after", certificate.after); });
  visit("characteristics", certificate.characteristics, "uncertainty", certificate.uncertainty, "conditions",
        certificate.conditions, "poses", certificate.poses, "missing", certificate.missing, "remarks",
        certificate.remarks);
}

std::string verdict_sentence(const Certificate& certificate) {
  const Judgement& judged = certificate.judgement;
  const double tolerance_mm = millimetres(judged.tolerance_m);
  const std::string claim =
      fmt::format("the {} is at most {:.10g} mm at {:.0f} % of {} like the {} {} {} judged here",
                  certificate.words.quantity, tolerance_mm, 100.0 * kAcceptedShare, certificate.words.poses,
                  judged.poses, certificate.judged_set, certificate.words.poses);
  switch (judged.verdict) {
    case Conformity::conformity:
      if (judged.assumes_normal)
        return fmt::format(
            "Conformity proved if errors are normally distributed: {}, at a confidence of {:.1f} % then; fewer than {} "
            "{} prove it of no other distribution.",
            claim, 100.0 * kConfidence, fewest_without_assumption(), certificate.words.poses);
      return fmt::format("Conformity proved: {}, at a confidence of {:.1f} %.", claim, 100.0 * kConfidence);
    case Conformity::non_conformity:
      return fmt::format("Non-conformity proved: it is not true, at a confidence of {:.1f} %, that {}.",
                         100.0 * kConfidence, claim);
    case Conformity::undecided:
      break;
  }
  if (!judged.withheld.empty())
    return fmt::format("Undecided: {}: these measurements prove neither that {} nor that it is not.", judged.withheld,
                       claim);
  return fmt::format("Undecided: these measurements prove neither that {} nor that it is not.", claim);
}

std::string remedy_sentence(const Certificate& certificate) {
  const Judgement& judged = certificate.judgement;
  if (judged.verdict != Conformity::undecided) return {};
  if (judged.guard_below_m >= judged.tolerance_m)
    return certificate.words.of_one == kJudgedLengths.of_one
               ? "The uncertainty of the known lengths alone is as large as the tolerance: a better known length is "
                 "needed."
               : "The instrument's uncertainty alone is as large as the tolerance: another instrument is needed.";
  if (certificate.poses_to_decide) {
    return fmt::format(
        "{0} {1} in all, {2} more of the same kind, would decide if the share of {1} beyond the limit stays as it is.",
        *certificate.poses_to_decide, certificate.words.poses, *certificate.poses_to_decide - judged.poses);
  }
  if (!judged.withheld.empty())
    return "Measure " + certificate.judged_set + " " + certificate.words.poses + " of their own.";
  return "The error is so close to the tolerance that no practical number of " + certificate.words.poses +
         " would decide.";
}

std::string to_json(const Certificate& certificate) {
  nlohmann::ordered_json json{{"demecal_certificate", 1}};
  JsonWriter write(json);
  fields(write, certificate);
  return to_text(json, -1);
}

}  // namespace demecal::inline acceptance
