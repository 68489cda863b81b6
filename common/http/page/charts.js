// Lines on a canvas: few points, no library.

const kInks = ['#3b8ed6', '#e08a1e', '#3aa655', '#c5483d', '#8a63c9', '#1aa7a7', '#c75b9b', '#8a8d1f', '#7a7f87'];
export const inkOf = place => kInks[place % kInks.length];

/// The canvas's context at the screen's resolution, cleared, and its size in CSS pixels.
export function cleared(canvas) {
  const ratio = window.devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext('2d');
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return {context, width, height};
}

export const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

export function short(value) {
  if (value === null || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size >= 1e6) return (value / 1e6).toPrecision(3) + 'M';
  if (size >= 1e4) return (value / 1e3).toPrecision(3) + 'k';
  return size !== 0 && size < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(3)));
}

export function duration(time_s) {
  const s = Math.round(time_s);
  if (s < 60) return `${s} s`;
  if (s < 3600) return `${Math.floor(s / 60)} min ${s % 60} s`;
  return `${Math.floor(s / 3600)} h ${Math.floor(s / 60) % 60} min`;
}

function logTicks(low, high) {
  const ticks = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) {
    for (const factor of [1, 2, 5]) {
      const tick = factor * 10 ** power;
      if (tick >= low && tick <= high) ticks.push(tick);
    }
  }
  return ticks;
}

/// Series {ink, points: [[x, y]], steps}, y positive on a logarithmic axis; x from x0 to x1, shown as `label` writes it.
export function drawLines(canvas, series, x0, x1, label) {
  const {context, width, height} = cleared(canvas);
  let low = Infinity, high = 0;
  for (const {points} of series) for (const [, y] of points) if (y > 0) { low = Math.min(low, y); high = Math.max(high, y); }
  if (!(high > 0)) return;
  low /= 1.1;
  high *= 1.1;
  const left = 46, right = width - 8, top = 6, bottom = height - 20, span = Math.log(high / low);
  const px = x => left + (right - left) * (x - x0) / Math.max(x1 - x0, 1e-9);
  const py = y => bottom - (bottom - top) * Math.log(y / low) / span;
  context.font = '11px system-ui, sans-serif';
  context.fillStyle = colour('--faint');
  context.strokeStyle = colour('--line');
  context.lineWidth = 1;
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  const ticks = logTicks(low, high), every = Math.ceil(ticks.length / 8) || 1;
  for (const tick of ticks.filter((_, i) => i % every === 0)) {
    context.fillText(short(tick), left - 5, py(tick));
    context.beginPath();
    context.moveTo(left, py(tick));
    context.lineTo(right, py(tick));
    context.stroke();
  }
  context.textBaseline = 'alphabetic';
  for (const share of [0, 0.5, 1]) {
    context.textAlign = ['left', 'center', 'right'][2 * share];
    context.fillText(label(x0 + share * (x1 - x0)), px(x0 + share * (x1 - x0)), height - 5);
  }
  for (const {ink, points, steps} of series) {
    context.strokeStyle = context.fillStyle = ink;
    context.lineWidth = 1.8;
    context.beginPath();
    let last = null;
    for (const [x, y] of points) {
      if (!(y > 0)) continue;
      if (last === null) context.moveTo(px(x), py(y));
      else {
        if (steps) context.lineTo(px(x), py(last));
        context.lineTo(px(x), py(y));
      }
      last = y;
    }
    if (steps && last !== null) context.lineTo(px(x1), py(last));
    context.stroke();
    if (!steps) for (const [x, y] of points) if (y > 0) context.fillRect(px(x) - 2, py(y) - 2, 4, 4);
  }
}
