// The page shows every round of the closed loop, its pictures, and what was not found.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "html/page.hpp"
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

std::string loop_page_of(const Report& report) {
  return report_html(report, {});
}

std::string loop_page_of(const LoopOutcome& loop) {
  return loop_page_of(made_up_looped_report(loop));
}

std::string loop_page_of(const Json& json) {
  return report_html(read_report(json.dump(), "report.json"), {});
}

/// The rows of a table without the lines that head groups.
std::vector<std::vector<std::string>> rows_of(const std::string& page, const std::string& id) {
  auto rows = table_of(page, id);
  std::erase_if(rows, [](const std::vector<std::string>& row) { return row.size() == 1; });
  return rows;
}

TEST(LoopPage, HasEveryRoundWithItsFiguresAndSentences) {
  for (const int harmonics : {0, 5, 40}) {
    const Report report = made_up_looped_report(harmonics);
    const auto rows = rows_of(loop_page_of(report), "rounds");
    ASSERT_EQ(rows.size(), report.rounds.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const RoundEntry& round = report.rounds[i];
      EXPECT_EQ(rows[i].at(0), std::to_string(round.round));
      EXPECT_EQ(rows[i].at(1), round.verdict == "none" ? "not significant" : round.verdict);
      EXPECT_THAT(rows[i].at(2), HasSubstr(round.effect.kind));
      EXPECT_THAT(rows[i].at(2), HasSubstr(round.diagnosis + round.reason));
      EXPECT_EQ(rows[i].at(5), rounded(*round.validation_before_mm, 3));
      EXPECT_EQ(rows[i].at(6), rounded(*round.validation_after_mm, 3));
    }
    EXPECT_THAT(rows_of(loop_page_of(report), "evidence"), SizeIs(rows.size()));
  }
}

TEST(LoopPage, HasTheAnswerOpenAndHowItWasFoundFolded) {
  Report report = made_up_looped_report(5);
  report.unexplained = UnexplainedEntry{.error_mm = 0.26, .left_mm = 0.3, .noise_mm = 0.15, .advice = "Measure more."};
  report.pose_errors = {{"P1", "", "accept", {}, 0.1, {}}};
  report.poses.outliers = {"P7"};
  const std::string page = loop_page_of(report);
  std::string open = page;
  for (std::size_t at = open.find("<details"); at != std::string::npos; at = open.find("<details"))
    open.erase(at, open.find("</details>", at) - at);
  EXPECT_THAT(page, Not(HasSubstr("<details class=\"folded\" open")));
  std::size_t before = 0;
  for (const char* const part : {"class=\"headline\"", "id=\"causes-found\"", "id=\"where\"", "id=\"todo\""}) {
    const std::size_t at = open.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    EXPECT_GT(at, before) << part;
    before = at;
  }
  EXPECT_THAT(open, HasSubstr("id=\"next-measurements\""));
  for (const char* const machinery :
       {"id=\"rounds\"", "id=\"evidence\"", "id=\"not-found\"", "id=\"decoys\"", "id=\"parameters\"", "nats"}) {
    EXPECT_THAT(page, HasSubstr(machinery));
    EXPECT_THAT(open, Not(HasSubstr(machinery)));
  }
}

TEST(LoopPage, EndsTheCausesWithWhatNoneExplains) {
  Report report = made_up_looped_report(2);
  EXPECT_THAT(loop_page_of(report), Not(HasSubstr("Not explained")));
  report.unexplained = UnexplainedEntry{.error_mm = 0.26, .left_mm = 0.3, .noise_mm = 0.15, .advice = "Measure more."};
  EXPECT_THAT(loop_page_of(report), HasSubstr("of which noise makes 0.150 mm. Measure more."));
}

TEST(LoopPage, HasTheNumbersBehindARound) {
  const auto rows = rows_of(loop_page_of(made_up_looped_report()), "evidence");
  EXPECT_THAT(rows[0], ElementsAre("1", "dq2 = formula 1", "width_rad 0.000412 ± 1.3e-05, 0.0003708 to 0.0004532",
                                   "0.001", "31.7", "97\u00A0% (61\u00A0%)", "100\u00A0%"));
}

TEST(LoopPage, ReadsARoundThatHasOnlyThePromisedKeys) {
  Json json = Json::parse(to_json(made_up_report()));
  EXPECT_THAT(loop_page_of(json), Not(HasSubstr("id=\"loop\""))) << "nothing is shown where the loop did not run";
  json["stopped"] = "no_structure";
  json["rounds"] = Json::parse(R"([
      {"round": 1, "verdict": "added", "effect": {"kind": "backlash", "joint": 2, "parameters": {"width_rad": 0.000412}},
       "rivals": [{"kind": "hysteresis", "joint": 2, "cosine": 0.931}], "p_family": 0.001,
       "validation_before_mm": 0.771, "validation_after_mm": 0.402},
      {"round": 2, "verdict": "none", "effect": null, "rivals": [], "p_family": 0.4}])");
  json["not_found"] =
      Json::parse(R"([{"kind": "coupling", "joint": 5, "smallest_detectable": 0.000038, "unit": "rad"}])");
  const std::string page = loop_page_of(json);
  EXPECT_THAT(table_of(page, "rounds"),
              ElementsAre(ElementsAre("1", "added", "backlash, joint 2", "", "0.001", "0.771", "0.402", "-48\u00A0%",
                                      "hysteresis, joint 2 (cosine 0.93)"),
                          ElementsAre("2", "not significant", "", "", "0.4", "–", "–", "–", "")));
  EXPECT_THAT(table_of(page, "not-found"),
              ElementsAre(ElementsAre("coupling, joint 5", "3.8e-05", "rad", "7.8 arcsec")));
  EXPECT_THAT(table_of(page, "errors"), SizeIs(6)) << "the stage with the effects found stands beside the others";
  EXPECT_THAT(words_of(page), HasSubstr("shows no more structure"));
}

