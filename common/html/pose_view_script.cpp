
#include <string_view>

#include "html/sections.hpp"

namespace demecal::inline html {

std::string_view pose_view_script() {
  return R"js(
const viewed = data.p.length === 3 * count && count > 0;
const view = {turn: -0.7, tilt: 0.45, zoom: 1, places: []};

/// Placements are three rows of four numbers; joints turn about z, or slide along it.
const times = (a, b) => {
  const product = new Array(12);
  for (let r = 0; r < 3; ++r) {
    for (let c = 0; c < 4; ++c) {
      product[4 * r + c] = a[4 * r] * b[c] + a[4 * r + 1] * b[4 + c] + a[4 * r + 2] * b[8 + c] + (c === 3 ? a[4 * r + 3] : 0);
    }
  }
  return product;
};
const motion = (type, value) => {
  if (type === "prismatic") return [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, value];
  const c = Math.cos(value * Math.PI / 180), s = Math.sin(value * Math.PI / 180);
  return [c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, 0];
};
const armAt = i => {
  const joints = data.arm.joints, points = [];
  let frame = data.arm.base;
  const note = () => points.push([frame[3], frame[7], frame[11]]);
  note();
  const commanded = data.q.slice(i * joints.length, (i + 1) * joints.length), driven = commanded.slice();
  for (const [joint, from, factor] of data.arm.couplings) driven[joint - 1] += factor * commanded[from - 1];
  joints.forEach((joint, k) => {
    frame = times(frame, joint.placement);
    note();
    frame = times(frame, motion(joint.type, driven[k]));
  });
  frame = times(frame, data.arm.flange);
  note();
  const t = data.arm.tool;
  frame = times(frame, [1, 0, 0, t[0], 0, 1, 0, t[1], 0, 0, 1, t[2]]);
  note();
  return points;
};

const bounds = (() => {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  const widen = place => place.forEach((value, k) => {
    low[k] = Math.min(low[k], value);
    high[k] = Math.max(high[k], value);
  });
  for (let i = 0; viewed && i < count; ++i) widen(data.p.slice(3 * i, 3 * i + 3));
  const points = {low: low.slice(), high: high.slice()};
  if (viewed && data.arm) for (const place of armAt(0)) widen(place);
  return {points, middle: low.map((value, k) => (value + high[k]) / 2), size: Math.max(1, Math.hypot(...high.map((value, k) => value - low[k])))};
})();
const centrePose = () => {
  let best = 0, least = Infinity;
  for (let i = 0; i < count; ++i) {
    const away = Math.hypot(...[0, 1, 2].map(k => data.p[3 * i + k] - (bounds.points.low[k] + bounds.points.high[k]) / 2));
    if (away < least) { least = away; best = i; }
  }
  return best;
};
const resting = viewed ? centrePose() : -1;

/// The axis that is sliced, the middle of the slice and half its thickness, mm; nothing where all is shown.
const sliceNow = () => {
  const axis = byId("view-slice").value;
  if (axis === "") return null;
  const k = Number(axis), low = bounds.points.low[k], high = bounds.points.high[k];
  return {k, at: low + Number(byId("view-slice-at").value) / 100 * (high - low), half: Math.max(0.06 * (high - low), 1e-9)};
};
const inSlice = (i, slice) => slice === null || Math.abs(data.p[3 * i + slice.k] - slice.at) <= slice.half;

const paintView = (pen, width, height) => {
  const factor = 10 ** Number(byId("view-exaggeration").value), which = byId("view-vectors").value;
  byId("view-factor").textContent = "\u00D7 " + (factor < 10 ? factor.toFixed(1) : factor.toFixed(0));
  const byBefore = byId("view-colour").value === "before", errors = byBefore ? data.before : data.after;
  const top = Math.max(share(sorted(errors), 0.95), 1e-9);
  const ct = Math.cos(view.turn), st = Math.sin(view.turn), ci = Math.cos(view.tilt), si = Math.sin(view.tilt);
  const scale = 0.92 * view.zoom * Math.min(width, height) / bounds.size;
  const place = (x, y, z) => {
    const u = x - bounds.middle[0], v = y - bounds.middle[1], w = z - bounds.middle[2];
    const right = ct * u - st * v, away = st * u + ct * v;
    return [width / 2 + scale * right, height / 2 - scale * (ci * w + si * away), ci * away - si * w];
  };
  const line = (places, style, thick) => {
    pen.strokeStyle = style;
    pen.lineWidth = thick;
    pen.lineJoin = "round";
    pen.beginPath();
    places.forEach((at, k) => k === 0 ? pen.moveTo(at[0], at[1]) : pen.lineTo(at[0], at[1]));
    pen.stroke();
  };
  const shown = [], slice = sliceNow();
  for (const i of chosen.rows) {
    if (errors[i] === null || !inSlice(i, slice)) continue;
    const p = [data.p[3 * i], data.p[3 * i + 1], data.p[3 * i + 2]], at = place(...p);
    shown.push([at[0], at[1], i, at[2], p]);
  }
  shown.sort((a, b) => b[3] - a[3]);
  view.places = shown;
  byId("view-slice-place").textContent = slice === null ? "" : "xyz"[slice.k] + " = " + slice.at.toFixed(0) + " \u00B1 " +
    slice.half.toFixed(slice.half < 10 ? 1 : 0) + " mm, " + shown.length + " " + (targets < 2 ? "poses" : "measurements");
  const vectors = (error, style) => {
    if (error.length !== 3 * count) return;
    pen.strokeStyle = style;
    pen.lineWidth = 1;
    pen.beginPath();
    for (const one of shown) {
      const k = 3 * one[2], p = one[4];
      const end = place(p[0] + factor * error[k], p[1] + factor * error[k + 1], p[2] + factor * error[k + 2]);
      pen.moveTo(one[0], one[1]);
      pen.lineTo(end[0], end[1]);
    }
    pen.stroke();
  };
  pen.globalAlpha = 0.75;
  if (which === "before" || which === "both") vectors(data.eb, colour("--soft"));
  if (which === "after" || which === "both") vectors(data.ea, colour("--accent"));
  pen.globalAlpha = 1;
  const dot = shown.length > 3000 ? 1.4 : 2.4, colours = Array.from({length: 65}, (_, k) => heat(k / 64));
  for (const one of shown) {
    pen.fillStyle = colours[Math.min(64, Math.round(64 * errors[one[2]] / top))];
    if (shown.length > 3000) {
      pen.fillRect(one[0] - dot, one[1] - dot, 2 * dot, 2 * dot);
      continue;
    }
    pen.beginPath();
    pen.arc(one[0], one[1], dot, 0, 7);
    pen.fill();
  }
  const at = chosen.at === -1 ? resting : chosen.at;
  if (data.arm) {
    const arm = armAt(at).map(p => place(...p));
    pen.globalAlpha = 0.55;
    line(arm, colour("--ink"), 4);
    pen.globalAlpha = 1;
    pen.fillStyle = colour("--ink");
    for (const joint of arm) { pen.beginPath(); pen.arc(joint[0], joint[1], 3.2, 0, 7); pen.fill(); }
  }
  if (chosen.at !== -1) {
    const p = place(data.p[3 * at], data.p[3 * at + 1], data.p[3 * at + 2]);
    pen.strokeStyle = colour("--jump");
    pen.lineWidth = 2;
    pen.beginPath();
    pen.arc(p[0], p[1], 7, 0, 7);
    pen.stroke();
  }
  ["x", "y", "z"].forEach((name, k) => {
    const axis = [0, 1, 2].map(j => bounds.middle[j] + (j === k ? 1 : 0)), end = place(...axis);
    const x = 34 + (end[0] - width / 2) / scale * 24, y = height - 34 + (end[1] - height / 2) / scale * 24;
    line([[34, height - 34], [x, y]], colour("--soft"), 1.5);
    pen.fillStyle = colour("--soft");
    pen.fillText(name, x + 3, y + 3);
  });
  for (let k = 0; k <= 60; ++k) { pen.fillStyle = heat(k / 60); pen.fillRect(10 + k * 2, 10, 2, 8); }
  pen.fillStyle = colour("--soft");
  pen.fillText("0", 10, 31);
  pen.textAlign = "right";
  pen.fillText(top.toFixed(top < 1 ? 3 : 2) + " mm and more", 132 + 60, 31);
  pen.textAlign = "left";
};

if (viewed) {
  const canvas = byId("view-canvas");
  const longest = share(sorted(data.after), 0.95);
  byId("view-exaggeration").value = Math.log10(Math.min(1e4, Math.max(1, 0.06 * bounds.size / Math.max(longest, 1e-6)))).toFixed(2);
  picture(canvas, Math.min(520, Math.max(300, canvas.clientWidth * 0.62)), paintView);
  hover(canvas, () => view.places);
  const turn = (right, up) => {
    view.turn += right;
    view.tilt = Math.min(1.57, Math.max(-1.57, view.tilt + up));
    redraw();
  };
  const zoom = factor => { view.zoom = Math.min(40, Math.max(0.3, view.zoom * factor)); redraw(); };
  const actions = {left: () => turn(-0.2, 0), right: () => turn(0.2, 0), up: () => turn(0, 0.15), down: () => turn(0, -0.15),
    nearer: () => zoom(1.25), further: () => zoom(0.8), reset: () => { Object.assign(view, {turn: -0.7, tilt: 0.45, zoom: 1}); redraw(); }};
  for (const button of document.querySelectorAll("[data-view]")) button.addEventListener("click", actions[button.dataset.view]);
  const keys = {ArrowLeft: "left", ArrowRight: "right", ArrowUp: "up", ArrowDown: "down", "+": "nearer", "-": "further"};
  canvas.addEventListener("keydown", event => {
    if (!keys[event.key]) return;
    event.preventDefault();
    actions[keys[event.key]]();
  });
  canvas.addEventListener("pointerdown", event => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener("pointermove", event => {
    if (event.buttons === 1) turn(event.movementX * 0.01, event.movementY * 0.01);
  });
  canvas.addEventListener("wheel", event => {
    if (document.activeElement !== canvas) return;  // a page must scroll past it
    event.preventDefault();
    zoom(event.deltaY > 0 ? 0.9 : 1.1);
  }, {passive: false});
  for (const id of ["view-exaggeration", "view-vectors", "view-colour", "view-slice", "view-slice-at"])
    byId(id).addEventListener("input", redraw);
} else {
  byId("view").hidden = true;
}
)js";
}

}  // namespace demecal::inline html
