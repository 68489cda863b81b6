#include "html/markup.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace demecal::inline html {
namespace {

constexpr std::string_view kDash = "–";
constexpr std::string_view kReplacement = "\xEF\xBF\xBD";

std::string escaped_letter(char letter) {
  switch (letter) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return "&gt;";
    case '"':
      return "&quot;";
    case '\'':
      return "&#39;";
    default:
      const bool control = static_cast<unsigned char>(letter) < 0x20 && letter != '\n' && letter != '\t';
      return control || letter == 0x7F ? std::string(kReplacement) : std::string(1, letter);
  }
}

/// How many bytes the letter at the beginning of `text` has; 0 where they are no UTF-8.
std::size_t bytes_of_letter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned lead = byte(0);
  if (lead < 0x80U) return 1;
  if (lead < 0xC2U || lead > 0xF4U) return 0;
  const std::size_t length = lead < 0xE0U ? 2 : lead < 0xF0U ? 3 : 4;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  // Neither longer forms than a letter needs, nor halves of pairs, nor letters beyond the last.
  const unsigned least = lead == 0xE0U ? 0xA0U : lead == 0xF0U ? 0x90U : 0x80U;
  const unsigned most = lead == 0xEDU ? 0x9FU : lead == 0xF4U ? 0x8FU : 0xBFU;
  return byte(1) < least || byte(1) > most ? 0 : length;
}

/// Without the sign of a zero that rounding left.
std::string without_negative_zero(const std::string& number) {
  const bool zero = number.find_first_of("123456789") == std::string::npos;
  return zero && number.starts_with('-') ? number.substr(1) : number;
}

constexpr std::string_view kStyle = R"css(
:root {
  color-scheme: light dark;
  --page: #f6f7f8; --card: #ffffff; --ink: #1b232b; --soft: #5c6873; --line: #dde2e6; --grid: #e9edf0;
  --accent: #1769aa; --good: #1c7a4a; --good-back: #e2f3e9; --bad: #b3382c; --bad-back: #fbe7e4; --idle-back: #eceff1;
  --calibration: #a9b6c1; --validation: #1769aa; --accept: #d98324; --jump: #c4501b;
  --i0: #1769aa; --i1: #d98324; --i2: #2a8f6a; --i3: #a0479a; --i4: #7a8794; --i5: #b8a100;
}
@media screen and (prefers-color-scheme: dark) {
  :root {
    --page: #12171c; --card: #1a2128; --ink: #e6ebef; --soft: #9aa7b2; --line: #2f3942; --grid: #273038;
    --accent: #63b0ee; --good: #6fd09c; --good-back: #173528; --bad: #f08d80; --bad-back: #41211d; --idle-back: #29323a;
    --calibration: #5d6b77; --validation: #63b0ee; --accept: #eda550; --jump: #f08a55;
    --i0: #63b0ee; --i1: #eda550; --i2: #5cc59b; --i3: #d184cb; --i4: #96a3af; --i5: #d9c640;
  }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--ink); font: 15px/1.5 system-ui, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