TEST(LoopPage, NamesGroupsOnlyWhereRoundsWereJudgedTogether) {
  Report report = made_up_looped_report(7);
  const auto heads = [&report] { return all_between(loop_page_of(report), "judged against the same", "p ="); };
  EXPECT_THAT(heads(), SizeIs(3)) << "nine rounds, four to a group";
  for (RoundEntry& round : report.rounds) round.group = round.round;
  EXPECT_THAT(heads(), IsEmpty());
}

TEST(LoopPage, LetsLongTablesScrollBelowTheirHeads) {
  EXPECT_THAT(loop_page_of(made_up_looped_report(40)), HasSubstr("<div class=\"panel long\"><table id=\"rounds\""));
  EXPECT_THAT(loop_page_of(made_up_looped_report(5)), HasSubstr("<div class=\"panel\"><table id=\"rounds\""));
}

TEST(LoopPage, ShowsWhatWasNotFoundNotSeenAndNotTrue) {
  const Report report = made_up_looped_report();
  const std::string page = loop_page_of(report);
  EXPECT_THAT(table_of(page, "not-found"), SizeIs(report.not_found.size()));
  EXPECT_THAT(table_of(page, "unseen"), ElementsAre(ElementsAre("thermal_offset", "no temperature column"),
                                                    ElementsAre("thermal_length", "no temperature column"),
                                                    ElementsAre("drift", "no time column")));
  EXPECT_THAT(table_of(page, "decoys"),
              ElementsAre(ElementsAre("backlash of joint 2 by shuffled approach signs", "1.2", "did not win"),
                          ElementsAre("a gear ratio no gear has", "-0.5", "did not win")));
  const std::string words = words_of(page);
  EXPECT_THAT(words, HasSubstr("Round 1, backlash, joint 2: " + report.rounds[0].next_measurement->sentence));
  EXPECT_THAT(words, HasSubstr("gear_harmonic (ratio 77), joint 5"));
  EXPECT_THAT(words, HasSubstr("1\u202F312 effects were tried in every round against 999 draws of the noise"));
  EXPECT_THAT(words, HasSubstr("6 were added"));
}

TEST(LoopPage, EscapesEveryTextBesidesTheWordsItKnows) {
  const std::string evil = "</td><script>alert('x')</script>\" onload=\"&amp;";
  const std::function<void(Json&)> poison = [&](Json& json) {
    if (json.is_string() && json != "added" && json != "gear_harmonic") json = evil;
    if (json.is_structured()) {
      for (Json& child : json) poison(child);
    }
  };
  Json json = Json::parse(to_json(made_up_looped_report()));
  poison(json);
  const std::string page = loop_page_of(json);
  EXPECT_THAT(page, HasSubstr("class=\"fall\""));
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("\" onload")));
  EXPECT_EQ(unbalanced(page), "");
}

TEST(LoopPage, IsWellFormedWithoutNumbers) {
  LoopOutcome loop = made_up_loop(5);
  for (Round& round : loop.rounds) {
    round.validation_before_mm = round.validation_after_mm = round.p_family = std::nan("");
    for (double& value : round.effect.values) value = std::nan("");
  }
  const std::string page = loop_page_of(loop);
  EXPECT_EQ(unbalanced(page), "");
  EXPECT_THAT(page, Not(HasSubstr("nan")));
  EXPECT_THAT(page, Not(HasSubstr("class=\"fall\"")));
}

/// The picture of the error over the rounds; empty where the page has none.
std::string loop_chart_of(const Report& report) {
  const std::string page = loop_page_of(report);
  const std::size_t label = page.find("validation poses over the rounds of the closed loop");
  if (label == std::string::npos) return {};
  const std::size_t begin = page.rfind("<svg", label);
  return page.substr(begin, page.find("<figcaption>", label) - begin);
}

