// Conformity is proved only of what was judged: single motions, places of their own, enough of them.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "acceptance/certificate.hpp"
#include "acceptance/verdict.hpp"
#include "sent_certificate.hpp"

namespace demecal {
namespace {

TEST(Proof, JudgesSingleMeasurementsAndNotTheirMean) {
  SentArm arm(35);
  for (int i = 0; i < 80; ++i) {
    const JointVector joints = arm.somewhere();
    for (const double sign : {1.0, -1.0, 1.0, -1.0})
      arm.add("P" + std::to_string(i), joints, sign * kError_m * Eigen::Vector3d::UnitX());
  }
  const Certificate close = certificate_of(arm, run_at(0.8 * kError_m));
  EXPECT_EQ(close.judgement.verdict, Conformity::undecided);
  EXPECT_EQ(close.judgement.beyond, 80U);
  EXPECT_TRUE(close.poses.front().beyond);
  EXPECT_NEAR(*close.poses.front().after_mm, 0.0, 1e-9) << "AP is of the mean";
  EXPECT_NEAR(*close.poses.front().single_mm, 1e3 * kError_m, 1e-9);
  const Certificate wide = certificate_of(arm, run_at(1.1 * kError_m));
  EXPECT_EQ(wide.judgement.verdict, Conformity::conformity);
  EXPECT_TRUE(remarks_on(wide, "95 % of its single measurements keep within"));
}

TEST(Proof, ProvesNothingByPosesAtTheJointsOfTheFit) {
  SentArm arm(36), apart(36);
  for (int i = 0; i < 80; ++i) {
    const JointVector joints = arm.somewhere();
    for (SentArm* const one : {&arm, &apart}) {
      one->add("C" + std::to_string(i), joints, Eigen::Vector3d::Zero()).set = PoseSet::calibration;
      one->add("A" + std::to_string(i), one == &arm ? joints : arm.somewhere(), Eigen::Vector3d::Zero());
    }
  }
  EXPECT_EQ(certificate_of(apart, run_at(kError_m)).judgement.verdict, Conformity::conformity);
  const Certificate certificate = certificate_of(arm, run_at(kError_m));
  EXPECT_EQ(certificate.judgement.verdict, Conformity::undecided);
  EXPECT_EQ(verdict_sentence(certificate).find("Undecided: the accept poses stand at the joints of calibration"), 0U)
      << verdict_sentence(certificate);
  EXPECT_EQ(remedy_sentence(certificate), "Measure accept poses of their own.");
}

TEST(Proof, SaysFirstWhatAProofWithFewPosesRestsOn) {
  for (const auto& [poses, words] :
       std::vector<std::pair<int, std::string>>{{2, "Undecided: so few prove nothing of others"},
                                                {40, "Conformity proved if errors are normally distributed: "},
                                                {80, "Conformity proved: "}}) {
    SentArm arm(37);
    add_others(arm, PoseSet::accept, poses);
    const std::string sentence = verdict_sentence(certificate_of(arm, run_at(kError_m)));
    EXPECT_EQ(sentence.find(words), 0U) << sentence;
  }
}

TEST(Proof, StatesALargerUncertaintyOutsideTheMeasuredJoints) {
  SentArm arm(38);
  add_others(arm, PoseSet::accept, 30);
  CalibratedModel model = model_of(arm);
  model.posterior = Posterior{};
  model.interval->quantile = 2.8;  // of measured errors: a corrected position is judged by that of normal ones
  model.interval->model_error_m = kError_m;
  const auto expanded_mm = [&] {
    return *make_certificate(model, arm.data(), run_at(kError_m)).uncertainty->expanded_mm;
  };
  const double inside_mm = expanded_mm();
  EXPECT_NEAR(inside_mm, 2.7954834829151, 1e-9);  // three axes, 95 %
  model.measured.assign(6, {-0.01, 0.01});
  EXPECT_GT(expanded_mm(), 3.0 * inside_mm);
}

}  // namespace
}  // namespace demecal
