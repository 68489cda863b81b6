
#include <string_view>

#include "html/sections.hpp"

namespace demecal::inline html {

std::string_view pose_core_script() {
  return R"js("use strict";
(() => {
const byId = id => document.getElementById(id);
const data = JSON.parse(byId("pose-data").textContent);
const count = data.id.length;
const all = Array.from({length: count}, (_, i) => i);
const chosen = {rows: all, at: -1};  // what the filters leave, and the pose that is pointed at or picked
const redraws = [];
let printing = false;

const paper = {"--ink": "#1b232b", "--soft": "#5c6873", "--grid": "#e9edf0", "--line": "#dde2e6", "--card": "#ffffff",
  "--accent": "#1769aa", "--jump": "#c4501b", "--calibration": "#a9b6c1", "--validation": "#1769aa", "--accept": "#d98324"};
const colour = name => printing ? paper[name] : getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const setNames = {c: "calibration", v: "validation", a: "accept"};
const setOf = i => setNames[data.set[i]];
const flagNames = ["outlier", "near singular", "outside what was measured"];
const flagsOf = i => flagNames.filter((_, bit) => data.flags[i] >> bit & 1).join(", ");
const nameOf = i => data.id[i] + (data.target[i] ? " " + data.target[i] : "");
const mm = value => value === null || value === undefined ? "\u2013" : value.toFixed(3);
const targets = new Set(data.target).size;
/// So many measurements, as poses: each may have been measured by several targets.
const poseCount = rows => targets < 2 ? rows.length + " poses" : rows.length + " measurements (" +
  new Set(rows.map(i => data.id[i])).size + " poses of " + targets + " targets)";
const known = values => values.filter(value => value !== null && value !== undefined);
const sorted = values => Float64Array.from(known(values)).sort();
const share = (ascending, part) => ascending.length === 0 ? 0
  : ascending[Math.min(ascending.length - 1, Math.floor(part * ascending.length))];

/// Green over yellow to red, from 0 to 1.
const heat = part => {
  const stops = [[42, 143, 106], [217, 186, 64], [190, 52, 40]];
  const at = 2 * Math.min(1, Math.max(0, part)), low = Math.min(1, Math.floor(at)), rest = at - low;
  return "rgb(" + stops[low].map((value, k) => Math.round(value + rest * (stops[low + 1][k] - value))).join(",") + ")";
};

const sentence = i => {
  const flags = flagsOf(i), within = data.within[i];
  return nameOf(i) + " (" + setOf(i) + "): " + mm(data.before[i]) + " mm before, " + mm(data.after[i]) + " mm after" +
    (within === null ? "" : ", 95 % within " + mm(within) + " mm") + (flags ? "; " + flags : "");
};

/// Names the pose in the line that all pictures share, and lets all of them show it.
const point = i => {
  if (i === chosen.at) return;
  chosen.at = i;
  byId("pose-name").textContent = i === -1 ? "Point at a pose, or pick one in the table." : sentence(i);
  redraw();
};

let waiting = false;
const redraw = () => {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => { waiting = false; for (const draw of redraws) draw(); });
};

/// A canvas as wide as its place and so many px high; `paint` draws on it in px of the page.
const picture = (canvas, height, paint) => {
  const draw = () => {
    const width = canvas.clientWidth, dots = window.devicePixelRatio || 1;
    if (width === 0) return;
    canvas.width = Math.round(width * dots);
    canvas.height = Math.round(height * dots);
    const pen = canvas.getContext("2d");
    pen.setTransform(dots, 0, 0, dots, 0, 0);
    pen.font = "12px system-ui, 'Segoe UI', Roboto, Arial, sans-serif";
    pen.clearRect(0, 0, width, height);
    paint(pen, width, height);
  };
  canvas.style.height = height + "px";
  redraws.push(draw);
  new ResizeObserver(redraw).observe(canvas);
  return draw;
};

/// Points at the pose nearest to the pointer among places [x, y, pose], no further than 14 px; of a finger, which is
/// broader, and comes down where it points, 24 px.
const hover = (canvas, places) => {
  const find = event => {
    const box = canvas.getBoundingClientRect(), x = event.clientX - box.left, y = event.clientY - box.top;
    let best = -1, least = (event.pointerType === "touch" ? 24 : 14) ** 2;
    for (const place of places()) {
      const away = (place[0] - x) ** 2 + (place[1] - y) ** 2;
      if (away < least) { least = away; best = place[2]; }
    }
    if (best !== -1) point(best);
  };
  canvas.addEventListener("pointermove", event => { if (event.buttons === 0) find(event); });
  canvas.addEventListener("pointerdown", find);
};

matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
addEventListener("beforeprint", () => { printing = true; for (const draw of redraws) draw(); });
addEventListener("afterprint", () => { printing = false; redraw(); });
)js";
}

std::string_view pose_table_script() {
  return R"js(
const perPage = 50;
const table = {key: "after", down: true, page: 0};
const body = byId("pose-errors").tBodies[0];
const columnOf = {id: i => nameOf(i), set: i => setOf(i), before: i => data.before[i], after: i => data.after[i],
  within: i => data.within[i], flags: i => flagsOf(i)};

const words = new Intl.Collator("en", {numeric: true});
const compare = (a, b) => {
  const x = columnOf[table.key](a), y = columnOf[table.key](b);
  if (x === null || y === null) return (x === null) - (y === null) || a - b;
  const order = typeof x === "string" ? words.compare(x, y) : x - y;
  return (table.down ? -order : order) || a - b;
};

const cell = (row, text, kind) => {
  const made = row.insertCell();
  made.textContent = text;
  if (kind) made.className = kind;
};

const show = () => {
  const pages = Math.max(1, Math.ceil(chosen.rows.length / perPage));
  table.page = Math.min(table.page, pages - 1);
  const from = table.page * perPage, rows = chosen.rows.slice(from, from + perPage);
  body.replaceChildren();
  for (const i of rows) {
    const row = body.insertRow();
    row.tabIndex = 0;
    row.dataset.pose = i;
    const head = document.createElement("th");
    head.scope = "row";
    head.textContent = nameOf(i);
    row.append(head);
    cell(row, setOf(i));
    cell(row, mm(data.before[i]));
    cell(row, mm(data.after[i]), data.within[i] !== null && data.after[i] > data.within[i] ? "bad" : "");
    cell(row, mm(data.within[i]));
    cell(row, flagsOf(i), "words");
  }
  byId("pose-pages").textContent = chosen.rows.length === 0 ? "no pose" : (from + 1) + " to " + (from + rows.length) +
    " of " + poseCount(chosen.rows);
  byId("pose-back").disabled = table.page === 0;
  byId("pose-on").disabled = table.page === pages - 1;
};

const filter = () => {
  const set = byId("pose-set").value, target = byId("pose-target").value;
  const part = byId("pose-search").value.toLowerCase(), flagged = byId("pose-flagged").checked;
  const beyond = byId("pose-beyond").checked;
  chosen.rows = all.filter(i => (!set || setOf(i) === set) && (!target || data.target[i] === target) &&
    (!part || nameOf(i).toLowerCase().includes(part)) && (!flagged || data.flags[i] !== 0) &&
    (!beyond || data.within[i] !== null && data.after[i] > data.within[i])).sort(compare);
  table.page = 0;
  show();
  redraw();
};

for (const button of document.querySelectorAll("#pose-errors thead button")) {
  button.addEventListener("click", () => {
    table.down = table.key === button.dataset.key ? !table.down : !["id", "set"].includes(button.dataset.key);
    table.key = button.dataset.key;
    for (const other of document.querySelectorAll("#pose-errors thead th")) other.removeAttribute("aria-sort");
    button.parentElement.setAttribute("aria-sort", table.down ? "descending" : "ascending");
    filter();
  });
}
for (const id of ["pose-set", "pose-target", "pose-search", "pose-flagged", "pose-beyond"])
  byId(id).addEventListener("input", filter);
byId("pose-back").addEventListener("click", () => { --table.page; show(); });
byId("pose-on").addEventListener("click", () => { ++table.page; show(); });
for (const event of ["pointerover", "focusin", "click"]) {
  body.addEventListener(event, happened => {
    const row = happened.target.closest("tr");
    if (row && row.dataset.pose !== undefined) point(Number(row.dataset.pose));
  });
}
)js";
}

}  // namespace demecal::inline html
