// The arm and where it was measured, with errors enlarged: turned by dragging, nearer by the wheel or two fingers.
import {cleared, colour} from './charts.js';

const kQuiet = 0.35;  // of the canvas, around the poses

export class ArmView {
  constructor(canvas, changed) {
    this.canvas = canvas;
    this.turn = -0.7;
    this.tilt = 0.45;
    this.zoom = 1;
    this.pointers = new Map();
    canvas.addEventListener('pointerdown', event => { this.pointers.set(event.pointerId, event); canvas.setPointerCapture(event.pointerId); });
    for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, event => this.pointers.delete(event.pointerId));
    canvas.addEventListener('pointermove', event => {
      const before = this.pointers.get(event.pointerId);
      if (before === undefined) return;
      if (this.pointers.size === 1) {
        this.turn += (event.clientX - before.clientX) * 0.01;
        this.tilt = Math.max(-1.5, Math.min(1.5, this.tilt + (event.clientY - before.clientY) * 0.01));
      } else {
        this.zoom *= Math.exp((before.clientY - event.clientY) * 0.005);
      }
      this.pointers.set(event.pointerId, event);
      changed();
    });
    canvas.addEventListener('wheel', event => {
      event.preventDefault();
      this.zoom = Math.max(0.3, Math.min(8, this.zoom * Math.exp(-event.deltaY * 0.001)));
      changed();
    }, {passive: false});
  }

  /// `arm` is an event of that word, `errors` its list that is shown; the arm stands as at its pose number `pose`.
  draw(arm, errors, pose) {
    const {context, width, height} = cleared(this.canvas);
    const points = arm.poses_mm, line = arm.arms_mm[pose % Math.max(arm.arms_mm.length, 1)] ?? [];
    const {middle, reach} = remembered(arm.poses_mm, () => extentOf(arm));
    const scale = this.zoom * (1 - kQuiet) * Math.min(width, height) / (2 * reach) * 1.4;
    const ct = Math.cos(this.turn), st = Math.sin(this.turn), ci = Math.cos(this.tilt), si = Math.sin(this.tilt);
    const place = (x, y, z) => {
      x -= middle[0]; y -= middle[1]; z -= middle[2];
      const away = st * x + ct * y;
      return [width / 2 + scale * (ct * x - st * y), height / 2 - scale * (ci * z + si * away)];
    };
    const enlarged = 0.12 * reach / remembered(errors, () => largestOf(errors));
    context.fillStyle = colour('--blue');
    context.strokeStyle = colour('--warm');
    context.lineWidth = 1;
    context.beginPath();
    for (let i = 0; i + 2 < points.length; i += 3) {
      const [x, y] = place(points[i], points[i + 1], points[i + 2]);
      context.fillRect(x - 1, y - 1, 2, 2);
      if (i + 2 >= errors.length) continue;
      const end = place(points[i] + enlarged * errors[i], points[i + 1] + enlarged * errors[i + 1], points[i + 2] + enlarged * errors[i + 2]);
      context.moveTo(x, y);
      context.lineTo(end[0], end[1]);
    }
    context.stroke();
    this.drawLinks(context, line, place);
    return enlarged;
  }

  drawLinks(context, line, place) {
    context.strokeStyle = colour('--ink');
    context.lineJoin = context.lineCap = 'round';
    context.lineWidth = 5;
    context.beginPath();
    for (let i = 0; i + 2 < line.length; i += 3) {
      const at = place(line[i], line[i + 1], line[i + 2]);
      if (i === 0) context.moveTo(...at);
      else context.lineTo(...at);
    }
    context.stroke();
    context.fillStyle = colour('--good');
    for (let i = 0; i + 2 < line.length; i += 3) {
      const [x, y] = place(line[i], line[i + 1], line[i + 2]);
      context.beginPath();
      context.arc(x, y, 3.5, 0, 7);
      context.fill();
    }
  }
}

/// What does not change from one drawing to the next.
const kept = new WeakMap();
function remembered(list, make) {
  if (!kept.has(list)) kept.set(list, make());
  return kept.get(list);
}

/// The middle of the poses, and how far they and the arms reach from it.
function extentOf(arm) {
  const middle = [0, 0, 0], points = arm.poses_mm;
  let reach = 1;
  for (let i = 0; i < points.length; ++i) middle[i % 3] += points[i] * 3 / points.length;
  for (const list of [points, ...arm.arms_mm]) for (let i = 0; i < list.length; ++i) reach = Math.max(reach, Math.abs(list[i] - middle[i % 3]));
  return {middle, reach};
}

/// The 95th percentile of the errors' sizes: a single pose that is far out hides no other.
function largestOf(errors) {
  const sizes = [];
  for (let i = 0; i + 2 < errors.length; i += 3) sizes.push(Math.hypot(errors[i], errors[i + 1], errors[i + 2]));
  sizes.sort((a, b) => a - b);
  return Math.max(1e-6, sizes[Math.floor(0.95 * (sizes.length - 1))] ?? 0);
}
