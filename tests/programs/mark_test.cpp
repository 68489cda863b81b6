// The mark of corrected programs: where it stands, and that it is found again.
#include <gtest/gtest.h>

#include "programs/determined_part.hpp"
#include "programs/mark.hpp"
#include "written_program.hpp"

namespace demecal {
namespace {

TEST(Mark, IsACommentThatReadersPassOverAndASecondRunFinds) {
  const std::string mark = mark_of("1.0", "a job", "0123456789abcdef");
  EXPECT_EQ(mark, "corrected by demecal 1.0 with the model of a job (data 0123456789ab)");
  RandomStream stream{7510};
  const Chain arm = wrist_arm();
  for (const Language language : kLanguages) {
    for (const char* line_break : {"\n", "\r\n"}) {
      SCOPED_TRACE(word_of(language));
      const auto line = [&](int index) { return joints_line(language, random_joints(stream, arm), index, 4); };
      const std::string text = written(language, false, 3, line, line_break);
      EXPECT_EQ(marked_line(text), std::nullopt);
      const std::string marked = with_mark(text, language, mark);
      const auto found = marked_line(marked);
      ASSERT_TRUE(found);
      EXPECT_EQ(marked.size(), text.size() + mark.size() + 2 + std::string(line_break).size());
      EXPECT_EQ(read_program(language, marked, "p", arm).targets.size(), 3u);
    }
  }
}

TEST(Mark, StandsBehindTheHeaderOfAModule) {
  EXPECT_EQ(with_mark("&ACCESS RVP\nDEF a()\nEND\n", Language::krl, "m"), "&ACCESS RVP\nDEF a()\n; m\nEND\n");
  EXPECT_EQ(with_mark("&ACCESS RVP\nPTP {A1 0}\n", Language::krl, "m"), "&ACCESS RVP\n; m\nPTP {A1 0}\n");
  EXPECT_EQ(with_mark("%%%\n%%%\nMODULE m\nENDMODULE", Language::rapid, "m"), "%%%\n%%%\nMODULE m\n! m\nENDMODULE");
  EXPECT_EQ(with_mark("\xEF\xBB\xBFq1_deg\n1\n", Language::csv, "m"), "\xEF\xBB\xBF# m\nq1_deg\n1\n");
}

TEST(Mark, IsNoneInAString) {
  EXPECT_EQ(marked_line("textmsg(\"corrected by demecal\")\n"), std::nullopt);
  EXPECT_EQ(marked_line("a\n\n  ! corrected by demecal 2\n"), 3u);
}

TEST(DeterminedPart, IsAllOfASureCorrectionAndNoneOfAnUnsureOne) {
  const Eigen::Vector3d correction(1e-3, -2e-3, 5e-4);
  const DeterminedPart sure = determined_part(correction, 1e-12 * Eigen::Matrix3d::Identity(), 5e-5);
  EXPECT_EQ(sure.applied, correction);
  EXPECT_EQ(sure.deviation, 0.0);
  const DeterminedPart unsure = determined_part(correction, Eigen::Matrix3d::Identity(), 5e-5);
  EXPECT_TRUE(unsure.applied.isZero(0.0));
  EXPECT_DOUBLE_EQ(unsure.deviation, 1.0);
}

TEST(DeterminedPart, LeavesTheOneDirectionThatIsNotKnown) {
  const Eigen::Vector3d direction = Eigen::Vector3d(1, 2, -2).normalized();
  const Eigen::Matrix3d covariance = 1e-12 * Eigen::Matrix3d::Identity() + 1e-4 * direction * direction.transpose();
  const Eigen::Vector3d correction(1e-3, -2e-3, 5e-4);
  const DeterminedPart part = determined_part(correction, covariance, 5e-5);
  EXPECT_NEAR(std::abs(part.left.dot(direction)), 1.0, 1e-9);
  EXPECT_NEAR(part.applied.dot(direction), 0.0, 1e-9);
  EXPECT_LT((part.applied - (correction - correction.dot(direction) * direction)).norm(), 1e-9);
}

TEST(DeterminedPart, MakesAnErrorLargerAsRarelyAsItSays) {
  RandomStream stream{7511};
  int applied = 0, larger = 0;
  for (int i = 0; i < 20000; ++i) {
    const double deviation = stream.real(1e-5, 1e-3);
    Eigen::Vector3d truth, noise;
    for (double& part : truth) part = 1e-3 * stream.normal();
    for (double& part : noise) part = deviation * stream.normal();
    const DeterminedPart part =
        determined_part(truth + noise, deviation * deviation * Eigen::Matrix3d::Identity(), 5e-5);
    applied += part.applied.isZero(0.0) ? 0 : 1;
    larger += (truth - part.applied).norm() > truth.norm() ? 1 : 0;
  }
  EXPECT_GT(applied, 5000);
  EXPECT_LT(larger, 20);
}

}  // namespace
}  // namespace demecal
