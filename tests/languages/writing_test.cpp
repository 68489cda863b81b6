// Programs that are written are read back with the same targets in the same order.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kinematics/random_arm.hpp"
#include "languages/languages.hpp"
#include "parsed_programs/language.hpp"

namespace demecal {
namespace {

TEST(WrittenPrograms, AreReadBackAsTheyWereMeant) {
  RandomStream random{9201};
  const Chain arm = wrist_arm();
  std::vector<ProgrammedStop> stops;
  for (int i = 1; i <= 9; ++i)
    stops.push_back({(i % 2 == 0 ? "P" : "A") + std::to_string(i), random_joints(random, arm), i % 2 == 0});
  int written = 0;
  for (const Language& language : all_languages()) {
    if (language.write == nullptr) continue;
    SCOPED_TRACE(language.name);
    const std::string text = language.write(stops, arm);
    const std::string file = "program." + std::string(written_ending(language));
    EXPECT_EQ(recognize_language(text, file), &language);
    const Program program = read_program(language, text, file, arm);
    EXPECT_TRUE(program.uncorrected.empty());
    ASSERT_EQ(program.targets.size(), stops.size());
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const std::vector<double> joints = inside(program.targets[i].joints);
      for (std::size_t k = 0; k < joints.size(); ++k)
        EXPECT_NEAR(joints[k], stops[i].joints[static_cast<Eigen::Index>(k)], 1e-6);
    }
    ++written;
  }
  EXPECT_GE(written, 5);
}

TEST(WrittenPrograms, AreNotWrittenForArmsThatALanguageHasNoTargetsOf) {
  RandomStream random{9202};
  const Chain arm = random_arm(random, 7, Convention::standard_dh);
  const std::vector<ProgrammedStop> stops{{"P1", random_joints(random, arm), true}};
  for (const Language& language : all_languages()) {
    if (language.write == nullptr) continue;
    const std::string text = language.write(stops, arm);
    if (text.empty()) continue;
    EXPECT_EQ(read_program(language, text, "a", arm).targets.size(), 1u) << language.name;
  }
}

}  // namespace
}  // namespace demecal
