// What a certificate counts, what it takes from where, and what it must not leave unsaid.
#include "acceptance/certificate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "errors/input_error.hpp"
#include "sent_certificate.hpp"

namespace demecal {
namespace {

TEST(Certificate, JudgesThePoseAndNotItsSides) {
  SentArm arm(21);
  for (int i = 0; i < 12; ++i) {
    const JointVector joints = arm.somewhere();
    for (const double side : {1.0, -1.0})
      arm.add("P" + std::to_string(i), joints, (side > 0 ? 1.0 : 0.2) * Eigen::Vector3d(kError_m, 0, 0)).approach =
          ApproachSigns::Constant(6, side);
  }
  const Certificate certificate = certificate_of(arm, run_at(2e-3));
  EXPECT_EQ(certificate.judgement.poses, 12U);
  EXPECT_EQ(certificate.poses.size(), 24U);
  EXPECT_NEAR(certificate.judgement.error_m, kError_m, 1e-9) << "the larger of the two";
  EXPECT_TRUE(remarks_on(certificate, "12 poses were measured with several targets, from several sides"));
}

TEST(Certificate, TellsFromWhichSideAPoseWasApproachedWhereTheDataDo) {
  for (const bool recorded : {true, false}) {
    SentArm arm(25);
    for (int i = 0; i < 12; ++i) {
      MeasuredPose& pose = arm.add("P" + std::to_string(i), arm.somewhere(), Eigen::Vector3d(1e-4 * i, 0, 0));
      if (recorded) pose.approach = ApproachSigns::Constant(6, i - 10);
      if (recorded) (*pose.approach)[5] = 0;
    }
    const Certificate certificate = certificate_of(arm, run_at(2e-3));
    EXPECT_EQ(certificate.poses.front().id, "P11");
    EXPECT_EQ(certificate.poses.front().approach, recorded ? "+++++0" : "");
    EXPECT_EQ(certificate.poses.back().approach, recorded ? "-----0" : "");
    EXPECT_EQ(to_json(certificate).find("+++++0") != std::string::npos, recorded);
  }
}

TEST(Certificate, TakesPosesAtTheSameJointsForOne) {
  SentArm arm(22), apart(22);
  for (int i = 0; i < 20; ++i) {
    const JointVector joints = arm.somewhere();
    for (const char* const target : {"A", "B", "C"})
      arm.add(target + std::to_string(i), joints, Eigen::Vector3d(kError_m, 0, 0));
    apart.add(std::to_string(i), joints, Eigen::Vector3d(kError_m, 0, 0));
  }
  EXPECT_EQ(certificate_of(arm, run_at(2e-3)).judgement.poses, 20U);
  const Certificate certificate = certificate_of(apart, run_at(2e-3));
  EXPECT_EQ(certificate.judgement.poses, 20U);
  EXPECT_FALSE(remarks_on(certificate, "several targets"));
}

TEST(Certificate, FitsNoBaseToThePosesThatItJudges) {
  SentArm arm(23);
  add_others(arm, PoseSet::accept, 8);
  CertifiedRun run = run_at(1e-3);
  EXPECT_TRUE(remarks_on(certificate_of(arm, run), "fitted to the judged poses themselves"));
  run.refit_base = true;
  EXPECT_THROW(certificate_of(arm, run), InputError);
  add_others(arm, PoseSet::calibration, 12);
  const Certificate refitted = certificate_of(arm, run);
  EXPECT_TRUE(remarks_on(refitted, "poses that are not judged"));
  EXPECT_FALSE(remarks_on(refitted, "fitted to the judged poses themselves"));
}

TEST(Certificate, JudgesPosesThatAreTooFewToTellTheBase) {
  for (const int count : {2, 3}) {
    SentArm arm(30);
    for (int i = 0; i < count; ++i) arm.add("P" + std::to_string(i), arm.somewhere(), Eigen::Vector3d(kError_m, 0, 0));
    const Certificate certificate = certificate_of(arm, run_at(1.5e-3));
    EXPECT_FALSE(certificate.before.mean_mm);
    EXPECT_NEAR(*certificate.after.mean_mm, 1e3 * kError_m, 1e-6);
    EXPECT_FALSE(certificate.poses.front().before_mm);
    EXPECT_TRUE(remarks_on(certificate, "no errors before are stated"));
  }
}

TEST(Certificate, ClaimsNothingOfWhereOtherDataAreFrom) {
  SentArm arm(24);
  add_others(arm, PoseSet::accept, 8);
  EXPECT_TRUE(remarks_on(certificate_of(arm, run_at(1e-3)), "is not known here"));
  arm.data().sha256 = "of the model";
  EXPECT_FALSE(remarks_on(certificate_of(arm, run_at(1e-3)), "is not known here"));
  CalibratedModel stations = model_of(arm);
  stations.data_sha256 = "of both";
  stations.stations = {{"a", "of another", Eigen::Isometry3d::Identity()},
                       {"b", "of the model", Eigen::Isometry3d::Identity()}};
  EXPECT_TRUE(is_calibrated_with(stations, arm.data()));
}

/// As poses are divided where their file does not say how.
void draw_sets(SentArm& arm) {
  for (std::size_t i = 0; i < arm.data().poses.size(); ++i)
    arm.data().poses[i].set = i % 3 == 0 ? PoseSet::validation : PoseSet::calibration;
}

TEST(Certificate, SaysThatOrientationIsNotJudged) {
  SentArm arm(31);
  add_others(arm, PoseSet::accept, 8);
  EXPECT_TRUE(remarks_on(certificate_of(arm, run_at(1e-3)), "Orientation was not judged"));
  for (MeasuredPose& pose : arm.data().poses) pose.orientation = Eigen::Quaterniond::Identity();
  EXPECT_TRUE(remarks_on(certificate_of(arm, run_at(1e-3)), "Orientations were measured but are not judged"));
}

TEST(Certificate, SaysOnlyOfTheModelsOwnPosesThatTheyHadAPartInIt) {
  SentArm arm(33);
  add_others(arm, PoseSet::validation, 8);
  add_others(arm, PoseSet::calibration, 12);
  const Certificate other = certificate_of(arm, run_at(1e-3));
  EXPECT_FALSE(remarks_on(other, "took part in the choice"));
  EXPECT_TRUE(remarks_on(other, "no accept poses: the validation poses are judged."));
  EXPECT_TRUE(remarks_on(other, "is not known here"));
  arm.data().sha256 = "of the model";
  const Certificate own = certificate_of(arm, run_at(1e-3));
  EXPECT_TRUE(remarks_on(own, "took part in the choice"));
  EXPECT_FALSE(remarks_on(own, "is not known here"));
}

TEST(Certificate, ProvesNothingByPosesThatHadAPartInTheModelWhateverTheirFile) {
  SentArm arm(35);
  add_others(arm, PoseSet::calibration, 80);
  CalibratedModel model = model_of(arm);
  model.pose_marks = pose_marks(arm.data());
  for (MeasuredPose& pose : arm.data().poses) pose.set = PoseSet::accept;
  const Certificate known = make_certificate(model, arm.data(), run_at(1e-2));
  EXPECT_EQ(known.judgement.verdict, Conformity::undecided);
  EXPECT_TRUE(remarks_on(known, "hold poses that had a part in it"));
  for (MeasuredPose& pose : arm.data().poses) *pose.position_m += Eigen::Vector3d(1e-6, 0.0, 0.0);
  const Certificate measured_anew = make_certificate(model, arm.data(), run_at(1e-2));
  EXPECT_EQ(measured_anew.judgement.verdict, Conformity::conformity);
  EXPECT_TRUE(remarks_on(measured_anew, "none of the 32 poses"));
}

TEST(Certificate, JudgesAllPosesOfOtherDataThatStateNoSets) {
  SentArm arm(34);
  add_others(arm, PoseSet::accept, 21);
  draw_sets(arm);
  CertifiedRun run = run_at(1e-3);
  run.sets_stated = false;
  const Certificate whole = certificate_of(arm, run);
  EXPECT_EQ(whole.judged_rows, 21U);
  EXPECT_EQ(whole.judged_set, "accept");
  EXPECT_TRUE(remarks_on(whole, "state no sets and are not those of the model: all poses are judged"));
  EXPECT_FALSE(remarks_on(whole, "took part in the choice"));
  run.refit_base = true;
  const Certificate refitted = certificate_of(arm, run);
  EXPECT_EQ(refitted.judged_rows, 7U) << "the others tell where the base is";
  EXPECT_TRUE(remarks_on(refitted, "which poses are judged was drawn"));
  run.refit_base = false;
  arm.data().sha256 = "of the model";
  const Certificate own = certificate_of(arm, run);
  EXPECT_EQ(own.judged_rows, 7U);
  EXPECT_TRUE(remarks_on(own, "took part in the choice"));
}

TEST(Certificate, TakesNothingOfTheDayFromTheModel) {
  SentArm arm(25);
  CalibratedModel model = model_of(arm);
  model.certificate.texts = {
      {"date", "2025-01-31"}, {"certificate_number", "K1"}, {"operator", "A"},      {"environment", "B"},
      {"place", "C"},         {"instrument", "D"},          {"serial_number", "1"}, {"customer", "E"}};
  CertificateFields of_data;
  of_data.texts = {{"serial_number", "2"}};
  std::vector<std::string> notes;
  const CertificateFields other = stated_fields(of_data, model, arm.data(), notes);
  for (const char* const key : {"date", "certificate_number", "operator", "environment", "place"})
    EXPECT_EQ(other.text(key), "") << key;
  EXPECT_EQ(other.text("customer"), "E");
  EXPECT_EQ(other.text("serial_number"), "2");
  ASSERT_EQ(notes.size(), 2U);
  EXPECT_NE(notes[0].find("serial number 2"), std::string::npos);
  EXPECT_NE(notes[1].find("Customer, Measuring instrument"), std::string::npos);
  arm.data().sha256 = model.data_sha256;
  notes.clear();
  EXPECT_EQ(stated_fields(of_data, model, arm.data(), notes).text("date"), "2025-01-31");
  EXPECT_TRUE(notes.empty());
}

TEST(Certificate, TakesTheNoiseFromRepeatsWhereThereAreAny) {
  SentArm arm(26);
  constexpr double kNoise_m = 2e-5;
  for (int i = 0; i < 8; ++i) {
    const JointVector joints = arm.somewhere();
    for (const double sign : {1.0, -1.0})
      arm.add("P" + std::to_string(i), joints, sign * kNoise_m * Eigen::Vector3d::UnitX());
  }
  const Certificate repeated = certificate_of(arm, run_at(1e-3));
  // Of two repeats 2 d apart, d each from their mean: 2 d^2 / 3, and the mean of the two has half of that.
  EXPECT_NEAR(repeated.judgement.guard_above_m, 2.0 * kNoise_m * std::sqrt(2.0 / 3.0) / std::sqrt(2.0), 1e-9);
  EXPECT_FALSE(remarks_on(repeated, "holds the model's error too"));
  SentArm once(27);
  add_others(once, PoseSet::accept, 8);
  const Certificate single = certificate_of(once, run_at(1e-3));
  EXPECT_NEAR(single.judgement.guard_above_m, 8e-4, 1e-12);
  EXPECT_TRUE(remarks_on(single, "holds the model's error too"));
}

TEST(Certificate, StatesNoCorrectedPositionWherePosesDoNotKeepToTheirRadii) {
  SentArm arm(29);
  add_others(arm, PoseSet::calibration, 8);
  for (int i = 0; i < 20; ++i) arm.add("P" + std::to_string(i), arm.somewhere(), Eigen::Vector3d(kError_m, 0, 0));
  CalibratedModel model = model_of(arm);
  model.posterior = Posterior{};
  model.interval->quantile = 2.8;
  model.interval->noise_m = 2.0 * kError_m / model.interval->quantile;
  const Certificate kept = make_certificate(model, arm.data(), run_at(2e-3));
  EXPECT_TRUE(kept.uncertainty);
  EXPECT_FALSE(remarks_on(kept, "something that it does not know"));

  model.interval->noise_m = 0.5 * kError_m / model.interval->quantile;
  const Certificate beyond = make_certificate(model, arm.data(), run_at(2e-3));
  EXPECT_FALSE(beyond.uncertainty);
  EXPECT_TRUE(remarks_on(beyond, "Only 0 of 20 accept poses lie within the radius"));
}

TEST(Certificate, SaysWhereTheModelWasMeasuredAlongAPath) {
  SentArm arm(29);
  add_others(arm, PoseSet::accept, 8);
  CalibratedModel model = model_of(arm);
  model.posterior = Posterior{};
  EXPECT_FALSE(remarks_on(make_certificate(model, arm.data(), run_at(1e-3)), "along a path"));
  model.interval->along_path = true;
  EXPECT_TRUE(remarks_on(make_certificate(model, arm.data(), run_at(1e-3)), "follow each other along a path"));
}

TEST(Certificate, SaysWhatLiesOutsideAndWhatWasLeftOut) {
  SentArm arm(28);
  add_others(arm, PoseSet::accept, 8);
  CalibratedModel model = model_of(arm);
  for (int joint = 0; joint < 6; ++joint) model.measured.push_back({-0.01, 0.01});
  for (int i = 0; i < 12; ++i) {
    arm.data().excluded.push_back(arm.data().poses.front());
    arm.data().excluded.back().pose_id = "X" + std::to_string(i);
  }
  CertifiedRun run = run_at(1e-3);
  run.notes = {"noted before"};
  const Certificate certificate = make_certificate(model, arm.data(), run);
  EXPECT_TRUE(remarks_on(certificate, "8 of the 8 measurements lie outside"));
  EXPECT_TRUE(remarks_on(certificate, "12 measurements are excluded in the data set's file: X0, X1, "));
  EXPECT_TRUE(remarks_on(certificate, "X9 and others."));
  EXPECT_TRUE(remarks_on(certificate, "noted before"));
  EXPECT_TRUE(remarks_on(certificate, "what is not corrected errs as before"));
}

}  // namespace
}  // namespace demecal
