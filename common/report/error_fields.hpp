// Errors, poses and findings as JSON objects: what reports, evaluations and comparisons share.
#pragma once

#include "report/evaluation.hpp"
#include "report/json.hpp"
#include "report/pose_places.hpp"
#include "report/report.hpp"

namespace demecal::inline report {

void fields(auto& visit, Like<SetErrors> auto& errors) {
  visit("mean", errors.mean_mm, "rms", errors.rms_mm, "p95", errors.p95_mm, "max", errors.max_mm);
}

void fields(auto& visit, Like<ErrorBySet> auto& errors) {
  visit("calibration", errors.calibration, "validation", errors.validation, "accept", errors.accept);
}

void fields(auto& visit, Like<FindingEntry> auto& finding) {
  visit("kind", finding.kind, "joint", finding.joint, "poses", finding.poses);
  visit.within("error_mm", [&](auto& error) {
    error("as_given", finding.as_given_mm);
    error("if_changed", finding.if_changed_mm);
  });
  visit("sentence", finding.sentence);
}

void fields(auto& visit, Like<DataCheckEntry> auto& check) {
  visit("verdict", check.verdict, "findings", check.findings);
}

void fields(auto& visit, Like<PoseErrorEntry> auto& pose) {
  visit("id", pose.id, "target", pose.target, "set", pose.set, "before_mm", pose.before_mm, "after_mm", pose.after_mm,
        "interval95_mm", pose.interval95_mm, "flags", pose.flags);
  visit.when(!pose.place.joints.empty(), "joints", pose.place.joints);
  visit.when(!pose.place.position_mm.empty(), "position_mm", pose.place.position_mm);
  visit.when(!pose.place.before_error_mm.empty(), "before_error_mm", pose.place.before_error_mm);
  visit.when(!pose.place.after_error_mm.empty(), "after_error_mm", pose.place.after_error_mm);
  visit.when(pose.place.temperature_celsius.has_value(), "temperature_celsius", pose.place.temperature_celsius);
  visit.when(pose.place.time_s.has_value(), "time_s", pose.place.time_s);
}

void fields(auto& visit, Like<ArmJointEntry> auto& joint) {
  visit("type", joint.type, "placement", joint.placement);
}

void fields(auto& visit, Like<ArmCouplingEntry> auto& coupling) {
  visit("joint", coupling.joint, "from", coupling.from, "factor", coupling.factor);
}

void fields(auto& visit, Like<ArmEntry> auto& arm) {
  visit("base", arm.base, "joints", arm.joints, "flange", arm.flange, "tool_mm", arm.tool_mm);
  visit.when(!arm.couplings.empty(), "couplings", arm.couplings);
}

void fields(auto& visit, Like<UncertaintyContribution> auto& one) {
  visit("name", one.name, "type", one.type, "standard_mm", one.standard_mm);
}

void fields(auto& visit, Like<UncertaintyEntry> auto& entry) {
  visit("contributions", entry.contributions, "standard_mm", entry.standard_mm, "coverage_factor",
        entry.coverage_factor, "expanded_mm", entry.expanded_mm, "remark", entry.remark);
}

void fields(auto& visit, Like<LengthErrorEntry> auto& length) {
  visit("between", length.between, "set", length.set, "known_mm", length.known_mm, "sigma_mm", length.sigma_mm,
        "before_mm", length.before_mm, "error_mm", length.error_mm, "uncertainty_mm", length.uncertainty_mm);
}

}  // namespace demecal::inline report
