// The record of checks comes back as it was written, whatever names hold.
#include "studies/change_report.hpp"

#include <gtest/gtest.h>

#include "errors/input_error.hpp"

namespace demecal {
namespace {

TEST(CheckHistory, ComesBackAsItWasWritten) {
  const std::vector<CheckRecord> records{
      {"2026-03-01", "out/model.yaml", "march, \"north\"", 12, "unchanged", 0.93, 1.41, 0.051, ""},
      {"2026-07-01", "out/model.yaml", "july", 14, "changed", 3.7, 1.4, 0.31, "joint_offset, joint 3 and tool",
       "UR5e, serial number 7", "0a1b"}};
  const std::vector<CheckRecord> read = read_check_history(check_history_csv(records), "check-history.csv");
  ASSERT_EQ(read.size(), records.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].date, records[i].date);
    EXPECT_EQ(read[i].model, records[i].model);
    EXPECT_EQ(read[i].data, records[i].data);
    EXPECT_EQ(read[i].poses, records[i].poses);
    EXPECT_EQ(read[i].verdict, records[i].verdict);
    EXPECT_EQ(read[i].strain, records[i].strain);
    EXPECT_EQ(read[i].strain_limit, records[i].strain_limit);
    EXPECT_EQ(read[i].error_mm, records[i].error_mm);
    EXPECT_EQ(read[i].cause, records[i].cause);
    EXPECT_EQ(read[i].robot, records[i].robot);
    EXPECT_EQ(read[i].model_sha256, records[i].model_sha256);
  }
  const std::string without =
      "date,verdict,strain,strain_limit,error_mm,poses,cause,data,model\nd,changed,1,2,3,4,c,a,m\n";
  ASSERT_EQ(read_check_history(without, "check-history.csv").size(), 1U) << "no robot was recorded";
  EXPECT_EQ(read_check_history(without, "check-history.csv").front().model, "m");
}

TEST(CheckHistory, TellsModelsByTheirBytesOrWhereTheseAreNotKnownByTheirFiles) {
  const auto by = [](const std::string& file, const std::string& model_sha256) {
    CheckRecord record;
    record.model = file;
    record.model_sha256 = model_sha256;
    return record;
  };
  const CheckRecord of_march = by("a/model.yaml", "01"), moved = by("b/model.yaml", "01"),
                    made_anew = by("a/model.yaml", "02"), early = by("a/model.yaml", "");
  EXPECT_TRUE(of_march.of_model_of(moved));
  EXPECT_FALSE(of_march.of_model_of(made_anew));
  EXPECT_TRUE(early.of_model_of(of_march) && early.of_model_of(made_anew));
  EXPECT_FALSE(early.of_model_of(moved));
}

TEST(CheckHistory, TellsRobotsOfOneTypeByTheirNumbers) {
  CalibratedModel model;
  model.nominal.name = "UR5e";
  EXPECT_EQ(checked_robot(model), "UR5e");
  model.certificate.texts["serial_number"] = "7";
  EXPECT_EQ(checked_robot(model), "UR5e, serial number 7");
}

TEST(CheckHistory, OfNothingIsEmptyAndOfAnotherTableRefused) {
  EXPECT_TRUE(read_check_history("", "check-history.csv").empty());
  EXPECT_THROW(read_check_history("a,b\n1,2\n", "check-history.csv"), InputError);
}

}  // namespace
}  // namespace demecal
