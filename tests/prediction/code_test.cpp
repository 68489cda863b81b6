// The files that are handed on compile by themselves and give the model's own predictions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <regex>
#include <sstream>

#include "compiled_code.hpp"
#include "kinematics/forward.hpp"
#include "kinematics/inverse.hpp"
#include "prediction/corrected_arm.hpp"
#include "prediction/random_effects.hpp"
#include "stop_at.hpp"

namespace demecal {
namespace {

/// An arm with everything that formulas can hold, and the stops at which it is judged.
struct Judged {
  CorrectedRobot robot;
  std::vector<Stop> stops;
  double reference_celsius = 0.0;  ///< above which the code counts warmth

  double warming(const Stop& stop) const { return *stop.temperature_celsius - reference_celsius; }
};

Judged judged_arm() {
  RandomStream stream{641};
  const Chain nominal = random_arm(stream, 5, Convention::modified_dh, 0.2);
  Judged judged{random_robot(stream, nominal, 1e-3, 1e-3), {}};
  judged.robot.described = heavy(stream, nominal);
  judged.robot.effects = random_effects(judged.robot.described, stream, 2e-3, 2);
  for (Effect& effect : judged.robot.effects) {
    for (const int joint : law_of(effect).ranged_joints(effect, judged.robot.described)) {
      effect.ranges[joint] = {-1.0, stream.chance(0.5) ? 1.5 : 7.0};
    }
  }
  const Tree tree =
      parse("0.001 * SQRTp(theta - 0.3) - 0.002 % (theta - -1.5) * SIGN(theta) + 0.001 * ABS(COS(theta))");
  judged.robot.corrections[0] = {tree, {true, 2.5}, {1.0, 4.0}};
  const Tree later = parse(
      "0.001 * LOGp(theta) + 0.0002 * EXPb(0.5 * theta) - 0.001 * TANH(theta) * ATAN(2 * theta) + "
      "0.0003 * SQUARE(theta - 0.5) + MIN(0.001 * theta, 0.0005) * MAX(SIN(theta), -0.25) + EXPb(900 * theta - 930)");
  judged.robot.corrections[2] = {later, {true, 0.0}, {-4.0, 4.0}};
  judged.robot.corrections[1] = {};
  for (int i = 0; i < 40; ++i) judged.stops.push_back(stop_at(stream, nominal, 1.5 * random_joints(stream, nominal)));
  Algebra algebra;
  judged.reference_celsius = corrected_arm(algebra, judged.robot, "").reference_celsius;
  return judged;
}

std::string code_in(const CorrectedRobot& robot, CodeLanguage language) {
  Algebra algebra;
  return code_of(listing_of(corrected_arm(algebra, robot, ""), robot, "An arm"), language);
}

std::string numbers(const JointVector& q, const std::string& between) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (Eigen::Index i = 0; i < q.size(); ++i) text << (i == 0 ? "" : between) << q[i];
  return text.str();
}

/// Per stop: 16 numbers of the pose, and each joint's h.
void expect_agreement(const Judged& judged, const std::string& printed) {
  std::istringstream in(printed);
  for (const Stop& stop : judged.stops) {
    const Eigen::Matrix4d pose = judged.robot.predict(stop, "").matrix();
    const JointVector actual = judged.robot.corrected_joints(stop.joints);
    for (int i = 0; i < 16; ++i) {
      double value = 0.0;
      ASSERT_TRUE(in >> value) << printed;
      EXPECT_NEAR(value, pose(i / 4, i % 4), 1e-9);
    }
    for (const double expected : actual) {
      double value = 0.0;
      ASSERT_TRUE(in >> value) << printed;
      EXPECT_NEAR(value, expected, 1e-12);
    }
  }
}

TEST(Code, InCCompilesWithoutWarningsAndAgreesWithTheModel) {
  if (!there_is("cc")) GTEST_SKIP() << "there is no C compiler called cc";
  const Judged judged = judged_arm();
  const auto n = static_cast<std::size_t>(judged.robot.chain.size());
  std::ostringstream main;
  main << "#include <stdio.h>\nstruct circumstances { double payload_kg, warming_kelvin, approach[" << n
       << "]; };\nvoid forward_at(const struct circumstances* at, const double q[" << n << "], double pose[16]);\n";
  for (std::size_t i = 1; i <= n; ++i) main << "double h" << i << "(double q);\n";
  main << "static const double stops[][" << n << "] = {";
  for (const Stop& stop : judged.stops) main << '{' << numbers(stop.joints, ",") << "},\n";
  main << "};\nstatic const struct circumstances at[] = {";
  for (const Stop& stop : judged.stops)
    main << std::setprecision(17) << '{' << stop.payload_kg << ',' << judged.warming(stop) << ",{"
         << numbers(stop.approach, ",") << "}},\n";
  main << "};\nint main(void) {\n  for (int i = 0; i < " << judged.stops.size() << "; ++i) {\n"
       << "    double pose[16];\n    forward_at(at + i, stops[i], pose);\n"
       << "    for (int k = 0; k < 16; ++k) printf(\"%.17g \", pose[k]);\n";
  for (std::size_t i = 0; i < n; ++i) main << "    printf(\"%.17g\\n\", h" << i + 1 << "(stops[i][" << i << "]));\n";
  main << "  }\n  return 0;\n}\n";

  const CodeFolder folder;
  const std::string arm = folder.write("arm.c", code_in(judged.robot, CodeLanguage::c));
  const std::string program = folder.path("program");
  int code = 0;
  const std::string said = output_of("cc -std=c99 -Wall -Wextra -Wno-missing-prototypes -Werror -o " + program + ' ' +
                                         arm + ' ' + folder.write("main.c", main.str()) + " -lm",
                                     code);
  ASSERT_EQ(code, 0) << said;
  expect_agreement(judged, output_of(program, code));
}

/// Whether the model's own inverse gets there, moving joints by at most 2.5 times what is missing, 0.3 m counting as a
/// radian: within what the code allows.
bool is_within_reach(const CorrectedRobot& robot, const Eigen::Isometry3d& goal, const Stop& stop) {
  const PoseFunction model = [&](const JointVector& joints) {
    return robot.predict_with_jacobian(stop.with_joints(joints), "");
  };
  const InverseSolution solution = inverse(model, goal, stop.joints);
  PoseError missing = pose_error(robot.predict(stop, ""), goal);
  missing.head<3>() /= 0.3;
  return solution.status == InverseStatus::converged &&
         (solution.q - stop.joints).cwiseAbs().maxCoeff() <= 2.5 * missing.norm();
}

TEST(Code, InCInvertsTheModel) {
  if (!there_is("cc")) GTEST_SKIP() << "there is no C compiler called cc";
  RandomStream stream{642};
  for (const int joints : {6, 7}) {
    const Chain nominal = random_arm(stream, joints, Convention::modified_dh, 0.2);
    CorrectedRobot robot = random_robot(stream, nominal, 1e-3, 1e-3);
    robot.described = heavy(stream, nominal);
    robot.effects = random_effects(robot.described, stream, 5e-4, 1);
    robot.corrections.assign(nominal.joints.size(), {});
    constexpr int kStops = 200;
    Judged judged{robot, {}};
    for (int i = 0; i < kStops; ++i) judged.stops.push_back(stop_at(stream, nominal, random_joints(stream, nominal)));
    Algebra algebra;
    judged.reference_celsius = corrected_arm(algebra, robot, "").reference_celsius;
    const std::string n = std::to_string(joints);
    std::ostringstream main;
    main << "#include <stdio.h>\nstruct circumstances { double payload_kg, warming_kelvin, approach[" << n
         << "]; };\ndouble corrected_at(const struct circumstances* at, const double nominal[" << n
         << "], double command[" << n << "]);\nstatic const double stops[][" << n << "] = {" << std::setprecision(17);
    for (const Stop& stop : judged.stops) main << '{' << numbers(stop.joints, ",") << "},\n";
    main << "};\nstatic const struct circumstances at[] = {";
    for (const Stop& stop : judged.stops)
      main << '{' << stop.payload_kg << ',' << judged.warming(stop) << ",{" << numbers(stop.approach, ",") << "}},\n";
    main << "};\nint main(void) {\n  for (int i = 0; i < " << kStops << "; ++i) {\n    double command[" << n
         << "];\n    printf(\"%.17g\", corrected_at(at + i, stops[i], command));\n    for (int k = 0; k < " << n
         << "; ++k) printf(\" %.17g\", command[k]);\n    printf(\"\\n\");\n  }\n  return 0;\n}\n";
    const Listing listing = listing_of(corrected_arm(algebra, robot, ""), robot, "An arm");
    const std::string code =
        code_of(listing, CodeLanguage::c) + inverse_in_c(listing, described_listing(algebra, robot, robot.tool("")));
    const CodeFolder folder;
    const std::string program = folder.path("inverse");
    int failed = 0;
    const std::string said =
        output_of("cc -std=c99 -O1 -Wall -Wextra -Wno-missing-prototypes -Werror -o " + program + ' ' +
                      folder.write("arm.c", code) + ' ' + folder.write("main.c", main.str()) + " -lm",
                  failed);
    ASSERT_EQ(failed, 0) << said;
    std::istringstream printed(output_of(program, failed));
    int regular = 0;
    for (const Stop& stop : judged.stops) {
      const Eigen::Isometry3d goal = robot.sensor_from_base * forward(nominal, stop.joints) * robot.tool("");
      const bool is_regular = is_within_reach(robot, goal, stop);
      regular += is_regular ? 1 : 0;
      double left = 0.0;
      ASSERT_TRUE(printed >> left);
      JointVector command(joints);
      for (double& value : command) ASSERT_TRUE(printed >> value);
      if (left > 1e-6) {
        EXPECT_FALSE(is_regular) << joints << " joints, " << stop.joints.transpose();
        continue;
      }
      const Eigen::Isometry3d there = robot.predict(stop.with_joints(command), "");
      EXPECT_LT((there.translation() - goal.translation()).norm(), 1.1e-6);
      EXPECT_LT((there.linear() - goal.linear()).norm(), 1e-5);
    }
    EXPECT_GE(regular, kStops / 2) << joints << " joints: others are near singular";
  }
}

TEST(Code, InPythonAgreesWithTheModel) {
  if (!there_is("python3")) GTEST_SKIP() << "there is no python3";
  const Judged judged = judged_arm();
  std::ostringstream main;
  main << "import arm\nfor q, payload, warming, approach in [" << std::setprecision(17);
  for (const Stop& stop : judged.stops)
    main << "([" << numbers(stop.joints, ", ") << "], " << stop.payload_kg << ", " << judged.warming(stop) << ", ["
         << numbers(stop.approach, ", ") << "]),\n";
  main << "]:\n    print(*(x for row in arm.forward(q, payload, warming, approach) for x in row))\n"
       << "    print(*(getattr(arm, 'h%d' % (i + 1))(x) for i, x in enumerate(q)))\n";
  const CodeFolder folder;
  folder.write("arm.py", code_in(judged.robot, CodeLanguage::python));
  int code = 0;
  const std::string printed = output_of("python3 -B " + folder.write("main.py", main.str()), code);
  ASSERT_EQ(code, 0) << printed;
  expect_agreement(judged, printed);
}

TEST(Code, InMatlabAgreesWithTheModelWhereOctaveRunsIt) {
  if (!there_is("octave")) GTEST_SKIP() << "there is no octave";
  const Judged judged = judged_arm();
  std::ostringstream main;
  main << "for q = [" << std::setprecision(17);
  for (const Stop& stop : judged.stops)
    main << numbers(stop.joints, ", ") << ", " << stop.payload_kg << ", " << judged.warming(stop) << ", "
         << numbers(stop.approach, ", ") << '\n';
  main << "]'\n  [pose, h] = forward(q(1:5), q(6), q(7), q(8:12));\n  printf('%.17g ', pose', h);\nend\n";
  const CodeFolder folder;
  folder.write("forward.m", code_in(judged.robot, CodeLanguage::matlab));
  folder.write("judge.m", main.str());
  int code = 0;
  const std::string printed = output_of("octave -qf -p " + folder.path("") + " --eval judge", code);
  ASSERT_EQ(code, 0) << printed;
  expect_agreement(judged, printed);
}

/// How often the expression is found.
std::ptrdiff_t count(const std::string& text, const std::string& expression) {
  const std::regex pattern(expression);
  return std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), {});
}

