#include <algorithm>
#include <sstream>

#include "../protocol/small_run.hpp"
#include "data/csv.hpp"
#include "errors/input_error.hpp"
#include "expression/shared_function.hpp"
#include "expression/text.hpp"
#include "expression/tree.hpp"
#include "monitor/events.hpp"
#include "monitor/watched.hpp"
#include "scheduling/run_journal.hpp"
#include "scheduling/run_state.hpp"
#include "symbolic/calculus.hpp"
#include "symbolic/parse_expression.hpp"
#include "symbolic/printing.hpp"
#include "tables/guess_columns.hpp"
#include "tables/read_table.hpp"
#include "tables/time_stamp.hpp"
#include "targets.hpp"
#include "terminal/monitor_page.hpp"

namespace demecal::fuzz {
namespace {

void read_formula(std::string_view bytes) {
  const VariableNames names{"theta", "q1", "s"};
  try {
    const Tree tree = parse(bytes, names);
    demand(is_valid(tree, static_cast<int>(names.size())), "what is parsed is a formula");
    demand(parse(to_string(tree, names), names) == tree, "a formula comes back from its text");
  } catch (const InputError&) {
  }
}

/// A definition on the first line, and a formula that may call it.
void read_definition(std::string_view bytes) {
  const std::size_t end = std::min(bytes.find('\n'), bytes.size());
  try {
    const std::vector<SharedFunction> functions{parse_definition(bytes.substr(0, end), 0)};
    demand(parse_definition(definition_text(functions[0], 0), 0) == functions[0], "a definition comes back");
    const Tree tree = parse(bytes.substr(end), theta_only(), functions);
    const FoldedFormula formula = folded(tree, functions);
    demand(in_order(parse(to_string(formula), theta_only(), functions)) == in_order(tree), "calls come back");
  } catch (const InputError&) {
  }
}

void read_expression(std::string_view bytes) {
  try {
    Algebra algebra;
    const Expression expression = parse_expression(algebra, bytes);
    demand(!ExpressionPrinter(CodeLanguage::c)(expression).empty(), "what is parsed can be written");
    derivative(expression, "q1");
  } catch (const InputError&) {
  }
}

void read_table(std::string_view bytes) {
  CsvTable table;
  try {
    std::istringstream text{std::string(bytes)};
    table = read_csv(text, "table.csv");
  } catch (const InputError&) {
    return;
  }
  for (const CsvRow& row : table.rows)
    demand(row.fields.size() == table.columns.size(), "rows are as wide as the header");
}

void read_foreign_table(std::string_view bytes) {
  try {
    const CsvTable read = tables::read_table(bytes, "table.txt").table;
    demand(!read.rows.empty(), "a table has rows");
    for (const CsvRow& row : read.rows)
      demand(row.fields.size() == read.columns.size(), "rows are as wide as the headings");
    guess_columns(read, 6, {});
    for (const CsvRow& row : read.rows) {
      for (const std::string& field : row.fields) parse_time_stamp(field);
    }
    for (std::size_t column = 0; column < std::min<std::size_t>(read.columns.size(), 3); ++column) {
      CsvTable timed = read;
      std::optional<double> origin_s;
      write_times_as_seconds(timed, column, origin_s);
    }
  } catch (const InputError&) {
  }
}

void read_event_lines(std::string_view bytes) {
  std::istringstream lines{std::string(bytes)};
  Watched watched;
  double now_s = 0.0;
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    try {
      const auto event = read_event(line, "events.jsonl", ++number);
      if (!event) continue;
      now_s = std::max(now_s, event->time_s);
      watched.take(event->message, now_s);
      event_line(event->message, event->time_s);
    } catch (const InputError&) {
    }
  }
  for (const std::string& line : monitor_page(watched, {.columns = 80, .lines = 30, .now_s = now_s, .place = "here"}))
    demand(std::ranges::none_of(line, [](char c) { return c >= 0 && c < ' '; }), "no control character is shown");
}

void read_records_of(std::string_view bytes) {
  const RecordedJob job = read_journal(bytes);
  demand(job.sound_bytes <= bytes.size(), "no more is sound than there is");
  if (!job.identity) return;
  const std::string again = journal_of(*job.identity, job.evolutions);
  const RecordedJob reread = read_journal(again);
  demand(reread.end == JournalEnd::clean && reread.evolutions.size() == job.evolutions.size(),
         "a journal is read again");
}

/// Records are checked by their sums, which no mutation keeps: here each line of text is one, whatever it holds.
void read_record_contents(std::string_view bytes) {
  std::string journal(kJournalHead);
  while (!bytes.empty()) {
    const std::size_t size = std::min(bytes.size(), bytes.find("\n--\n"));
    journal += record_of(bytes.substr(0, size));
    bytes.remove_prefix(std::min(bytes.size(), size + 4));
  }
  read_records_of(journal);
}

JobIdentity some_identity() {
  return {.data_sha256 = "d", .job_sha256 = "j", .seed = 3, .version = "0.1.0", .asynchronous = false};
}

std::string some_journal() {
  RunState state(small_run());
  for (const std::uint32_t epochs : {1U, 3U}) state.take(checkpoint_after(small_run(), epochs));
  return journal_of(some_identity(), {state});
}

std::string some_contents() {
  std::string text;
  const std::string journal = some_journal();
  for (const std::string_view content : read_records(journal).contents) text += std::string(content) + "\n--\n";
  return text;
}

const std::string kEvents = R"json({"event": "format", "demecal_events": 1}
{"event": "run", "t_s": 0.1, "run": "7", "job": "j", "seed": 1, "population_size": 20, "generations": 9, "joints": [1, 3], "islands_per_joint": 2, "migration_interval": 3, "migrants": 2}
{"event": "progress", "t_s": 0.2, "run": "7", "joint": 1, "island": 2, "worker": "w", "epoch": 1, "generation": 3, "best_fitness": 0.5, "median_fitness": null, "best_length": 3, "evaluations": 60, "evaluations_per_s": 5, "migrants_taken": 1, "migrants_sent": 2, "diversity": 0.5, "waited_share": 0.1}
{"event": "worker", "t_s": 0.3, "worker": "w", "host": "h", "process": 3, "slots": 2, "version": "v", "leaving": false, "only_run": "7", "waited_share": 0.5}
{"event": "stage", "t_s": 0.4, "calibration": "9", "run": "7", "stage": "evolving", "job": "j", "text": "t"}
{"event": "run_state", "t_s": 0.5, "run": "7", "state": "finished", "note": "n"}
{"event": "worker_lost", "t_s": 0.6, "worker": "w"}
{"event": "cause", "t_s": 0.7, "calibration": "9", "number": 1, "cause": "lost_motion", "joint": 2, "label": "l", "without_mm": 0.4, "with_mm": null, "share_of_error": 0.5, "advice": "a"}
{"event": "final_figures", "t_s": 0.8, "calibration": "9", "job": "j", "causes": 1, "effects": 2, "validation_before_mm": 0.4, "validation_after_mm": 0.3, "accept_before_mm": null, "accept_after_mm": null}
)json";

}  // namespace

