// A certificate with everything that one can have, and one with nothing that nobody must state.
#pragma once

#include "acceptance/certificate.hpp"

namespace demecal {

inline Certificate made_up_certificate(std::size_t poses = 24) {
  Certificate certificate;
  for (const CertificateField& field : kCertificateFields)
    certificate.fields.texts[field.key] = std::string("the ") + field.key + " & <co> \xC3\xA9";
  certificate.fields.texts["country"] = "DE";
  certificate.fields.texts["date"] = "2026-03-04";
  certificate.fields.instrument_uncertainty_m = 2e-5;
  certificate.robot = certificate.fields.text("robot");
  certificate.job = "cell-7";
  certificate.model_version = certificate.version = "0.1.0";
  certificate.data_name = "acceptance";
  certificate.data_sha256 = std::string(64, 'a');
  certificate.model_sha256 = std::string(64, 'b');
  certificate.model_data_sha256 = std::string(64, 'c');
  certificate.measured_on = "2026-03-04";
  certificate.issued_on = "2026-03-05";
  certificate.judged_set = "accept";
  certificate.judged_rows = poses;
  certificate.conditions = {
      {"payload", 0.0, 2.5, "kg"}, {"temperature", {}, {}, "°C"}, {"joint 1", -90.0, 90.0, "deg"}};
  certificate.before = {1.2, 1.3, 2.1, 2.9};
  certificate.after = {0.071, 0.082, 0.131, 0.187};
  certificate.before_words = "as its maker describes it, base fitted";
  certificate.characteristics = {{"AP", "Pose accuracy", "7.2.1", 0.187, "24 poses"},
                                 {"RP", "Pose repeatability", "7.2.2", {}, "no pose was measured repeatedly"}};
  std::vector<double> errors_m;
  for (std::size_t i = 0; i < poses; ++i) {
    const double error_mm = 0.187 - 0.005 * static_cast<double>(i);
    errors_m.push_back(1e-3 * error_mm);
    certificate.poses.push_back({"P " + std::to_string(i), i % 2 == 0 ? "" : "A", 1, 1.0, error_mm, 0.2, false});
    certificate.view.points_m.emplace_back(Eigen::Vector3d(0.1 * static_cast<double>(i), 0.5, 0.2), errors_m.back());
  }
  certificate.view.arm = {Eigen::Vector3d::Zero(), {0, 0, 0.5}, {0.5, 0, 0.5}};
  certificate.judgement = judge(errors_m, 5e-4, 1e-5, 2e-5);
  certificate.uncertainty =
      UncertaintyEntry{{{"numbers of the model", "A", 0.03}, {"instrument", "B", {}}}, 0.04, 2.0, 0.08, "from poses"};
  certificate.remarks = {"A remark with <tags> & more."};
  return certificate;
}

inline Certificate bare_certificate() {
  Certificate certificate = made_up_certificate();
  certificate.fields = {};
  certificate.robot = "PUMA 761";
  certificate.missing = {"Customer", "Operator"};
  certificate.uncertainty.reset();
  certificate.before = certificate.after = {};
  certificate.judgement = judge(std::vector<double>{1e-4}, 1e-4, 0.0, 0.0);
  return certificate;
}

}  // namespace demecal
