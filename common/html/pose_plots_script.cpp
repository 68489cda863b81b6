
#include <string_view>

#include "html/sections.hpp"

namespace demecal::inline html {

std::string_view pose_plots_script() {
  return R"js(
const measured = targets < 2 ? "poses" : "measurements";
/// Round values within a range, about `wanted` of them.
const ticks = (low, high, wanted) => {
  const rough = Math.max((high - low) / wanted, 1e-12), power = 10 ** Math.floor(Math.log10(rough));
  const step = power * ([1, 2, 5].find(factor => factor * power >= rough * 0.999) || 10), found = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high * (1 + 1e-9) + 1e-12; ++k) found.push(k * step);
  return found;
};
const tickText = value => Number(value.toPrecision(6)).toString();
/// 1, 2 and 5 times powers of ten; over many decades the powers alone.
const logTicks = (low, high) => {
  const factors = high / low > 2000 ? [1] : high / low > 60 ? [1, 3] : [1, 2, 5], found = [];
  for (let decade = Math.floor(Math.log10(low)); decade <= Math.log10(high); ++decade) {
    for (const factor of factors) {
      const value = factor * 10 ** decade;
      if (value >= low && value <= high) found.push(value);
    }
  }
  return found;
};

/// Axes with their titles; gives back where values stand. `log`: of x.
const axes = (pen, width, height, x, y, titles, log) => {
  const left = 52, right = width - 10, top = 10, bottom = height - 36;
  const part = value => log ? Math.log(value / x[0]) / Math.log(x[1] / x[0]) : (value - x[0]) / (x[1] - x[0]);
  const px = value => left + part(value) * (right - left);
  const py = value => bottom - (value - y[0]) / (y[1] - y[0]) * (bottom - top);
  pen.lineWidth = 1;
  pen.strokeStyle = colour("--grid");
  pen.fillStyle = colour("--soft");
  pen.textAlign = "center";
  for (const tick of log ? logTicks(x[0], x[1]) : ticks(x[0], x[1], Math.max(2, Math.min(7, width / 70)))) {
    pen.beginPath(); pen.moveTo(px(tick), top); pen.lineTo(px(tick), bottom); pen.stroke();
    pen.fillText(tickText(tick), px(tick), bottom + 15);
  }
  pen.textAlign = "right";
  for (const tick of ticks(y[0], y[1], 5)) {
    pen.beginPath(); pen.moveTo(left, py(tick)); pen.lineTo(right, py(tick)); pen.stroke();
    pen.fillText(tickText(tick), left - 6, py(tick) + 4);
  }
  pen.fillText(titles[0], right, height - 5);
  pen.save();
  pen.translate(12, (top + bottom) / 2);
  pen.rotate(-Math.PI / 2);
  pen.textAlign = "center";
  pen.fillText(titles[1], 0, 0);
  pen.restore();
  pen.textAlign = "left";
  return [px, py];
};

/// The errors of the chosen poses before and after, ascending, and the range of both.
const errorsNow = () => {
  const of = values => sorted(chosen.rows.map(i => values[i])).filter(value => value > 0);
  const before = of(data.before), after = of(data.after), both = [before, after].filter(list => list.length > 0);
  if (both.length === 0) return null;
  const low = Math.min(...both.map(list => share(list, 0.005))) / 1.1, high = Math.max(...both.map(list => list[list.length - 1])) * 1.05;
  return {lists: [[before, "--calibration"], [after, "--accent"]], range: [low, Math.max(high, low * 1.5)]};
};

picture(byId("plot-histogram"), 240, (pen, width, height) => {
  const now = errorsNow();
  if (!now) return;
  const [low, high] = now.range, bins = Math.max(8, Math.min(36, Math.round(width / 16))), step = Math.log(high / low) / bins;
  const counts = now.lists.map(([list]) => {
    const heights = new Array(bins).fill(0);
    for (const value of list) ++heights[Math.max(0, Math.min(bins - 1, Math.floor(Math.log(value / low) / step)))];
    return heights;
  });
  const [px, py] = axes(pen, width, height, now.range, [0, 1.05 * Math.max(1, ...counts.flat())], ["error, mm (logarithmic)", measured], true);
  counts.forEach((heights, which) => {
    pen.fillStyle = colour(now.lists[which][1]);
    pen.globalAlpha = 0.7;
    heights.forEach((value, k) => {
      const from = px(low * Math.exp(k * step)), to = px(low * Math.exp((k + 1) * step));
      pen.fillRect(from + 0.5, py(value), to - from - 1, py(0) - py(value));
    });
    pen.globalAlpha = 1;
  });
});

picture(byId("plot-cumulative"), 240, (pen, width, height) => {
  const now = errorsNow();
  if (!now) return;
  const [px, py] = axes(pen, width, height, now.range, [0, 100], ["error, mm (logarithmic)", "% of " + measured + " within"], true);
  for (const [list, name] of now.lists) {
    pen.strokeStyle = colour(name);
    pen.lineWidth = 2;
    pen.beginPath();
    list.forEach((value, k) => {
      const x = Math.max(px(now.range[0]), px(Math.max(value, now.range[0])));
      if (k === 0) pen.moveTo(x, py(0));
      pen.lineTo(x, py(100 * (k + 1) / list.length));
    });
    pen.stroke();
  }
});

const joints = data.arm ? data.arm.joints.length : 0;
const against = {order: [i => i + 1, "order of measuring"], before: [i => data.before[i], "error before, mm"],
  temperature: [i => data.temperature[i], "temperature, \u00B0C"], time: [i => data.time[i], "time, s"]};
for (let k = 0; k < joints; ++k)
  against["joint" + k] = [i => data.q[i * joints + k], "joint " + (k + 1) + (data.arm.joints[k].type === "prismatic" ? ", mm" : ", deg")];
["x", "y", "z"].forEach((axis, k) => { against[axis] = [i => viewed ? data.p[3 * i + k] : null, "measured " + axis + ", mm"]; });

let scattered = [];
picture(byId("plot-against"), 300, (pen, width, height) => {
  const [value, title] = against[byId("plot-what").value];
  const rows = chosen.rows.filter(i => data.after[i] !== null && value(i) !== null && value(i) !== undefined);
  scattered = [];
  if (rows.length === 0) return;
  const xs = sorted(rows.map(value)), ys = sorted(rows.map(i => data.after[i]));
  const x = [xs[0], Math.max(xs[xs.length - 1], xs[0] + 1e-6)], top = ys[ys.length - 1] > 6 * share(ys, 0.95) ? 3 * share(ys, 0.95) : 1.05 * ys[ys.length - 1];
  const [px, py] = axes(pen, width, height, x, [0, Math.max(top, 1e-6)], [title, "error after, mm"], false);
  const dot = rows.length > 3000 ? 1.2 : 2.2, bins = Math.max(4, Math.min(24, Math.floor(rows.length / 8)));
  const inBins = Array.from({length: bins}, () => []);
  const ofSet = {c: colour("--calibration"), v: colour("--validation"), a: colour("--accept")};
  pen.globalAlpha = 0.75;
  for (const i of rows) {
    const at = [px(value(i)), py(Math.min(data.after[i], top)), i];
    scattered.push(at);
    pen.fillStyle = ofSet[data.set[i]];
    pen.fillRect(at[0] - dot, at[1] - dot, 2 * dot, 2 * dot);
    inBins[Math.min(bins - 1, Math.floor((value(i) - x[0]) / (x[1] - x[0]) * bins))].push(data.after[i]);
  }
  pen.globalAlpha = 1;
  pen.strokeStyle = colour("--jump");
  pen.lineWidth = 2;
  pen.beginPath();
  let begun = false;
  inBins.forEach((values, k) => {
    if (values.length < 3) return;
    const at = [px(x[0] + (k + 0.5) / bins * (x[1] - x[0])), py(Math.min(share(sorted(values), 0.5), top))];
    if (begun) pen.lineTo(...at); else pen.moveTo(...at);
    begun = true;
  });
  pen.stroke();
  const here = scattered.find(at => at[2] === chosen.at);
  if (!here) return;
  pen.strokeStyle = colour("--ink");
  pen.beginPath();
  pen.arc(here[0], here[1], 6, 0, 7);
  pen.stroke();
});
hover(byId("plot-against"), () => scattered);
byId("plot-what").addEventListener("input", redraw);
filter();
})();
)js";
}

}  // namespace demecal::inline html