std::vector<Target> text_targets() {
  return {{"formula",
           {"0.004 * SIN(2 * theta - 1.2)", "(theta + q1) % -1e-3", "SQRTp(ABS(COS(s))) - SIGN(theta)"},
           read_formula},
          {"definition",
           {"F1(c1, c2, a1) = c1 * SIN(c2 + a1)\n0.3 * SIN(0.5 + theta) - F1(2, 3, TANH(theta))",
            "F1(a1, a2) = a1 % (a2 - a1)\nF1(F1(theta, 2), 3)"},
           read_definition},
          {"expression",
           {"-cos(PI/2)*sin(theta1)", "(a2*cos(q1) + d3^2)/(1.5e-1 - tan(x))", "sqrt(abs(q1)) - -q1*sin(q1 + PI)^2"},
           read_expression},
          {"table", {"a,b\n1,2\n\"x\"\"y\", 3\r\n# no\n"}, read_table},
          {"foreign_table",
           {"Inspection\nPoint;X [mm];Y [mm]\nA;1,5;-2\nB;3,25;4\n", "# x y z\n1.5 2 3\n4 5 6e3\n",
            "24.11.2026 10:00:01,5\t1\t2\n24.11.2026 10:00:02,5\t\"3\"\t4\n",
            std::string("\xFF\xFE"
                        "a\0;\0b\0\n\0"
                        "1\0;\0"
                        "2\0\n\0",
                        18),
            "sep=;\r\na;b\r\n\xB0;1,5\r\n"},
           read_foreign_table},
          {"events", {kEvents}, read_event_lines},
          {"journal", {some_journal()}, read_records_of},
          {"journal_contents", {some_contents()}, read_record_contents}};
}

}  // namespace demecal::fuzz
