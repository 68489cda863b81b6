// The page says what the JSON says: every figure, every joint, every name, and nothing as markup.
#include "html/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "errors/input_error.hpp"
#include "made_up_loop.hpp"
#include "page_reading.hpp"
#include "report/figures.hpp"

namespace demecal {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;
using Json = nlohmann::ordered_json;

std::string page_of(const Report& report, const std::vector<HistoryRow>& history = {}) {
  return report_html(report, fitness_of(history));
}

std::string page_of(const Json& json) {
  return report_html(read_report(json.dump(), "report.json"), {});
}

Json made_up_json() {
  return Json::parse(to_json(made_up_report()));
}

std::string complaint(const std::string& json, const std::string& csv = "") {
  try {
    report_html(read_report(json, "report.json"), read_fitness(csv));
  } catch (const InputError& fault) {
    return fault.what();
  }
  return "none";
}

TEST(ReportPage, IsWellFormedAndNeedsNothingFromElsewhere) {
  const std::string page = page_of(made_up_report(), made_up_history(6, 3, 10));
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_THAT(all_between(page, "<script", ">"), IsEmpty()) << "without poses there is nothing to run";
  for (const char* const word : {"http", "<link", "@import", "url(", "src=", "nan", "inf\""}) {
    EXPECT_THAT(page, Not(HasSubstr(word)));
  }
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
  EXPECT_THAT(page, HasSubstr("@media print"));
}

TEST(ReportPage, IsTheSameOfAReportThatWasWrittenAndReadBack) {
  const std::vector<HistoryRow> history = made_up_history(6, 3, 10);
  for (const Report& report : {made_up_report(), made_up_sharing_report(), made_up_looped_report(27)}) {
    EXPECT_EQ(report_html(read_report(to_json(report), "report.json"), read_fitness(history_csv(history))),
              page_of(report, history));
  }
}

TEST(ReportPage, IsTheSameEveryTime) {
  EXPECT_EQ(page_of(made_up_report(), made_up_history(6, 3, 10)), page_of(made_up_report(), made_up_history(6, 3, 10)));
}

TEST(ReportPage, OpensWithTheErrorBeforeAndAfterOnPosesNotFitted) {
  Report report = made_up_report();
  report.registered.validation.mean_mm = 2.0;
  report.before.validation.mean_mm = 0.5;
  EXPECT_THAT(words_of(page_of(report)),
              HasSubstr("Mean tool error on 30 validation poses: 2.000 mm → 0.500 mm, 75\u00A0% less."));
  report.poses.accept = 1;
  report.registered.accept = {4.0, 4.0, 4.0, 4.0};
  report.before.accept = {5.0, 5.0, 5.0, 5.0};
  EXPECT_THAT(words_of(page_of(report)),
              HasSubstr("Mean tool error on 1 accept pose: 4.000 mm → 5.000 mm, 25\u00A0% more."));
}

TEST(ReportPage, SaysWhereTheErrorIsThatOfTheFittedPoses) {
  Report report = made_up_report();
  for (ErrorBySet* const stage : {&report.nominal, &report.registered, &report.declared, &report.before}) {
    stage->validation = stage->accept;
  }
  report.poses.validation = 0;
  const std::string words = words_of(page_of(report));
  EXPECT_THAT(words, HasSubstr("on 60 calibration poses"));
  EXPECT_THAT(words, HasSubstr("fitted to these same poses"));
}

TEST(ReportPage, ShowsTheErrorsOfTheJsonRounded) {
  const Json json = made_up_json();
  const auto rows = table_of(page_of(json), "errors");
  const std::vector<std::string> stages{"nominal", "registered", "declared", "before"};
  ASSERT_THAT(rows, SizeIs(stages.size() + 1));
  for (std::size_t i = 0; i < stages.size(); ++i) {
    std::vector<std::string> expected{rows[i].at(0)};
    for (const char* const set : {"calibration", "validation"}) {
      for (const char* const figure : {"mean", "rms", "p95", "max"}) {
        expected.push_back(rounded(json["error_mm"][stages[i]][set][figure], 3));
      }
    }
    EXPECT_EQ(rows[i], expected);
  }
}

TEST(ReportPage, SaysTheIndexOfTheModelThatWasWritten) {
  const std::string page = page_of(made_up_report());
  EXPECT_NE(page.find("mm² with the declared model, "), std::string::npos);
  EXPECT_NE(page.find("mm² with the final model, which model.yaml holds ("), std::string::npos);
}

TEST(ReportPage, ShowsTheJointsOfTheJsonRounded) {
  const Json json = made_up_json();
  const auto rows = table_of(page_of(json), "joints");
  ASSERT_THAT(rows, SizeIs(6));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Json& joint = json["joints"][i];
    const bool bounded = joint["kept"] && !joint["bound_rad"].is_null();
    EXPECT_EQ(rows[i].at(0), "joint " + std::to_string(i + 1));
    EXPECT_EQ(rows[i].at(1), rounded(1e3 * joint["mean_abs_error_rad"]["before"].get<double>(), 3));
    EXPECT_EQ(rows[i].at(2), rounded(1e3 * joint["mean_abs_error_rad"]["after"].get<double>(), 3));
    EXPECT_EQ(rows[i].at(4), bounded ? rounded(1e3 * joint["bound_rad"].get<double>(), 3) : "–");
    EXPECT_EQ(rows[i].back(), joint["kept"] ? "corrected" : "neutral");
  }
}

