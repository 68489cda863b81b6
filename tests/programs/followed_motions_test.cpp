// Where the arm comes from in programs that branch, repeat and jump: the side of approach and the configuration that a
// target is corrected for are those of all the ways that lead to it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>

#include "named_motions.hpp"

namespace demecal {
namespace {

/// The same program in several languages.
using InLanguages = std::map<WrittenIn, std::string>;

const InLanguages kLoop{{WrittenIn::rapid, "@LOW\nWHILE TRUE DO\n@MIDDLE\n@HIGH\nENDWHILE\n"},
                        {WrittenIn::krl, "@LOW\nLOOP\n@MIDDLE\n@HIGH\nENDLOOP\n"},
                        {WrittenIn::urscript, "@LOW\nwhile True:\n@MIDDLE\n@HIGH\nend\n"},
                        {WrittenIn::kawasaki_as, "@LOW\nWHILE SIG(1) DO\n@MIDDLE\n@HIGH\nEND\n"}};
const InLanguages kLoopFromOneSide{{WrittenIn::krl, "@LOW\nLOOP\n@MIDDLE\n@LOW\nENDLOOP\n"},
                                   {WrittenIn::urscript, "@LOW\nwhile True:\n@MIDDLE\n@LOW\nend\n"},
                                   {WrittenIn::kawasaki_as, "@LOW\nWHILE SIG(1) DO\n@MIDDLE\n@LOW\nEND\n"}};
const InLanguages kSkipped{{WrittenIn::rapid, "@LOW\nIF DInput(d)=1 @HIGH\n@MIDDLE\n"},
                           {WrittenIn::krl, "@LOW\nWHILE $IN[1]\n@HIGH\nENDWHILE\n@MIDDLE\n"},
                           {WrittenIn::urscript, "@LOW\nif f:\n@HIGH\nend\n@MIDDLE\n"},
                           {WrittenIn::kawasaki_as, "@LOW\nIF SIG(1) THEN\n@HIGH\nEND\n@MIDDLE\n"}};
const InLanguages kBackwards{{WrittenIn::rapid, "@LOW\nagain:\n@MIDDLE\n@HIGH\nGOTO again;\n"},
                             {WrittenIn::krl, "@LOW\nagain:\n@MIDDLE\n@HIGH\nGOTO again\n"},
                             {WrittenIn::kawasaki_as, "@LOW\n10 @MIDDLE\n@HIGH\nGOTO 10\n"}};
const InLanguages kForwards{{WrittenIn::krl, "@LOW\nIF $IN[1] THEN\nGOTO on\nENDIF\n@HIGH\non:\n@MIDDLE\n"},
                            {WrittenIn::kawasaki_as, "@LOW\nIF SIG(1) GOTO 10\n@HIGH\n10 @MIDDLE\n"}};
const InLanguages kLeft{{WrittenIn::krl, "@HIGH\nLOOP\n@LOW\nIF $IN[1] THEN\nEXIT\nENDIF\n@HIGH\nENDLOOP\n@MIDDLE\n"},
                        {WrittenIn::urscript, "@HIGH\nwhile True:\n@LOW\nif f:\nbreak\nend\n@HIGH\nend\n@MIDDLE\n"}};
const InLanguages kBranchesFromOneSide{
    {WrittenIn::rapid, "@HIGH\nTEST n\nCASE 1:\n@LOW\nDEFAULT:\n@MIDDLE\nENDTEST\n"},
    {WrittenIn::krl, "@HIGH\nIF $IN[1] THEN\n@MIDDLE\nELSE\nHALT\nENDIF\n"},
    {WrittenIn::urscript, "@HIGH\nif f:\n@LOW\nelse:\n@MIDDLE\nend\n"},
    {WrittenIn::kawasaki_as, "@HIGH\nCASE n OF\nVALUE 1:\n@LOW\nVALUE 2:\n@MIDDLE\nEND\n"}};

/// The side from which joint 1 comes there.
std::vector<double> sides(const InLanguages& programs, const std::string& place = "MIDDLE") {
  const CommandModel model = lost_motion_model();
  std::vector<double> found;
  for (const auto& [language, lines] : programs) {
    const CorrectedProgram corrected = corrected_motions(language, lines, model);
    found.push_back(corrected.targets.at(index_of(corrected, place)).stop.approach[0]);
  }
  return found;
}

TEST(Approach, IsThatOfEveryWayThatLeadsToTheTarget) {
  EXPECT_THAT(sides(kLoop), ::testing::Each(0.0)) << "from the last motion, from the second round on";
  EXPECT_THAT(sides(kSkipped), ::testing::Each(0.0)) << "the loop or branch may be skipped";
  EXPECT_THAT(sides(kBackwards), ::testing::Each(0.0));
  EXPECT_THAT(sides(kForwards), ::testing::Each(0.0));
  EXPECT_THAT(sides(kLoopFromOneSide), ::testing::Each(1.0)) << "every round from the same side";
  EXPECT_THAT(sides(kLeft), ::testing::Each(1.0)) << "only from where the loop is left";
  EXPECT_THAT(sides(kBranchesFromOneSide), ::testing::Each(-1.0)) << "alternatives begin where the branch does";
}

/// Where the joints of POSE come from, and what is said of it: nothing where it is corrected.
std::vector<std::string> postures(const InLanguages& programs) {
  RandomStream stream{7561};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  std::vector<std::string> found;
  for (const auto& [language, lines] : programs) {
    const CorrectedProgram corrected = corrected_motions(language, lines, model);
    const std::size_t pose = index_of(corrected, "POSE");
    const CorrectedTarget& target = corrected.targets.at(pose);
    found.push_back(target.is_uncorrected() ? "left" : std::string(to_string(target.from)));
    for (const Remark& warning : corrected.warnings) {
      if (warning.place.line == corrected.program.targets[pose].place.line) found.back() += ": " + warning.sentence;
    }
  }
  return found;
}

InLanguages with_poses(InLanguages programs) {
  programs.erase(WrittenIn::rapid);  // its poses state their configuration
  for (auto& [language, lines] : programs) {
    for (const auto& [from, to] : {std::pair{"LOW", "NEAR"}, {"MIDDLE", "POSE"}, {"HIGH", "FLIPPED"}}) {
      for (std::size_t at = lines.find(from); at != std::string::npos; at = lines.find(from, at + 1))
        lines.replace(at, std::string_view(from).size(), to);
    }
  }
  return programs;
}

TEST(Configuration, IsThatOfEveryWayThatLeadsToTheTarget) {
  for (const InLanguages& programs : {kLoop, kSkipped, kBackwards, kForwards})
    EXPECT_THAT(postures(with_poses(programs)),
                ::testing::Each(::testing::StartsWith("left: the arm's configuration")));
  for (const InLanguages& programs : {kLoopFromOneSide, kLeft, kBranchesFromOneSide})
    EXPECT_THAT(postures(with_poses(programs)), ::testing::Each("joints_before")) << "nothing is said";
}

TEST(Approach, IsNotKnownBehindATargetWhoseJointsAreNot) {
  InLanguages unknown = with_poses(kSkipped), known = unknown;
  for (auto& [language, lines] : unknown) lines += "@HIGH\n";
  for (auto& [language, lines] : known) lines = "@NEAR\n@POSE\n@HIGH\n";
  EXPECT_THAT(sides(unknown, "HIGH"), ::testing::Each(0.0));
  EXPECT_THAT(sides(known, "HIGH"), ::testing::Each(1.0));
}

TEST(Configuration, OfAPointThatIsMovedToAgainIsThatOfEveryMotion) {
  const auto of = [](const std::string& other) -> InLanguages {
    return {{WrittenIn::urscript, "pt=" + std::string("%") + "\n@NEAR\nmovej(pt)\n@" + other + "\nmovej(pt)\n"},
            {WrittenIn::kawasaki_as, "@NEAR\nJMOVE pt\n@" + other + "\nJMOVE pt\n.END\n.TRANS\npt %\n"}};
  };
  RandomStream stream{7561};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const auto judged = [&](InLanguages programs) {
    for (auto& [language, lines] : programs) {
      std::string place = place_named(language, "POSE", model);
      if (language == WrittenIn::kawasaki_as) place = place.substr(6, place.size() - 7);
      lines.replace(lines.find('%'), 1, place);
    }
    return postures(programs);
  };
  EXPECT_THAT(judged(of("FLIPPED")), ::testing::Each(::testing::AllOf(::testing::StartsWith("left: line "),
                                                                      ::testing::HasSubstr("another configuration"))));
  EXPECT_THAT(judged(of("NEAR")), ::testing::Each("joints_before"));
}

/// The sides from which the location of this name in a program of AS is come to, which moves from NEAR as `motions`
/// say; "pt" is the place of POSE, "before" that 80 mm before it, "between" that 40 mm before it.
ApproachSigns sides_behind(const std::string& motions, const std::string& of = "pt") {
  RandomStream stream{7561};
  const CommandModel model = erring_model(stream, elbow_arm(stream));
  const auto location = [&](const std::string& name, double before_m) {
    const Eigen::Isometry3d pose = model.nominal_tool(joints_named("POSE")) * Eigen::Translation3d(0.0, 0.0, -before_m);
    return name + ' ' + listed(six_numbers(pose, pose.linear().eulerAngles(2, 1, 2)), 9, ",") + '\n';
  };
  const CorrectedProgram corrected =
      corrected_motions(WrittenIn::kawasaki_as,
                        "@NEAR\n" + motions + ".END\n.TRANS\n" + location("before", 0.08) + location("between", 0.04) +
                            location("pt", 0.0),
                        model);
  const auto last = std::ranges::find(corrected.program.targets, of, &Target::name);
  const CorrectedTarget& target =
      corrected.targets.at(static_cast<std::size_t>(last - corrected.program.targets.begin()));
  EXPECT_FALSE(target.is_uncorrected()) << motions;
  return target.stop.approach;
}

TEST(Approach, OfAPointBehindAPlaceNearItIsThatFromThere) {
  const ApproachSigns written_out = sides_behind("JMOVE before\nLMOVE pt\n");
  EXPECT_EQ(sides_behind("JAPPRO pt,80\nLMOVE pt\n"), written_out);
  EXPECT_NE(sides_behind("LMOVE pt\n"), written_out) << "the place before it matters";
  EXPECT_TRUE(sides_behind("JAPPRO pt,d\nLMOVE pt\n").isZero()) << "the distance is not told";
  EXPECT_EQ(sides_behind("LMOVE pt\nJAPPRO pt,80\n"), sides_behind("LMOVE pt\n")) << "it leaves from there";
}

TEST(Approach, BehindADepartureIsThatFromThePlaceThatItLeadsTo) {
  const auto sides_of = [](const std::string& motions) { return sides_behind(motions + "LMOVE between\n", "between"); };
  const ApproachSigns written_out = sides_of("LMOVE pt\nLMOVE before\n");
  EXPECT_EQ(sides_of("LMOVE pt\nLDEPART 80\n"), written_out);
  EXPECT_NE(sides_of("LMOVE pt\n"), written_out) << "the place that it leads to matters";
  EXPECT_TRUE(sides_of("LMOVE pt\nLDEPART d\n").isZero()) << "the distance is not told";
}

/// What is said of the program as a whole.
std::vector<std::string> said_of_sides(const InLanguages& programs) {
  const CommandModel model = lost_motion_model();
  std::vector<std::string> found;
  for (const auto& [language, lines] : programs) {
    found.emplace_back();
    for (const Remark& warning : corrected_motions(language, lines, model).warnings) found.back() += warning.sentence;
  }
  return found;
}

TEST(Approach, IsSaidOnceWhereItIsNotKnownAndMatters) {
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  for (const InLanguages& programs : {kLoop, kSkipped, kBackwards, kForwards})
    EXPECT_THAT(said_of_sides(programs),
                ::testing::Each(AllOf(HasSubstr("depends on the way there"), HasSubstr("mm apart"))));
  EXPECT_THAT(said_of_sides({{WrittenIn::krl, "@LOW\n@MIDDLE\n"}}), ::testing::Each(HasSubstr("line 2 is not told")));
  EXPECT_THAT(said_of_sides({{WrittenIn::urscript, "@LOW\n@MIDDLE\n"}}),
              ::testing::Each(HasSubstr("line 2 is not told")));
  for (const InLanguages& programs : {kLoopFromOneSide, kBranchesFromOneSide})
    EXPECT_THAT(said_of_sides(programs),
                ::testing::Each(AllOf(HasSubstr(" is not told"), ::testing::Not(HasSubstr("depends on the way")))));
}

TEST(Approach, IsNotSaidWhereTheModelItselfIsLessSure) {
  CommandModel model = lost_motion_model();
  model.posterior.emplace();
  model.posterior->ids = {{.kind = ParameterId::Kind::link, .index = 1, .link = LinkParameter::theta}};
  model.posterior->factor = Eigen::MatrixXd::Constant(1, 1, 1e-7);
  model.interval.emplace();
  model.interval->quantile = 1.6;
  for (const bool sure : {true, false}) {
    model.interval->model_error_m = sure ? 1e-5 : 3e-3;
    const CorrectedProgram corrected = corrected_motions(WrittenIn::krl, "@LOW\n@MIDDLE\n", model);
    const CorrectedTarget& first = corrected.targets.at(index_of(corrected, "LOW"));
    EXPECT_GT(first.unknown_side_m, 1e-4);
    EXPECT_GT(first.error95_m.value_or(0.0), 0.5 * first.unknown_side_m) << "its radius says so in any case";
    const auto is_said = [](const Remark& warning) {
      return warning.sentence.find("line 2 is not told") != std::string::npos;
    };
    EXPECT_EQ(std::ranges::any_of(corrected.warnings, is_said), sure);
  }
}

}  // namespace
}  // namespace demecal
