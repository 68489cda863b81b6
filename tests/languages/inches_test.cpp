// Applications of VAL3 that count in inches, as their project file says: points are left, since only millimetres are
// read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kinematics/random_arm.hpp"
#include "languages/reading_checks.hpp"

namespace demecal {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string kPlaces =
    "<Database><Datas>\n<Data name=\"p\" type=\"pointRx\"><Value key=\"0\" x=\"1\" y=\"2\" z=\"3\" rx=\"0\" ry=\"0\" "
    "rz=\"0\" fatherId=\"world[0]\"/></Data>\n<Data name=\"j\" type=\"jointRx\"><Value key=\"0\" j1=\"1\" j2=\"2\" "
    "j3=\"3\" j4=\"4\" j5=\"5\" j6=\"6\"/></Data>\n<Data name=\"t\" type=\"tool\"><Value key=\"0\" z=\"4\"/></Data>"
    "</Datas></Database>\n";

std::string project(const std::string& millimetres, const std::string& data = "app.dtx") {
  return "<Project><Parameters version=\"s7\" millimeterUnit=\"" + millimetres + "\"/><Database><Data file=\"" + data +
         "\" /></Database></Project>\n";
}

Program with_applications(std::vector<ProgramFile> applications, std::vector<ProgramFile> further = {}) {
  std::vector<ProgramFile> files{{"cell/app.dtx", kPlaces}};
  files.insert(files.end(), further.begin(), further.end());
  const ProgramSource source(files);
  return read_program(row_of(WrittenIn::val3), source, wrist_arm(), {.applications = std::move(applications)});
}

void expect_points_left(const Program& program, const std::string& where) {
  EXPECT_THAT(names(program), ElementsAre("j[0]"));
  ASSERT_EQ(program.uncorrected.size(), 1U);
  EXPECT_EQ(program.uncorrected.front().name, "p[0]");
  EXPECT_THAT(program.uncorrected.front().sentence,
              AllOf(HasSubstr("counts in inches (millimeterUnit=\"false\"" + where + ")"), HasSubstr("left as it is")));
  EXPECT_THAT(program.targets.front().frames.unknown_tool, HasSubstr("counts in inches")) << "so are tools";
}

TEST(Inches, AreToldByTheProjectBesideOrAmongTheFiles) {
  expect_points_left(with_applications({{"cell/app.pjx", project("false")}}), " in cell/app.pjx");
  expect_points_left(with_applications({}, {{"cell/app.pjx", project("false")}}), "");
}

TEST(Inches, AreNotSeenElsewhere) {
  for (const std::vector<ProgramFile>& applications :
       {std::vector<ProgramFile>{}, {{"cell/app.pjx", project("true")}}, {{"x.pjx", project("false", "other.dtx")}}}) {
    const Program program = with_applications(applications);
    EXPECT_THAT(names(program), ElementsAre("p[0]", "j[0]"));
    EXPECT_THAT(program.uncorrected, IsEmpty());
    EXPECT_THAT(program.targets.back().frames.unknown_tool, IsEmpty());
  }
}

}  // namespace
}  // namespace demecal
