#include "certificate/dcc_results.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <vector>

#include "acceptance/iso9283.hpp"
#include "acceptance/verdict.hpp"
#include "data/certificate_fields.hpp"
#include "kinematics/units.hpp"
#include "report/evaluation.hpp"

namespace demecal::inline certificate {
namespace {

/// A number as SI Format's decimalType takes it.
std::string decimal(double value) {
  return fmt::format("{}", value + 0.0);
}

/// The units of conditions and results as SI Format writes them.
std::string si_unit(const std::string& unit) {
  if (unit == "mm") return "\\milli\\metre";
  if (unit == "deg") return "\\degree";
  if (unit == "kg") return "\\kilogram";
  if (unit == "s") return "\\second";
  return "\\degreecelsius";
}

/// Names without blanks, since a list of them is parted by blanks.
std::string list_name(const CertifiedPose& pose) {
  std::string name = xml_text(pose.id + (pose.target.empty() ? "" : "/" + pose.target));
  std::ranges::replace(name, ' ', '_');
  return name.empty() ? "-" : name;
}

}  // namespace

std::string DccResults::stated(const std::string& key) const {
  const std::string text = xml_text(certificate_.fields.text(key));
  return text.empty() ? kNotStated : text;
}

void DccResults::named(const std::string& element, const std::string& text) {
  xml_.element(element, [&] { xml_.leaf("dcc:content", text.empty() ? kNotStated : text); });
}

void DccResults::real(double value, const std::string& unit) {
  xml_.element("si:real", [&] {
    xml_.leaf("si:value", decimal(value));
    xml_.leaf("si:unit", si_unit(unit));
  });
}

void DccResults::quantity(const std::string& name, std::optional<double> value, const std::string& unit,
                          const std::string& why) {
  xml_.element("dcc:quantity", [&] {
    named("dcc:name", name);
    if (value) {
      real(*value, unit);
    } else {
      named("dcc:noQuantity", why);
    }
  });
}

void DccResults::result(const std::string& name, const std::function<void()>& data) {
  xml_.element("dcc:result", [&] {
    named("dcc:name", name);
    xml_.element("dcc:data", data);
  });
}

void DccResults::errors(const SetErrors& errors) {
  quantity("mean", errors.mean_mm, "mm");
  quantity("root mean square", errors.rms_mm, "mm");
  quantity("95th percentile", errors.p95_mm, "mm");
  quantity("largest", errors.max_mm, "mm");
}

void DccResults::results() {
  const std::string set = fmt::format("{} {} measurements", certificate_.judged_rows, certificate_.judged_set);
  const std::string& judged = certificate_.words.quantity;
  if (certificate_.before.mean_mm)
    result(judged + " before calibration: " + certificate_.before_words + ", " + set,
           [&] { errors(certificate_.before); });
  result(judged + " after calibration, " + set, [&] { errors(certificate_.after); });
  result("criteria of ISO 9283", [&] {
    for (const Characteristic& one : certificate_.characteristics) {
      quantity(fmt::format("{}: {} ({})", one.symbol, one.title, one.clause), one.value_mm, "mm",
               "not measured: " + one.basis);
    }
  });
  result("conformity with the tolerance", [&] { judgement(); });
  if (certificate_.uncertainty) result("uncertainty of a corrected position", [&] { uncertainty(); });
  result("judged " + certificate_.words.poses, [&] { xml_.element("dcc:list", [&] { poses(); }); });
}

void DccResults::judgement() {
  const Judgement& judged = certificate_.judgement;
  const auto in_mm = [](const std::optional<double>& value_m) {
    return value_m ? std::optional(millimetres(*value_m)) : std::nullopt;
  };
  quantity("tolerance", millimetres(judged.tolerance_m), "mm");
  quantity("error that 95 % of the judged " + certificate_.words.poses + " keep within", millimetres(judged.error_m),
           "mm");
  quantity("upper limit of the same of all " + certificate_.words.poses + " like these, 97.5 % confidence" +
               (judged.assumes_normal ? " if errors are normally distributed" : ""),
           in_mm(judged.upper_m), "mm", "too few poses");
  quantity("lower limit of the same of all " + certificate_.words.poses + " like these, 97.5 % confidence",
           in_mm(judged.lower_m), "mm", "too few poses");
  quantity("guard band below the tolerance", millimetres(judged.guard_below_m), "mm");
  quantity("guard band above the tolerance", millimetres(judged.guard_above_m), "mm");
}

void DccResults::uncertainty() {
  const UncertaintyEntry& entry = *certificate_.uncertainty;
  for (const UncertaintyContribution& one : entry.contributions)
    quantity("type " + one.type + ": " + one.name, one.standard_mm, "mm", kNotStated);
  quantity("standard uncertainty", entry.standard_mm, "mm");
  quantity("expanded uncertainty, k = 2, about 95 %", entry.expanded_mm, "mm");
}

void DccResults::list_quantity(const std::string& name, std::optional<double> CertifiedPose::*value) {
  std::string values;
  for (const CertifiedPose& pose : certificate_.poses) {
    if (!(pose.*value)) return;
    values += decimal(*(pose.*value)) + " ";
  }
  if (values.empty()) return;
  xml_.element("dcc:quantity", [&] {
    named("dcc:name", name);
    xml_.element("si:realListXMLList", [&] {
      xml_.leaf("si:valueXMLList", values);
      xml_.leaf("si:unitXMLList", si_unit("mm"));
    });
  });
}

void DccResults::poses() {
  std::string names;
  for (const CertifiedPose& pose : certificate_.poses) names += list_name(pose) + " ";
  xml_.element("dcc:quantity", [&] {
    named("dcc:name", "poses");
    xml_.leaf("dcc:charsXMLList", names);
  });
  if (std::ranges::any_of(certificate_.poses, [](const CertifiedPose& pose) { return !pose.approach.empty(); })) {
    std::string sides;
    for (const CertifiedPose& pose : certificate_.poses) sides += (pose.approach.empty() ? "-" : pose.approach) + " ";
    xml_.element("dcc:quantity", [&] {
      named("dcc:name", "side that each joint was approached from");
      xml_.leaf("dcc:charsXMLList", sides);
    });
  }
  const std::string one = certificate_.words.of_one == "AP" ? "pose accuracy AP" : certificate_.words.of_one;
  list_quantity(one + " before calibration", &CertifiedPose::before_mm);
  list_quantity(one + " after calibration", &CertifiedPose::after_mm);
  list_quantity("error that 95 % of the single measurements of a pose keep within, after calibration",
                &CertifiedPose::single_mm);
  list_quantity(
      "radius that the model predicts to hold 95 % of measured errors at the pose (no uncertainty of " + one + ")",
      &CertifiedPose::uncertainty_mm);
}

}  // namespace demecal::inline certificate