TEST(ReportPage, ShowsTheParametersOfTheJsonRounded) {
  const Json json = made_up_json();
  auto rows = table_of(page_of(json), "parameters");
  std::erase_if(rows, [](const std::vector<std::string>& row) { return row.size() == 1; });  // the groups' headings
  ASSERT_EQ(rows.size(), json["parameters"].size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Json& parameter = json["parameters"][i];
    const std::string name = parameter["name"];
    const int decimals = name.ends_with("_mm") ? 4 : 5;
    const double nominal = parameter["nominal"], value = parameter["value"], error = parameter["standard_error"];
    EXPECT_EQ(rows[i].at(0), name);
    EXPECT_EQ(rows[i].at(1), rounded(nominal, decimals));
    EXPECT_EQ(rows[i].at(2), rounded(value, decimals));
    EXPECT_EQ(rows[i].at(3), rounded(value - nominal, decimals));
    EXPECT_EQ(rows[i].at(4), error > 0.0 ? rounded(error, decimals) : "–");
    EXPECT_EQ(rows[i].at(5), name.ends_with("_mm") ? "mm" : "deg");
    EXPECT_EQ(rows[i].at(6), error > 0.0 ? rounded(std::abs(value - nominal) / error, 1) : "not identified");
  }
}

TEST(ReportPage, ShowsEveryFormulaNoteNameAndFact) {
  const Report report = made_up_report();
  const std::string words = words_of(page_of(report));
  for (const JointEntry& joint : report.joints) {
    EXPECT_THAT(words, HasSubstr(joint.kept ? "g(theta) = " + joint.expression : joint.note));
    EXPECT_THAT(words, HasSubstr(joint.short_form));
    EXPECT_THAT(words, HasSubstr(joint.as_evolved));
    EXPECT_THAT(words, HasSubstr(limit_sentence(joint)));
  }
  EXPECT_THAT(words, HasSubstr("Of the 4 corrections in the model 1 is a formula as it evolved;"));
  EXPECT_THAT(words, HasSubstr("This is a sum of smooth terms that was fitted to the poses"));
  EXPECT_THAT(words, HasSubstr("As evolved (not in the model), 0.310 mrad left:"));
  for (const std::string& sentence : report.unidentified) EXPECT_THAT(words, HasSubstr(sentence));
  for (const std::string& pose : report.poses.outliers) EXPECT_THAT(words, HasSubstr(pose));
  for (const std::string& pose : report.poses.near_singular) EXPECT_THAT(words, HasSubstr(pose));
  for (const std::string& fact : {report.robot, report.job, report.method, report.version, report.data_sha256,
                                  std::to_string(*report.seed), std::string("48\u202F123\u202F456")}) {
    EXPECT_THAT(words, HasSubstr(fact));
  }
}

TEST(ReportPage, HasABarForEveryStageAndSet) {
  EXPECT_THAT(all_between(page_of(made_up_report()), "<rect class=\"bar", "/>"), SizeIs(4 * 2));
}

TEST(ReportPage, HasAsManyChartPointsAsTheHistoryHasRows) {
  const std::vector<HistoryRow> history = made_up_history(6, 3, 11);
  EXPECT_EQ(points_in(lines_of(page_of(made_up_report(), history), "island")), history.size());
}

TEST(ReportPage, ChartsJointsThatOnlyTheHistoryKnows) {
  Report report = made_up_report();
  report.joints.clear();
  const std::vector<HistoryRow> history = made_up_history(2, 2, 3);
  EXPECT_EQ(points_in(lines_of(page_of(report, history), "island")), history.size());
}

TEST(ReportPage, PlotsEveryKeptCorrection) {
  const std::string page = page_of(made_up_report());
  EXPECT_THAT(all_between(page, "class=\"zero\"", "/>"), SizeIs(4));
  EXPECT_THAT(lines_of(page, "island"), IsEmpty()) << "no history, no charts of it";
}

TEST(ReportPage, ShowsSharedFunctionsAndTheFormulasThatCallThem) {
  const std::string page = page_of(made_up_sharing_report());
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_THAT(words_of(page), HasSubstr("F1(c1, c2, a1) = c1 * SIN(a1 + c2)"));
  EXPECT_THAT(words_of(page), HasSubstr("joints 1, 3"));
  EXPECT_THAT(words_of(page), HasSubstr("called by no joint"));
  EXPECT_THAT(words_of(page), HasSubstr("F1(0.00061, 1.4, 1.02 * theta)"));
  EXPECT_THAT(words_of(page_of(made_up_report())), Not(HasSubstr("called by")));
}

