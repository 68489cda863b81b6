// The page fits the terminal it is made for, and every figure that it should show is on it.
#include "terminal/monitor_page.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "made_up_run.hpp"
#include "terminal/text.hpp"

namespace demecal {
namespace {

using Lines = std::vector<std::string>;

PageOptions page_of(std::size_t columns, std::size_t lines = 0) {
  return {.columns = columns, .lines = lines, .colours = false, .now_s = 2.0, .place = "domain 3"};
}

std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string without_codes(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\033')
      i = text.find('m', i);
    else
      plain += text[i];
  }
  return plain;
}

TEST(MonitorPage, SaysThatNobodyIsThere) {
  const Lines lines = monitor_page(Watched(), page_of(80));
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("nobody is calibrating in domain 3"), std::string::npos);
}

TEST(MonitorPage, IsNeverWiderThanTheTerminal) {
  for (const std::uint32_t demes : {1u, 2u, 3u, 16u, 200u}) {
    const Watched watched = watched_after(made_up_messages(made_up_data(6, demes)));
    for (std::size_t columns = 40; columns <= 240; columns += 7) {
      for (const std::string& line : monitor_page(watched, page_of(columns))) {
        EXPECT_LE(display_width(line), columns) << line;
      }
    }
  }
}

TEST(MonitorPage, IsNeverHigherThanTheTerminal) {
  for (const std::uint32_t joints : {1u, 6u, 7u, 40u}) {
    const Watched watched = watched_after(made_up_messages(made_up_data(joints, 3)));
    for (std::size_t lines = 10; lines <= 80; lines += 5) {
      EXPECT_LE(monitor_page(watched, page_of(80, lines)).size(), lines);
    }
  }
}

TEST(MonitorPage, ShowsEveryFigureOfEveryIslandOnEightyAndOnAHundredAndFortyColumns) {
  const CalibrationData data = made_up_data();
  const std::vector<Message> messages = made_up_messages(data);
  const Watched watched = watched_after(messages);
  for (const std::size_t columns : {80u, 140u}) {
    const std::string page = joined(monitor_page(watched, page_of(columns)));
    for (const auto& [key, island] : watched.run()->islands) {
      for (const std::string& figure :
           {std::to_string(island.generation), short_real(island.figures.best), short_real(island.figures.median),
            percent(island.figures.diversity), short_count(island.evaluations_per_s),
            short_count(static_cast<double>(island.migrants_sent)),
            short_count(static_cast<double>(island.migrants_taken)), percent(island.waited_share)}) {
        EXPECT_NE(page.find(" " + figure), std::string::npos) << figure;
      }
    }
    for (const WatchedWorker* worker : watched.workers()) {
      EXPECT_NE(page.find(worker->status.host), std::string::npos);
    }
    for (const char* const word : {"puma761-demo", "evolving", "left", "lost", "backlash, joint 2", "0.354 -> 0.233",
                                   "rejected", "eval/s", "joint 6"}) {
      EXPECT_NE(page.find(word), std::string::npos) << word << "\n" << page;
    }
  }
}

TEST(MonitorPage, StandsIslandsOfAJointSideBySideWhereTheyFit) {
  const Watched watched = watched_after(made_up_messages(made_up_data(6, 2)));
  const auto grid = [&](std::size_t columns) {
    return island_grid(*watched.run(), watched.workers(), {.columns = columns, .lines = 0, .colours = false});
  };
  EXPECT_EQ(grid(80).size(), 1u + 12u);
  EXPECT_EQ(grid(140).size(), 1u + 6u);
}

TEST(MonitorPage, ShowsLessOfEachIslandBeforeItLeavesIslandsOut) {
  const Watched watched = watched_after(made_up_messages(made_up_data(6, 8)));
  const auto grid = [&](std::size_t lines) {
    return joined(island_grid(*watched.run(), watched.workers(), {.columns = 80, .lines = lines, .colours = false}));
  };
  EXPECT_NE(grid(0).find("median"), std::string::npos);
  EXPECT_EQ(grid(20).find("median"), std::string::npos);
  EXPECT_EQ(grid(20).find("more"), std::string::npos);
  EXPECT_NE(grid(20).find("joint 6"), std::string::npos);
  EXPECT_NE(grid(5).find("islands more"), std::string::npos);
}

TEST(MonitorPage, ShowsTheCausesThatWereFoundTheCostliestFirst) {
  Watched watched = watched_after(made_up_messages(made_up_data()));
  EXPECT_EQ(joined(monitor_page(watched, page_of(100))).find("cause"), std::string::npos);
  EXPECT_TRUE(cause_lines(nullptr, {}).empty());
  for (const Message& found : made_up_findings()) watched.take(found, 1.0);
  for (const std::size_t columns : {80u, 140u}) {
    const std::string page = joined(monitor_page(watched, page_of(columns)));
    for (const char* const word : {"2 causes of error", "lost motion of joint 2", "0.417 -> 0.262", "– -> –"})
      EXPECT_NE(page.find(word), std::string::npos) << word << "\n" << page;
  }
  const Lines cut = cause_lines(watched.calibration(), {.columns = 80, .rows = 1, .colours = false});
  ASSERT_EQ(cut.size(), 2u);
  EXPECT_NE(cut[1].find("joint 2"), std::string::npos);
  for (std::size_t columns = 40; columns <= 240; columns += 7)
    for (const std::string& line : monitor_page(watched, page_of(columns))) EXPECT_LE(display_width(line), columns);
}