TEST(LoopChart, StepsDownToTheErrorAfterEveryAddedRound) {
  const Report report = made_up_looped_report(9);
  const std::string chart = loop_chart_of(report);
  const std::vector<Points> lines = lines_of(chart, "fall");
  ASSERT_THAT(lines, SizeIs(1));
  const Points& line = lines[0];
  ASSERT_EQ(line.size(), 1 + 2 * 10 + 1u) << "the start, two per added round, one for the rejected";
  const double first = *report.rounds[0].validation_before_mm, last = *report.rounds[9].validation_after_mm;
  const double px_per_mm = (line.back().second - line[0].second) / (first - last);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(line[2 * i + 2].second, line[0].second + px_per_mm * (first - *report.rounds[i].validation_after_mm),
                0.02);
    EXPECT_EQ(line[2 * i + 2].first, line[2 * i + 1].first);
    EXPECT_GT(line[2 * i + 1].first, line[2 * i].first);
  }
  EXPECT_THAT(all_between(chart, "class=\"added\"", "/circle>"), SizeIs(10));
  EXPECT_THAT(all_between(chart, "class=\"refused\"", "/circle>"), SizeIs(1));
  EXPECT_THAT(all_between(chart, "class=\"noise\"", "/>"), SizeIs(1));
  EXPECT_EQ(unbalanced(chart), "");
}

TEST(LoopChart, IsThereOnlyWhereARoundAddedSomething) {
  LoopOutcome loop = made_up_loop(0);
  loop.rounds.erase(loop.rounds.begin());
  EXPECT_EQ(loop_chart_of(made_up_looped_report(loop)), "");
  EXPECT_NE(loop_chart_of(made_up_looped_report(0)), "");
}

TEST(HarmonicsChart, HasAStemForEveryHarmonicOnOneScale) {
  const Report report = made_up_looped_report(14);
  const std::string page = loop_page_of(report);
  EXPECT_THAT(all_between(page, "<circle class=\"stem\"", "</circle>"), SizeIs(14));
  EXPECT_THAT(all_between(page, "Amplitudes of the gear harmonics of joint", "\""), ElementsAre(" 1", " 2", " 3"));
  std::vector<double> ratios;  // of height to amplitude
  for (const std::string& stem : all_between(page, "<line class=\"stem\"", "</circle>")) {
    const double foot = std::stod(all_between(stem, "y1=\"", "\"").at(0)),
                 top = std::stod(all_between(stem, "y2=\"", "\"").at(0));
    const std::string words = all_between(stem, "per turn: ", "<").at(0);
    ratios.push_back((foot - top) / (std::stod(words) * (words.find(" µ") != std::string::npos ? 1e-3 : 1.0)));
  }
  for (const double ratio : ratios) EXPECT_NEAR(ratio, ratios[0], 0.02 * ratios[0]);
  EXPECT_THAT(all_between(loop_page_of(made_up_looped_report(0)), "class=\"stem\"", ">"), IsEmpty());
}

TEST(LoopPage, SaysHowMeasurementsScatterAndWhatControlsMean) {
  Report report = made_up_looped_report(5);
  ASSERT_TRUE(report.noise.has_value());
  report.noise->shared_in_order_mm = 0.031;
  report.decoys.at(0).p_left = 0.004;
  const std::string page = loop_page_of(report);
  EXPECT_THAT(page, HasSubstr("poses measured one after another share 0.031 mm"));
  EXPECT_THAT(page, HasSubstr("none of the effects is sure"));
  EXPECT_THAT(all_between(page, "id=\"doubt\">", "</p>"), ElementsAre(HasSubstr("None of the effects is sure")));
  EXPECT_THAT(loop_page_of(made_up_looped_report(5)), Not(HasSubstr("id=\"doubt\"")));
}

TEST(LoopWords, HaveASentenceForEveryReason) {
  for (const StopReason reason :
       {StopReason::no_structure, StopReason::no_gain, StopReason::max_effects, StopReason::decoy}) {
    EXPECT_THAT(stop_sentence(to_string(reason)), Not(HasSubstr(to_string(reason))));
    EXPECT_THAT(stop_sentence(to_string(reason)), HasSubstr("The loop stopped "));
  }
  EXPECT_EQ(stop_sentence(to_string(StopReason::not_run)), "");
  EXPECT_EQ(statistics_sentences(Report{}), "");
}

TEST(LoopWords, DoNotDenyDependenceOnTimeBesideWhatGoesByTheOrderOfMeasuring) {
  Report report;
  report.structure_left_p = 0.22;
  EXPECT_THAT(statistics_sentences(report), HasSubstr("approach, temperature or time was detected"));
  report.noise.emplace().shared_in_order_mm = 0.0;
  EXPECT_THAT(statistics_sentences(report), HasSubstr("approach, temperature or time was detected"));
  report.noise->shared_in_order_mm = 0.153;
  EXPECT_THAT(statistics_sentences(report), HasSubstr("Beside the 0.153 mm that goes by the order of measuring"));
  EXPECT_THAT(statistics_sentences(report), Not(HasSubstr("time was detected")));
}

TEST(ReportPage, SaysThatARunWasInterrupted) {
  Report report = made_up_report();
  EXPECT_THAT(words_of(loop_page_of(report)), Not(HasSubstr("interrupted")));
  report.runtime.interrupted = true;
  EXPECT_THAT(words_of(loop_page_of(report)), HasSubstr("The run was interrupted"));
}

}  // namespace
}  // namespace demecal
