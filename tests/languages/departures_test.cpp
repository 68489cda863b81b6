// DEPART of VAL II and AS: which location it leaves, and what is said where that is not told.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

const std::string kValPoint = ".END\n.LOCATIONS\np 1 0 0 0 1 0 0 0 1 400 0 300\n.END\n",
                  kAsPoint = ".END\n.TRANS\np 400 0 300 0 0 0\n.END\n";

Program read_motions(WrittenIn language, const std::string& motions) {
  return read_program(language, ".PROGRAM m()\n" + motions + (language == WrittenIn::val2 ? kValPoint : kAsPoint), "p",
                      wrist_arm());
}

TEST(Departures, LeadToAPlaceNearTheLocationThatTheyLeave) {
  const auto expect_near = [](WrittenIn language, const std::string& move, const std::string& depart, Motion motion) {
    const std::string motions = " " + move + " p\n " + depart + " 50\n";
    const Program program = read_motions(language, motions);
    ASSERT_EQ(program.targets.size(), 1U);
    const auto& places = program.targets[0].near_motions;
    ASSERT_EQ(places.size(), 1U) << motions;
    EXPECT_EQ(places.begin()->second.motion, motion) << motions;
    EXPECT_TRUE(places.begin()->second.shift_m->isApprox(Eigen::Vector3d(0.0, 0.0, -0.05))) << motions;
    EXPECT_THAT(program.uncorrected, ::testing::IsEmpty());
  };
  expect_near(WrittenIn::val2, "MOVES", "DEPART", Motion::joints);
  expect_near(WrittenIn::val2, "MOVE", "DEPARTS", Motion::line);
  expect_near(WrittenIn::kawasaki_as, "JMOVE", "JDEPART", Motion::joints);
  expect_near(WrittenIn::kawasaki_as, "LMOVE", "LDEPART", Motion::line);
}

TEST(Departures, FromElsewhereLeaveTheArmWhereNoLocationSays) {
  for (const std::string before :
       {"", " APPRO p, 20\n", " MOVE p\n TOOL t\n", " MOVE p\n HERE p\n", " MOVE p\n DRIVE 1,5,9\n",
        " MOVE p\n10 TYPE 1\n IF x THEN\n GOTO 10\n END\n DEPART 9\n GOTO 10\n"}) {
    const std::string motions = before + " DEPARTS 50\n MOVES p\n";
    const Program program = read_motions(WrittenIn::val2, motions);
    const std::size_t at = (".PROGRAM m()\n" + motions).find("DEPARTS");
    EXPECT_THAT(program.joints_lost_at, Contains(at)) << motions;
    EXPECT_THAT(program.uncorrected,
                Contains(::testing::Field(&Remark::sentence, HasSubstr("the motion of departs leaves"))))
        << motions;
  }
}

TEST(Departures, FarFromTheirLocationAreSaid) {
  EXPECT_THAT(read_motions(WrittenIn::val2, " MOVE p\n DEPART 300\n").remarks,
              Contains(::testing::Field(&Remark::sentence, HasSubstr("300 mm away from it"))));
}

}  // namespace
}  // namespace demecal