main { max-width: 1120px; margin: 0 auto; padding: 28px 20px 56px; }
h1 { font-size: 28px; line-height: 1.2; margin: 0; font-weight: 650; }
h2 { font-size: 19px; margin: 40px 0 10px; font-weight: 650; }
h3 { font-size: 16px; margin: 22px 0 0; font-weight: 650; }
header h3 { margin: 0; }
p { margin: 6px 0; }
.soft, figcaption, .legend, .note { color: var(--soft); font-size: 13.5px; }
.headline { font-size: 21px; line-height: 1.4; margin: 18px 0 4px; max-width: 46em; }
.headline b { white-space: nowrap; color: var(--accent); font-weight: 650; }
.banner { background: var(--bad-back); color: var(--bad); padding: 8px 14px; border-radius: 8px; margin: 16px 0; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(150px, 1fr)); gap: 12px; margin: 18px 0 0; }
.tile, .panel, .joint { background: var(--card); border: 1px solid var(--line); border-radius: 10px; }
.tile { padding: 11px 14px; }
.tile .what { color: var(--soft); font-size: 13px; }
.tile .value { font-size: 23px; line-height: 1.3; font-weight: 620; font-variant-numeric: tabular-nums; white-space: nowrap; }
.tile .value small { font-size: 14px; font-weight: 400; color: var(--soft); }
.tile .from { font-size: 12.5px; color: var(--soft); font-variant-numeric: tabular-nums; }
.panel { padding: 12px 16px; margin: 12px 0; overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; font-size: 14px; }
th, td { padding: 5px 9px; text-align: right; border-bottom: 1px solid var(--grid); font-weight: 400; white-space: nowrap; }
thead th { color: var(--soft); font-size: 12.5px; vertical-align: bottom; border-bottom-color: var(--line); }
thead th.set { text-align: center; color: var(--ink); font-size: 13.5px; font-weight: 600; border-bottom: 0; }
thead th.set i { display: inline-block; width: 9px; height: 9px; border-radius: 2px; margin-right: 6px; }
.panel.long { max-height: 720px; overflow: auto; padding-top: 0; }
.long thead th { position: sticky; top: 0; background: var(--card); padding-top: 12px; }
td.words .why { display: block; color: var(--soft); font-size: 13px; } td.words.wide { min-width: 19em; }
td.numbers { text-align: left; font-size: 13px; line-height: 1.45; } td.numbers span { display: block; }
#causes :is(th:first-child, th:last-child, td:last-child) { text-align: left; } #causes :is(thead th, td:last-child) { white-space: normal; } #causes td:last-child { min-width: 16em; } #causes th[scope="row"] { white-space: normal; min-width: 9em; max-width: 22em; }
#evidence thead th { white-space: normal; } #evidence td.wide { min-width: 13em; }
td code.law { font-size: 12.5px; overflow-wrap: anywhere; }
table.compact { width: auto; min-width: 50%; }
th[scope="row"] { text-align: left; }
td.words, th.words { text-align: left; white-space: normal; }
tbody tr:last-child > * { border-bottom: 0; }
tr.total > * { font-weight: 620; border-top: 1px solid var(--line); }
tr.group th { color: var(--soft); font-size: 12.5px; padding-top: 12px; }
.first { border-left: 1px solid var(--line); }
td.faint { color: var(--soft); }
code, pre, .mono { font-family: ui-monospace, "SF Mono", Menlo, Consolas, "DejaVu Sans Mono", monospace; }
.good { color: var(--good); } .bad { color: var(--bad); }
.badge { display: inline-block; padding: 1px 9px; border-radius: 10px; font-size: 12.5px; font-weight: 550; background: var(--idle-back); color: var(--soft); }
.badge.yes { background: var(--good-back); color: var(--good); }
.badge.no { background: var(--bad-back); color: var(--bad); }
.joint { padding: 14px 16px; margin: 14px 0; }
.joint header { display: flex; flex-wrap: wrap; align-items: baseline; gap: 4px 14px; margin-bottom: 6px; font-variant-numeric: tabular-nums; }
.joint header .gain { margin-left: auto; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(330px, 1fr)); gap: 6px 22px; align-items: start; }
.pair figure:only-child { max-width: 540px; }
figure { margin: 0; min-width: 0; }
figcaption { padding-left: 4px; }
pre.formula { white-space: pre-wrap; overflow-wrap: anywhere; margin: 8px 0 0; padding: 9px 12px; border-radius: 7px; background: var(--page); font-size: 13px; line-height: 1.55; max-height: 13em; overflow-y: auto; }
pre.formula span { color: var(--soft); }
.names { list-style: none; margin: 6px 0 10px; padding: 0; display: flex; flex-wrap: wrap; gap: 5px; }
.names li { border: 1px solid var(--line); background: var(--card); border-radius: 6px; padding: 0 8px; font-size: 13px; overflow-wrap: anywhere; }
ul.plain { margin: 6px 0; padding-left: 20px; }
dl { display: grid; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: 12px 18px; margin: 0; }
dl .wide { grid-column: 1 / -1; }
dt { color: var(--soft); font-size: 13px; } dd { margin: 0; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
.legend span { display: inline-block; margin-right: 16px; }
.legend i { display: inline-block; width: 14px; height: 9px; border-radius: 2px; margin-right: 6px; }
.key.calibration { background: var(--calibration); } .key.validation { background: var(--validation); } .key.accept { background: var(--accept); }
svg.chart { display: block; width: 100%; height: auto; font: 12px system-ui, "Segoe UI", Roboto, Arial, sans-serif; fill: var(--ink); }
svg.bars { min-width: 620px; }
.chart .grid { stroke: var(--grid); stroke-width: 1; } .chart .tick, .chart .axis { fill: var(--soft); }
.chart .stage, .chart .value { font-size: 13px; font-variant-numeric: tabular-nums; }
.chart .bar.calibration { fill: var(--calibration); } .chart .bar.validation { fill: var(--validation); } .chart .bar.accept { fill: var(--accept); }
.chart .whisker { stroke: var(--soft); fill: none; stroke-width: 1.3; } .chart .cut { stroke: var(--card); fill: none; stroke-width: 3; }
.chart .noise { fill: none; stroke: var(--jump); stroke-width: 1.2; stroke-dasharray: 4 3; }
.chart .zero { stroke: var(--soft); stroke-width: 1; } .chart .jump { stroke: var(--jump); stroke-width: 1.2; stroke-dasharray: 3 3; }
.chart .fall { fill: none; stroke: var(--validation); stroke-width: 2; }
.chart circle.added { fill: var(--validation); } .chart circle.refused { fill: var(--card); stroke: var(--soft); stroke-width: 1.4; }
.chart .stem { stroke: var(--accent); stroke-width: 2.4; } .chart circle.stem { fill: var(--accent); stroke: none; }
.chart .curve { fill: none; stroke: var(--accent); stroke-width: 2; stroke-linejoin: round; }
.chart polyline.island { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
.chart polyline.i0 { stroke: var(--i0); } .chart polyline.i1 { stroke: var(--i1); } .chart polyline.i2 { stroke: var(--i2); }
.chart polyline.i3 { stroke: var(--i3); } .chart polyline.i4 { stroke: var(--i4); } .chart polyline.i5 { stroke: var(--i5); }
.chart circle.i0 { fill: var(--i0); } .chart circle.i1 { fill: var(--i1); } .chart circle.i2 { fill: var(--i2); }
.chart circle.i3 { fill: var(--i3); } .chart circle.i4 { fill: var(--i4); } .chart circle.i5 { fill: var(--i5); }
.controls { display: flex; flex-wrap: wrap; gap: 6px 16px; align-items: center; margin: 8px 0; font-size: 13.5px; color: var(--soft); }
.controls label { display: inline-flex; align-items: center; gap: 6px; max-width: 100%; } .controls label[hidden] { display: none; }
.controls input, .controls select, .controls button { font: inherit; color: var(--ink); background: var(--page); border: 1px solid var(--line); border-radius: 6px; padding: 3px 7px; min-width: 0; max-width: 100%; }
.controls input[type="range"] { padding: 0; width: 130px; } .controls button { min-width: 32px; min-height: 30px; cursor: pointer; } .controls button:disabled { opacity: 0.4; cursor: default; }
.buttons { display: inline-flex; flex-wrap: wrap; gap: 4px; } canvas { display: block; width: 100%; touch-action: pan-y; } #view-canvas { cursor: grab; }
.pose-name { position: sticky; top: 0; z-index: 1; background: var(--page); padding: 6px 0; margin: 0; min-height: 2.6em; font-variant-numeric: tabular-nums; }
.wide { overflow-x: auto; } #pose-errors thead button { font: inherit; color: inherit; background: none; border: 0; padding: 2px 0; cursor: pointer; }
#pose-errors th[aria-sort="descending"] button::after { content: " ↓"; } #pose-errors th[aria-sort="ascending"] button::after { content: " ↑"; }
#pose-errors th:first-child, #pose-errors th:nth-child(2), #pose-errors td:nth-child(2), #pose-errors th:last-child { text-align: left; } #pose-errors tbody tr[tabindex] { cursor: pointer; } #pose-errors tbody tr:hover > *, #pose-errors tbody tr:focus > * { background: var(--idle-back); }
details.folded { margin-top: 26px; border-top: 1px solid var(--line); } details.folded > summary { font-size: 19px; font-weight: 650; padding: 10px 0; cursor: pointer; }
details.folded > section > h2 { display: none; }
@media (max-width: 720px) { #causes thead { display: none; } #causes :is(tbody, tr, th, td) { display: block; text-align: left; max-width: none; border: 0; padding: 1px 0; } #causes tr { border-bottom: 1px solid var(--line); padding: 7px 0; } #causes th[scope="row"] { font-weight: 620; } #causes td::before { content: attr(data-name) ": "; color: var(--soft); } #causes td:last-child { padding-top: 3px; } }
@media (max-width: 520px) { main { padding: 18px 12px 40px; } .panel { padding: 10px; } .pair { grid-template-columns: minmax(0, 1fr); } h1 { font-size: 24px; } .headline { font-size: 18px; } .headline b { white-space: normal; } }
@media print {
  :root { color-scheme: light; --page: #ffffff; }
  body { font-size: 11pt; print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  main { max-width: none; padding: 0; }
  .joint, .tile, tr, figure { break-inside: avoid; } h2, h3 { break-after: avoid; }
  .controls, .pose-name { display: none; } details.folded::details-content { content-visibility: visible; height: auto; } .wide { overflow: visible; }
  table { font-size: 9pt; } th, td { padding: 3px 5px; } thead th { white-space: normal; font-size: 8pt; } thead th.set { font-size: 8.5pt; }
  th[scope="row"] { white-space: normal; } #errors { font-size: 7pt; } #errors :is(th, td) { padding: 2px; } svg.bars { min-width: 0; }
  :is(#rounds, #evidence) { font-size: 7.5pt; } :is(#rounds, #evidence) :is(th, td, td.wide) { white-space: normal; min-width: 0; padding: 2px 3px; }
  :is(#rounds, #evidence) :is(td.words, td.numbers, code.law) { font-size: 7.5pt; overflow-wrap: anywhere; }
  .panel, .panel.long { overflow: visible; max-height: none; padding: 6px 8px; } .long thead th { position: static; } pre.formula { max-height: none; }
}
)css";

}  // namespace

std::string escaped(std::string_view text) {
  std::string markup;
  while (!text.empty()) {
    const std::size_t bytes = bytes_of_letter(text);
    markup += bytes == 0   ? std::string(kReplacement)
              : bytes == 1 ? escaped_letter(text[0])
                           : std::string(text.substr(0, bytes));
    text.remove_prefix(std::max<std::size_t>(bytes, 1));
  }
  return markup;
}

std::string fixed(std::optional<double> value, int decimals) {
  if (!value || !std::isfinite(*value)) return std::string(kDash);
  if (std::abs(*value) >= 1e7) return fmt::format("{:.{}e}", *value, decimals);
  return without_negative_zero(fmt::format("{:.{}f}", *value, decimals));
}

std::string grouped_digits(std::uint64_t value) {
  std::string text = std::to_string(value);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, "\u202F");
  return text;
}

std::string change(std::optional<double> before, std::optional<double> after) {
  if (!before || !after || *before == 0.0) return std::string(kDash);
  const double percent = 100.0 * (*after - *before) / std::abs(*before);
  if (!std::isfinite(percent)) return std::string(kDash);
  constexpr int kMostDecimals = 3;
  int decimals = 0;  // something is left: not all of it is gone
  while (percent > -100.0 && decimals < kMostDecimals && fixed(percent, decimals) == fixed(-100.0, decimals))
    ++decimals;
  return fmt::format("{}{}\u00A0%", percent >= 0.5 ? "+" : "", fixed(percent, decimals));
}

std::string duration(double seconds) {
  if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
  const double minutes = std::floor(seconds / 60.0);
  if (minutes < 60.0) return fmt::format("{:.0f} min {:02.0f} s", minutes, std::floor(seconds - 60.0 * minutes));
  const double hours = std::floor(minutes / 60.0);
  return fmt::format("{:.0f} h {:02.0f} min", hours, minutes - 60.0 * hours);
}

std::string name_list(const std::vector<std::string>& names) {
  if (names.empty()) return {};
  std::string list = "<ul class=\"names\">";
  for (const std::string& name : names) list += "<li>" + escaped(name) + "</li>";
  return list + "</ul>\n";
}

std::string table_row(const std::string& head, const std::vector<std::string>& cells) {
  std::string row = "<tr><th scope=\"row\">" + head + "</th>";
  for (const std::string& cell : cells) row += "<td>" + cell + "</td>";
  return row + "</tr>\n";
}

std::string section(std::string_view id, std::string_view title, const std::string& body) {
  if (body.empty()) return {};
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, title, body);
}

std::string table_panel(const std::string& id, const std::string& head_cells, const std::string& rows,
                        std::size_t row_count) {
  constexpr std::size_t kMostAtOnce = 16;
  return fmt::format(
      "<div class=\"panel{}\"><table id=\"{}\">\n<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
      row_count > kMostAtOnce ? " long" : "", id, head_cells, rows);
}

std::string_view page_style() {
  return kStyle;
}

}  // namespace demecal::inline html
