// Orientations in every form that programs write, there and back; and a program's files as one text.
#include "parsed_programs/orientation.hpp"

#include <gtest/gtest.h>

#include <string>

#include "../kinematics/random_arm.hpp"
#include "parsed_programs/program.hpp"
#include "parsed_programs/program_text.hpp"

namespace demecal {
namespace {

constexpr OrientationForm kWritten[] = {OrientationForm::quaternion,       OrientationForm::zyx_angles,
                                        OrientationForm::fixed_xyz_angles, OrientationForm::xyz_angles,
                                        OrientationForm::zyz_angles,       OrientationForm::rotation_vector};

std::size_t count_of(OrientationForm form) {
  return form == OrientationForm::quaternion ? 4 : 3;
}

TEST(Orientation, IsTheSameAfterItWasWrittenInAnyForm) {
  RandomStream random({5, 1});
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d rotation = random_place(random).linear();
    for (const OrientationForm form : kWritten) {
      const std::vector<double> numbers = numbers_of(rotation, form, std::vector<double>(count_of(form), 0.1));
      EXPECT_LT((rotation_from(form, numbers) - rotation).cwiseAbs().maxCoeff(), 1e-9) << static_cast<int>(form);
    }
  }
}

TEST(Orientation, KeepsTheNumbersThatAlreadyWriteIt) {
  RandomStream random({5, 2});
  for (int i = 0; i < 200; ++i) {
    const Eigen::Matrix3d rotation = random_place(random).linear();
    for (const OrientationForm form : kWritten) {
      std::vector<double> written = numbers_of(rotation, form, std::vector<double>(count_of(form), 0.1));
      if (form == OrientationForm::quaternion)
        for (double& number : written) number = -number;  // the same rotation
      const std::vector<double> again = numbers_of(rotation, form, written);
      for (std::size_t k = 0; k < written.size(); ++k) EXPECT_NEAR(again[k], written[k], 1e-7);
    }
  }
}

TEST(ProgramSource, TellsOfEveryByteWhichFileItIsOf) {
  const std::vector<ProgramFile> files{{"a.src", "one\ntwo"}, {"a.dat", "\xEF\xBB\xBFthree"}, {"b.dat", ""}};
  const ProgramSource source(files);
  for (std::size_t file = 0; file < files.size(); ++file) {
    for (std::size_t i = 0; i < files[file].text.size(); ++i)
      EXPECT_EQ(source.file_at(source.begin(file) + i), file) << files[file].name << " " << i;
  }
  EXPECT_EQ(source.text().find("\xEF\xBB\xBF"), std::string::npos) << "a mark within the text would be no blank";
  EXPECT_EQ(source.text().substr(source.begin(1) + 3, 5), "three");
}

TEST(ControllerData, SaysOfAFrameThatItIsNotGiven) {
  ControllerData controller;
  controller.frames["cell"] = Eigen::Isometry3d(Eigen::Translation3d(0.1, 0.2, 0.3));
  const KnownFrame given = controller.frame("CELL", "frame CELL");
  EXPECT_TRUE(given.unknown.empty());
  EXPECT_EQ(given.pose.translation(), Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_NE(controller.frame("other", "frame OTHER").unknown.find("frame OTHER is given neither"), std::string::npos);
  EXPECT_FALSE(controller.tool("cell", "tool CELL").unknown.empty()) << "tools are kept apart from frames";
}

}  // namespace
}  // namespace demecal
