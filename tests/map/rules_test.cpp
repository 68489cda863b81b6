// Every rule of the map, held to sources that break it and to sources that do not.
#include "rules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace demecal::map {
namespace {

using ::testing::IsEmpty;
using ::testing::SizeIs;

const Map& made_up_map() {
  static const Map map = [] {
    Map made{parse_rooms("demecal_room(data LIBRARIES Eigen3::Eigen)\n"
                         "demecal_room(fitting ROOMS data)\n"
                         "demecal_room(evolution)\n"
                         "demecal_room(report ROOMS fitting PRIVATE_LIBRARIES fmt::fmt)\n"
                         "demecal_room(config ROOMS report PRIVATE_LIBRARIES yaml-cpp)\n"
                         "demecal_room(transport)\n"
                         "demecal_room(dds ROOMS transport PRIVATE_LIBRARIES fastrtps)\n"),
             {}};
    made.programs["coordinator"] = parse_program("target_link_libraries(x PUBLIC demecal_config)", made.rooms);
    made.programs["worker"] = parse_program("target_link_libraries(x PUBLIC demecal_dds)", made.rooms);
    return made;
  }();
  return map;
}

Source including(const std::string& path, const std::string& what) {
  return {path, "// A file.\n#include " + what + "\n"};
}

TEST(RoomRule, LetsARoomIncludeItselfAndWhatItReaches) {
  for (const char* const what : {"\"report/html.hpp\"", "\"fitting/fit.hpp\"", "\"data/pose.hpp\"", "<vector>"}) {
    EXPECT_THAT(check_rooms(including("common/report/html.cpp", what), made_up_map()), IsEmpty()) << what;
  }
}

TEST(RoomRule, ForbidsARoomWhatItDoesNotReach) {
  for (const char* const what :
       {"\"evolution/island.hpp\"", "\"config/job.hpp\"", "\"html.hpp\"", "\"../data/pose.hpp\""}) {
    const Violations found = check_rooms(including("common/report/html.cpp", what), made_up_map());
    ASSERT_THAT(found, SizeIs(1)) << what;
    EXPECT_EQ(found[0].line, 2);
  }
}

TEST(RoomRule, ForbidsAFolderThatIsOnNoMap) {
  EXPECT_THAT(check_rooms({"common/attic/old.hpp", "// A file.\n"}, made_up_map()), SizeIs(1));
}

TEST(RoomRule, KeepsProgramsApartAndOutOfTheRooms) {
  EXPECT_THAT(check_rooms(including("coordinator/main.cpp", "\"worker/loop.hpp\""), made_up_map()), SizeIs(1));
  EXPECT_THAT(check_rooms(including("worker/main.cpp", "\"coordinator/run.hpp\""), made_up_map()), SizeIs(1));
  EXPECT_THAT(check_rooms(including("worker/main.cpp", "\"config/job.hpp\""), made_up_map()), SizeIs(1));
  EXPECT_THAT(check_rooms(including("common/data/pose.cpp", "\"worker/loop.hpp\""), made_up_map()), SizeIs(1));
  EXPECT_THAT(check_rooms(including("worker/main.cpp", "\"worker/loop.hpp\""), made_up_map()), IsEmpty());
  EXPECT_THAT(check_rooms(including("coordinator/main.cpp", "\"data/pose.hpp\""), made_up_map()), IsEmpty());
}

TEST(RoomRule, LetsTestsIncludeBothPrograms) {
  const Source test{"tests/coordinator/run_test.cpp",
                    "#include \"coordinator/run.hpp\"\n#include \"worker/loop.hpp\"\n"};
  EXPECT_THAT(check_rooms(test, made_up_map()), IsEmpty());
}

TEST(LibraryRule, LetsARoomIncludeItsOwnAndThePublicOnesBelow) {
  EXPECT_THAT(check_libraries(including("common/report/html.cpp", "<fmt/format.h>"), made_up_map()), IsEmpty());
  EXPECT_THAT(check_libraries(including("common/report/html.cpp", "<Eigen/Core>"), made_up_map()), IsEmpty());
}

TEST(LibraryRule, ForbidsWhatTheRoomDoesNotLinkTo) {
  EXPECT_THAT(check_libraries(including("common/config/job.cpp", "<fmt/format.h>"), made_up_map()), SizeIs(1));
  EXPECT_THAT(check_libraries(including("common/evolution/island.cpp", "<Eigen/Core>"), made_up_map()), SizeIs(1));
  EXPECT_THAT(check_libraries(including("coordinator/main.cpp", "<CLI/CLI.hpp>"), made_up_map()), SizeIs(1));
}

TEST(OwnerRule, KeepsEachLibraryInItsRoom) {
  for (const char* const what :
       {"<yaml-cpp/yaml.h>", "<fastdds/dds/domain/DomainParticipant.hpp>", "<fastcdr/Cdr.h>", "<fastrtps/utils/x.h>",
        "\"calibrationPubSubTypes.h\"", "<Eigen/QR>", "<Eigen/Dense>"}) {
    EXPECT_THAT(check_owners(including("common/report/html.cpp", what)), SizeIs(1)) << what;
    EXPECT_THAT(check_owners(including("worker/main.cpp", what)), SizeIs(1)) << what;
    EXPECT_THAT(check_owners(including("tests/report/html_test.cpp", what)), IsEmpty()) << what;
  }
  EXPECT_THAT(check_owners(including("common/yaml/read.cpp", "<yaml-cpp/yaml.h>")), IsEmpty());
  EXPECT_THAT(check_owners(including("common/decompositions/decompositions.cpp", "<Eigen/QR>")), IsEmpty());
  EXPECT_THAT(check_owners(including("common/report/html.cpp", "<Eigen/Core>")), IsEmpty());
  EXPECT_THAT(check_owners(including("common/dds/types.cpp", "<fastdds/dds/topic/TypeSupport.hpp>")), IsEmpty());
  EXPECT_THAT(check_owners(including("common/dds/types.cpp", "\"calibrationPubSubTypes.h\"")), SizeIs(1));
}

TEST(PureHeaderRule, ForbidsFilesThreadsAndClocks) {
  for (const char* const what :
       {"<fstream>", "<thread>", "<mutex>", "<chrono>", "<filesystem>", "<iostream>", "<sys/stat.h>"}) {
    EXPECT_THAT(check_pure_headers(including("common/data/read.cpp", what)), SizeIs(1)) << what;
    EXPECT_THAT(check_pure_headers(including("common/config/read.cpp", what)), IsEmpty()) << what;
    EXPECT_THAT(check_pure_headers(including("common/transport/mailbox.cpp", what)), IsEmpty()) << what;
    EXPECT_THAT(check_pure_headers(including("common/dds/writers.cpp", what)), IsEmpty()) << what;
    EXPECT_THAT(check_pure_headers(including("worker/main.cpp", what)), IsEmpty()) << what;
  }
  EXPECT_THAT(check_pure_headers(including("common/data/read.cpp", "<istream>")), IsEmpty());
}

TEST(PureCallRule, ForbidsChanceClocksAndPrinting) {
  for (const char* const line :
       {"std::random_device device;", "seed = time(0);", "seed = std::time(nullptr);", "srand(1);", "int i = rand();",
        "std::normal_distribution<double> d;", "std::cout << 1;", "std::printf(\"x\");",
        "auto t = steady_clock::now();", "std::getenv(\"HOME\");", "std::ofstream out;"}) {
    EXPECT_THAT(check_pure_calls({"common/evolution/island.cpp", std::string(line) + "\n"}), SizeIs(1)) << line;
    EXPECT_THAT(check_pure_calls({"common/transport/mailbox.cpp", std::string(line) + "\n"}), IsEmpty()) << line;
  }
}

TEST(PureCallRule, TakesNoLikenessForTheThing) {
  for (const char* const line : {"double t = row.time(3);", "// std::random_device", "throw Error(\"time(0)\");",
                                 "const double runtime = operand(1);", "std::snprintf(text, 3, \"x\");", "grand(1);"}) {
    EXPECT_THAT(check_pure_calls({"common/data/read.cpp", std::string(line) + "\n"}), IsEmpty()) << line;
  }
}

TEST(ViewRule, ForbidsViewsAndNoAlgorithms) {
  for (const char* const line :
       {"for (int i : std::views::reverse(all))", "std::ranges::subrange(first, last)", "std::ranges::unique(all);",
        "auto [a, b] = std::ranges::minmax(all | std::ranges::views::transform(f));"})
    EXPECT_THAT(check_views({"common/data/rows.cpp", line}), SizeIs(1)) << line;
  for (const char* const line : {"std::ranges::sort(views);", "// std::views::reverse", "std::string_view text;"})
    EXPECT_THAT(check_views({"common/data/rows.cpp", line}), IsEmpty()) << line;
}

TEST(NamespaceRule, HoldsARoomToItsOwn) {
  const auto with = [](const std::string& line) { return Source{"common/data/pose.cpp", line + "\n"}; };
  EXPECT_THAT(check_namespace(with("namespace demecal::inline data {")), IsEmpty());
  EXPECT_THAT(check_namespace(with("namespace demecal {")), SizeIs(1));
  EXPECT_THAT(check_namespace(with("namespace demecal::inline effects {")), SizeIs(1));
  EXPECT_THAT(check_namespace({"tests/data/pose_test.cpp", "namespace demecal {\n"}), IsEmpty());
}

TEST(ShapeRule, AllowsThreeHundredLinesAndNoMore) {
  std::string text = "// A file.\n";
  for (int line = 2; line <= 300; ++line) text += "\n";
  EXPECT_THAT(check_shape({"common/data/long.cpp", text}), IsEmpty());
  EXPECT_THAT(check_shape({"common/data/long.cpp", text + "\n"}), SizeIs(1));
}

TEST(ShapeRule, WantsHeadersAndTestsIntroduced) {
  for (const char* const path : {"common/data/pose.hpp", "worker/loop.hpp", "tests/data/pose_test.cpp"}) {
    EXPECT_THAT(check_shape({path, "#pragma once\n// A pose.\n"}), SizeIs(1)) << path;
    EXPECT_THAT(check_shape({path, "// A pose.\n#pragma once\n"}), IsEmpty()) << path;
  }
  EXPECT_THAT(check_shape({"common/data/pose.cpp", "#include \"data/pose.hpp\"\n"}), IsEmpty());
}

TEST(NameRule, ForbidsNamesThatSayNothing) {
  for (const char* const path : {"common/util/a.hpp", "common/data/string_utils.cpp", "common/data/helpers.hpp",
                                 "worker/run_manager.cpp", "tests/misc/a_test.cpp", "common/common/a.hpp"}) {
    EXPECT_THAT(check_names({path, ""}), SizeIs(1)) << path;
  }
  for (const char* const path :
       {"common/data/pose.hpp", "coordinator/utilisation.cpp", "tests/data/common_mode_test.cpp"}) {
    EXPECT_THAT(check_names({path, ""}), IsEmpty()) << path;
  }
}

const std::string kInbox = "namespace demecal {\nclass Inbox final : public Store {\n  struct Entry {};\n};\n}\n";

TEST(TypeRule, FindsATypeThatTwoFilesDefine) {
  for (const char* const other :
       {"namespace demecal { struct Inbox { int a; }; }",
        "namespace demecal {\nstruct Before {};\nenum class Inbox { a };\n}",
        "namespace demecal { template <class T, class Rows = List<T>> class Inbox {}; }",
        "namespace demecal { union Inbox {}; }", "namespace demecal::inline data { struct Inbox {}; }",
        "namespace demecal { namespace { class Inbox {}; } }", "namespace demecal::map { class Inbox {}; }",
        "namespace demecal {\n#define OPEN {\nint f() { return 1; }\nenum Inbox : int { a };\n}"}) {
    EXPECT_THAT(check_types_once({{"worker/inbox.hpp", kInbox}, {"common/transport/inbox.hpp", other}}), SizeIs(1))
        << other;
  }
}

TEST(TypeRule, LeavesApartWhatNoLinkerMixesUp) {
  for (const char* const other :
       {"namespace demecal { class Inbox; }", "namespace demecal { struct Outbox { struct Inbox {}; }; }",
        "namespace demecal { void f() { struct Inbox {}; } }", "namespace demecal { // class Inbox {};\n}",
        "namespace demecal { struct Entry {}; }", "namespace demecal { template <class Inbox> struct Box {}; }"}) {
    EXPECT_THAT(check_types_once({{"worker/inbox.hpp", kInbox}, {"common/transport/inbox.hpp", other}}), IsEmpty())
        << other;
  }
}

Source with_anonymous(const std::string& path, const std::string& declarations) {
  return {path, "namespace demecal {\nnamespace {\n" + declarations + "\n}  // namespace\n}\n"};
}

const Source kRows = with_anonymous("common/data/rows.cpp",
                                    "using Rows = std::vector<int>;\n"
                                    "constexpr double kNear = 0.5, kFar[] = {1.0, 2.0};\n"
                                    "struct Row { int at = 0; };\n"
                                    "template <class T>\nint rows_of(const T& all, int from = 0) {\n"
                                    "  const int count = 0;\n  return sum(all, count);\n}\n"
                                    "int rows_of();\n");

TEST(AnonymousRule, FindsANameThatTwoFilesDeclare) {
  for (const char* const again :
       {"double rows_of(const std::function<int(int)>& row);", "int rows_of() {\n  return 1;\n}",
        "[[nodiscard]] Rows<int> rows_of(int a = kNearest) {}", "constexpr int kNear{3};", "std::array<int, 2> kFar;",
        "const auto kNear = [](int a) { return a; };", "constexpr int kNearest = f(1, 2), kFar = 3;",
        "constexpr char kNearest[] = {'a', 'b'}, kFar[2] = {};", "using Rows = std::set<int>;", "struct Row;",
        "enum class Row : int { a };", "namespace inner {\nint rows_of(int row) {}\n}"}) {
    EXPECT_THAT(check_anonymous_once({kRows, with_anonymous("worker/rows.cpp", again)}), SizeIs(1)) << again;
  }
}

TEST(AnonymousRule, LeavesApartWhatIsOneThingOrNoNameOfTheNamespace) {
  for (const char* const other :
       {"using Rows = std::vector<int>;", "using other::Row;", "namespace kNear = other::near;",
        "int sum(int count) {}", "int Table::rows_of() {}",
        "struct Table {\n  int rows_of() { return 1; }\n  int kFar = 1;\n};",
        "bool operator==(const A& a, const A& b) {\n  const int kNear = 1;\n}", "// int rows_of();",
        "const std::string kText = \"int rows_of();\";", "#define kNear 3", "static_assert(kNear(1));"}) {
    EXPECT_THAT(check_anonymous_once({kRows, with_anonymous("worker/rows.cpp", other)}), IsEmpty()) << other;
  }
  const Source named{"worker/rows.cpp", "namespace demecal {\nnamespace {\nint other();\n}\nint rows_of() {}\n}\n"};
  EXPECT_THAT(check_anonymous_once({kRows, named}), IsEmpty());
}

std::string lines_from(int first, int count) {
  std::string text;
  for (int i = first; i < first + count; ++i) text += "  total += weight[" + std::to_string(i) + "];\n";
  return text;
}

TEST(PassageRule, FindsThirteenLinesThatStandTwiceHoweverTheyAreSpaced) {
  std::string spaced = "#include <vector>\n" + lines_from(0, 6) + "\n  // why\n}\n" + lines_from(6, 7);
  EXPECT_THAT(check_passages_once({{"common/a/a.cpp", lines_from(0, 13)}, {"worker/b.cpp", spaced}}), SizeIs(1));
  EXPECT_THAT(check_passages_once({{"common/a/a.cpp", lines_from(0, 13) + "int between;\n" + lines_from(0, 13)}}),
              SizeIs(1));
}

TEST(PassageRule, LetsTwelveLinesStandTwice) {
  EXPECT_THAT(check_passages_once({{"common/a/a.cpp", lines_from(0, 12) + "int one;\n"},
                                   {"worker/b.cpp", lines_from(0, 12) + "int other;\n"}}),
              IsEmpty());
}

}  // namespace
}  // namespace demecal::map