TEST(Code, InMatlabHasWholeStatementsAndCallsOnlyWhatIsThere) {
  const std::string code = code_in(judged_arm().robot, CodeLanguage::matlab);
  const std::regex statement(R"(\s*(%.*|function .*|if .*|else|end|[A-Za-z]\w*(\([1-4], [1-4]\))? = .*;|))");
  std::istringstream lines(code);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_TRUE(std::regex_match(line, statement)) << line;
    if (line.find('%') != std::string::npos) continue;
    EXPECT_EQ(count(line, "\\("), count(line, "\\)")) << line;
  }
  EXPECT_EQ(count(code, "\n *end(?=\n)"), count(code, "(^|\n)function ") + count(code, "\n *if "));
  const std::string without_remarks = std::regex_replace(code, std::regex("%[^\n]*"), "");
  const std::regex called(R"(([A-Za-z_]\w*)\()");
  std::set<std::string> known{"sin",   "cos", "tanh", "sign", "abs", "sqrt", "round", "min",     "max",
                              "zeros", "q",   "pose", "atan", "log", "exp",  "isnan", "approach"};
  const std::regex defined(R"(function \S+(?: h\])? = (\w+)\()");
  for (std::sregex_iterator it(code.begin(), code.end(), defined), end; it != end; ++it) {
    known.insert((*it)[1]);
  }
  for (std::sregex_iterator it(without_remarks.begin(), without_remarks.end(), called), end; it != end; ++it) {
    EXPECT_TRUE(known.contains((*it)[1])) << (*it)[1];
  }
}

TEST(Code, HasNoLineOfItsOwnFromAName) {
  RandomStream stream{77};
  const CorrectedRobot robot = random_robot(stream, random_arm(stream, 6, Convention::standard_dh, 0.0), 0.01, 0.1);
  for (const CodeLanguage language :
       {CodeLanguage::text, CodeLanguage::c, CodeLanguage::python, CodeLanguage::matlab}) {
    Algebra algebra;
    const Listing listing =
        listing_of(corrected_arm(algebra, robot, ""), robot, "An arm\nevil\r\nevil", PoseFrame::own_base);
    EXPECT_THAT(code_of(listing, language), testing::Not(testing::ContainsRegex("(^|[\n\r])evil")));
  }
}

TEST(Code, AsTextWritesEveryElementAndTheCorrections) {
  const std::string text = code_in(judged_arm().robot, CodeLanguage::text);
  EXPECT_EQ(count(text, "\npose\\([1-3],[1-4]\\) = "), 12);
  EXPECT_EQ(count(text, "\nactual[1-5] = h[1-5]\\(q[1-5]\\) = "), 5);
  EXPECT_THAT(text, testing::HasSubstr("divide_or_one("));
}

}  // namespace
}  // namespace demecal