std::string in_one_line(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) {
    const std::size_t begin = line.find_first_not_of(' ');
    if (begin != std::string::npos) text += (text.empty() ? "" : " ") + line.substr(begin);
  }
  return text;
}

TEST(MonitorPage, CutsNoSentenceWhereItsLinesAreNotLimited) {
  Watched watched = watched_after(made_up_messages(made_up_data()));
  for (const Message& found : made_up_findings()) watched.take(found, 1.0);
  LoopNews longer = made_up_round(3, LoopNews::Verdict::none);
  longer.label = "elasticity of the third joint in every direction that a wrench of the tool's weight has";
  longer.text = "Joint 2 stops 0.225 mrad (46 arcsec) short on either side of where it was sent: backlash of its gear.";
  watched.take(longer, 1.0);
  for (std::size_t columns = 40; columns <= 240; columns += 7) {
    const Lines lines = monitor_page(watched, page_of(columns));
    for (const std::string& line : lines) EXPECT_LE(display_width(line), columns) << line;
    const std::string page = in_one_line(lines);
    for (const std::string& text : {longer.label, longer.text, std::string("not significant")})
      EXPECT_NE(page.find(text), std::string::npos) << columns << "\n" << page;
    EXPECT_EQ(page.find("none"), std::string::npos) << page;
  }
}

TEST(MonitorPage, SaysWhatItsColumnsMeanWhereThatIsAskedFor) {
  const Watched watched = watched_after(made_up_messages(made_up_data(6, 8)));
  PageOptions options = page_of(80, 24);
  options.keys = true;
  const std::string without = joined(monitor_page(watched, options));
  EXPECT_EQ(without.find("gen: "), std::string::npos);
  EXPECT_TRUE(without.ends_with("q: leave, the run goes on   ?: what the columns mean\n")) << without;
  options.legend = true;
  for (const std::size_t columns : {40u, 80u, 140u}) {
    options.columns = columns;
    const Lines lines = monitor_page(watched, options);
    EXPECT_LE(lines.size(), 24u);
    for (const std::string& line : lines) EXPECT_LE(display_width(line), columns) << line;
    const std::string page = in_one_line(lines);
    for (const char* const column : {"gen: ", "best, median: ", "diff: ", "eval/s: ", "sent, took: ", "wait: ", "by: "})
      EXPECT_NE(page.find(column), std::string::npos) << column << "\n" << page;
  }
}

TEST(MonitorPage, ShowsEveryFurtherEvolutionAfterTheFullBarsOfThoseDone) {
  const CalibrationData data = made_up_data();
  Watched watched = watched_after(made_up_messages(data));
  EXPECT_EQ(progress_bar(watched, 80, false).find(" done"), std::string::npos);
  for (const RunId further : {data.run + 1, data.run + 2}) {
    LoopNews stage = made_up_stage(LoopNews::Stage::evolving, "closing the loop: evolution 2");
    stage.run = further;
    CalibrationData next = data;
    next.run = further;
    watched.take(stage, 3.0);
    watched.take(next, 3.0);
    const std::size_t done = further - data.run;
    const std::string bar = progress_bar(watched, 80, false);
    EXPECT_EQ(display_width(bar), 80u);
    EXPECT_NE(bar.find(fmt::format("  0% ({} evolution{} done)", done, done == 1 ? "" : "s")), std::string::npos)
        << bar;
    std::size_t full = 0;
    for (std::size_t at = bar.find("━ "); at != std::string::npos; at = bar.find("━ ", at + 1)) ++full;
    EXPECT_EQ(full, done) << bar;
  }
}

TEST(MonitorPage, ColoursChangeNoLetter) {
  const Watched watched = watched_after(made_up_messages(made_up_data()));
  PageOptions coloured = page_of(120);
  coloured.colours = true;
  const Lines with = monitor_page(watched, coloured), plain = monitor_page(watched, page_of(120));
  ASSERT_EQ(with.size(), plain.size());
  EXPECT_NE(with, plain);
  for (std::size_t i = 0; i < with.size(); ++i) EXPECT_EQ(without_codes(with[i]), plain[i]);
}

TEST(MonitorPage, SaysWhenTheCoordinatorIsGone) {
  Watched watched = watched_after(made_up_messages(made_up_data()));
  watched.take(CalibrationLost{kCalibration}, 3.0);
  const std::string page = joined(monitor_page(watched, page_of(100)));
  EXPECT_NE(page.find("coordinator is gone: waiting for the next"), std::string::npos) << page;
  EXPECT_EQ(page.find(" left\n"), std::string::npos) << page;
}

TEST(ShortFigures, AreNeverLongerThanTheirColumn) {
  RandomStream random{21};
  for (int i = 0; i < 2000; ++i) {
    const double value = std::pow(10.0, random.real(-12.0, 12.0));
    EXPECT_LE(short_real(value).size(), 7u) << value;
    EXPECT_LE(short_count(value).size(), 5u) << value;
    EXPECT_NEAR(std::stod(short_real(value)), value, 0.06 * value);
  }
  EXPECT_EQ(short_count(999.0), "999");
  EXPECT_EQ(short_count(999.6), "1.00k");
  EXPECT_EQ(short_real(0.0123456), "0.01235");
  EXPECT_EQ(short_time(59.6), "1 min 0 s");
  EXPECT_EQ(percent(2.0), "100%");
}

}  // namespace
}  // namespace demecal