TEST(ReportPage, ShowsAFormulaItCannotReadWithoutItsPlot) {
  Json json = made_up_json();
  json["joints"][0]["expression"] = "TAN(theta) < 3";
  const std::string page = page_of(json);
  EXPECT_THAT(all_between(page, "class=\"zero\"", "/>"), SizeIs(3));
  EXPECT_THAT(words_of(page), HasSubstr("g(theta) = TAN(theta) < 3"));
  EXPECT_THAT(words_of(page), HasSubstr("the formula cannot be read"));
}

TEST(ReportPage, EscapesEveryText) {
  const std::string evil = "</td><script>alert('x')</script>\" onload=\"&amp;";
  const std::function<void(Json&)> poison = [&](Json& json) {
    if (json.is_string()) json = evil;
    if (json.is_structured()) {
      for (Json& child : json) poison(child);
    }
  };
  Json json = Json::parse(to_json(made_up_looped_report()));
  json["rounds"][0]["effect"]["parameters"][evil] = 1;
  poison(json);
  const std::string page = page_of(json);
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, Not(HasSubstr("\" onload")));
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_THAT(words_of(page), HasSubstr(evil));
}

TEST(ReportPage, LeavesOutWhatAReportLacks) {
  const Json whole = Json::parse(to_json(made_up_looped_report()));
  for (const auto& [key, value] : whole.items()) {
    if (key == "demecal_report") continue;
    Json json = whole;
    json.erase(key);
    EXPECT_EQ(unbalanced(page_of(json)), "") << key;
    json[key] = nullptr;
    EXPECT_EQ(unbalanced(page_of(json)), "") << key;
  }
  const std::string bare = page_of(Json{{"demecal_report", 1}});
  EXPECT_EQ(unbalanced(bare), "");
  EXPECT_THAT(bare, Not(HasSubstr("<section")));
  EXPECT_THAT(bare, Not(HasSubstr("<table")));
}

TEST(ReportPage, LeavesOutWhatPartsOfAReportLack) {
  const Json whole = Json::parse(to_json(made_up_looped_report()));
  const Json places = whole.flatten();
  for (const auto& [pointer, value] : places.items()) {
    if (pointer == "/demecal_report") continue;
    Json json = whole;
    json[Json::json_pointer(pointer)] = nullptr;
    const bool half_a_range = pointer.find("range_rad") != std::string::npos;
    if (half_a_range) {
      EXPECT_THAT(complaint(json.dump()), HasSubstr("the two ends of a range")) << pointer;
    } else {
      EXPECT_EQ(complaint(json.dump()), "none") << pointer;
    }
  }
}

TEST(ReportPage, IgnoresKeysItDoesNotKnow) {
  Json json = made_up_json();
  const std::string page = page_of(json);
  json["later"] = {{"anything", 1}};
  json["joints"][0]["later"] = "x";
  EXPECT_EQ(page_of(json), page);
}

TEST(HistoryOfChecks, BreaksItsLinesWhereTheModelChanges) {
  std::vector<CheckRecord> records(5);
  EXPECT_THAT(lines_of(check_history_html(records), "island"), ElementsAre(SizeIs(5)));
  for (std::size_t i = 0; i < records.size(); ++i) records[i].model_sha256 = i < 2 ? "01" : "02";
  EXPECT_THAT(lines_of(check_history_html(records), "island"), ElementsAre(SizeIs(2), SizeIs(3)));
}

TEST(ReportPage, RefusesWhatIsNoReport) {
  EXPECT_THAT(complaint("{\"demecal_report\": 1,\n"), HasSubstr("report.json:2: "));
  EXPECT_THAT(complaint("not json"), HasSubstr("report.json:1: is not JSON from column"));
  EXPECT_THAT(complaint("[]"), HasSubstr("must be an object"));
  EXPECT_THAT(complaint("{}"), HasSubstr("report.json: demecal_report must be 1"));
  EXPECT_THAT(complaint(R"({"demecal_report": 2})"), HasSubstr("'2': demecal_report must be 1"));
}

TEST(ReportPage, NamesTheKeyOfAValueOfTheWrongKind) {
  Json json = made_up_json();
  json["error_mm"]["before"]["validation"]["p95"] = "large";
  EXPECT_EQ(complaint(json.dump()), "report.json: '\"large\"': error_mm.before.validation.p95 must be a number");
  json = made_up_json();
  json["joints"][1]["range_rad"] = {1.0, -1.0};
  EXPECT_THAT(complaint(json.dump()), HasSubstr("joints[1].range_rad must be the two ends of a range"));
  json = made_up_json();
  json["poses"] = 3;
  EXPECT_THAT(complaint(json.dump()), HasSubstr("poses must be an object"));
  EXPECT_THAT(complaint(to_json(made_up_report()), "joint,island\n1,1\n"), HasSubstr("history.csv:1: has no column"));
}

}  // namespace
}  // namespace demecal
