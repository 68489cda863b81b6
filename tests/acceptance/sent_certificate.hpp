// Certificates of an arm whose errors the test chooses.
#pragma once

#include <algorithm>
#include <string>

#include "acceptance/certificate.hpp"
#include "sent_arm.hpp"

namespace demecal {

inline constexpr double kError_m = 1e-3;

inline CalibratedModel model_of(const SentArm& arm) {
  CalibratedModel model;
  model.nominal = arm.data().robot;
  model.robot = nominal_robot(arm.data());
  model.declared.registration = true;
  model.data_sha256 = "of the model";
  model.interval = PredictionInterval{};
  model.interval->noise_m = 4e-4;
  return model;
}

inline Certificate certificate_of(const SentArm& arm, const CertifiedRun& run) {
  return make_certificate(model_of(arm), arm.data(), run);
}

inline bool remarks_on(const Certificate& certificate, const std::string& words) {
  return std::ranges::any_of(certificate.remarks,
                             [&](const std::string& remark) { return remark.find(words) != std::string::npos; });
}

inline void add_others(SentArm& arm, PoseSet set, int count) {
  for (int i = 0; i < count; ++i) arm.add("O" + std::to_string(i), arm.somewhere(), Eigen::Vector3d::Zero()).set = set;
}

inline CertifiedRun run_at(double tolerance_m) {
  return {.fields = {}, .tolerance_m = tolerance_m, .today = "2026-02-03", .model_sha256 = ""};
}

}  // namespace demecal
