// The live page: takes events as the server tells them, and shows the present or, by the slider, any moment before it.
import {ArmView} from './arm.js';
import {drawLines, duration, inkOf, short} from './charts.js';
import {effort, emptyState, isLive, shownCalibration, shownRun, take} from './state.js';

const kPause_ms = 250;   // between two drawings
const kPlay_s = 30;      // in which the whole of what was seen is played
const kFresh_s = 2;      // how long an island is framed that took in migrants
const kMostEvents = 100000;
const $ = id => document.getElementById(id);
const token = new URLSearchParams(location.hash.slice(1)).get('token');

const events = [];
let state = emptyState(), folded = 0;  // of the events, as many as are in the state
let live = true, playing = null, drawn_ms = 0, waiting = false, session = null, last = 0, trouble = 'connecting';
let pose = 0, after = false;
let turning = false;
const armView = new ArmView($('arm'), () => {  // at once, unlike what events change
  if (turning) return;
  turning = true;
  requestAnimationFrame(() => { turning = false; drawArm(); });
});

function end_s() { return events.length === 0 ? 0 : events.at(-1).t_s ?? 0; }
function shown_s() { return live ? Infinity : end_s() * Number($('time').value) / 1000; }

/// The state at the moment that is shown.
function fold() {
  const until = shown_s();
  if (state.time_s > until) { state = emptyState(); folded = 0; }
  while (folded < events.length && (events[folded].t_s ?? 0) <= until) take(state, events[folded++]);
}

function request() {
  if (waiting) return;
  waiting = true;
  setTimeout(() => requestAnimationFrame(() => { waiting = false; drawn_ms = performance.now(); draw(); }), Math.max(0, kPause_ms - (performance.now() - drawn_ms)));
}

function text(element, words) { if (element.textContent !== words) element.textContent = words; }

function cell(row, words, style = '') {
  const made = row.insertCell();
  made.textContent = words;
  made.className = style;
  return made;
}

/// Rows as they are needed, without rebuilding what stands.
function rows(body, wanted, fill) {
  while (body.rows.length > wanted.length) body.deleteRow(-1);
  wanted.forEach((one, i) => {
    const row = body.rows[i] ?? body.insertRow(), words = fill(one);
    while (row.cells.length < words.length) cell(row, '');
    words.forEach((word, j) => text(row.cells[j], word));
    row.className = one.style ?? '';
  });
}

function drawHead(calibration, run) {
  text($('job'), calibration?.job || run?.data?.job || 'monitor');
  document.title = calibration?.job ? `${calibration.job} – demecal` : 'demecal monitor';
  let words = calibration === null ? 'nobody is calibrating yet: this page will show it' : calibration.text || calibration.stage;
  if (calibration?.lost) words = 'its coordinator is gone: waiting for the next calibration';
  const bad = calibration !== null && (calibration.lost || calibration.stage === 'failed' || calibration.stage === 'interrupted');
  text($('stage'), trouble === '' ? words : trouble);
  $('stage').className = trouble !== '' || bad ? 'bad' : calibration?.stage === 'finished' ? 'good' : '';
  const figures = run?.figures, done = Math.round(100 * (figures?.share_done ?? 0));
  $('done').style.width = `${done}%`;
  $('done').parentElement.setAttribute('aria-valuenow', String(done));
  const parts = [];
  if (figures) {
    const all = effort(state, calibration, run);
    parts.push(`${done} % of ${run.data?.generations ?? '?'} generations`, `${short(all.evaluations)} evaluations`);
    if (all.sets > 0) parts.push(`${short(all.sets)} sets of effects`);
    if (figures.evaluations_per_s > 0) parts.push(`${short(figures.evaluations_per_s)}/s`);
    if (figures.time_left_s > 0 && calibration !== null && isLive(calibration)) parts.push(`about ${duration(figures.time_left_s)} left`);
  }
  text($('figures'), parts.join(', '));
}

/// Explanations are bred on islands of their own.
const nameOf = (run, joint) => ({ sets: 'explanations', work: 'scans and draws' })[run?.data?.breeds] ?? `joint ${joint}`;

function drawError(run) {
  const joints = run?.data?.joints ?? [...(run?.curves.keys() ?? [])].sort((a, b) => a - b);
  const series = [], begins = [];
  joints.forEach((joint, i) => {
    const points = run?.curves.get(joint) ?? [];
    if (points.length === 0) return;
    begins.push(points[0][0]);
    series.push({ink: inkOf(i), steps: true, points: points.map(([t, y]) => [t, y / (points[0][1] || 1)])});
  });
  text($('errornote'), series.length === 0 ? 'no islands yet' : run?.data?.breeds === 'sets' ? 'shortest explanation, as a share of the first' : 'best fitness of each joint, as a share of its first');
  const begin = Math.min(...begins);
  drawLines($('error'), series, begin, Math.max(begin + 1, Math.min(state.time_s, run?.figures?.t_s ?? state.time_s)), t => `${duration(t)}`);
  const legend = joints.map(joint => nameOf(run, joint)).join();
  if ($('legend').dataset.joints !== legend) {
    $('legend').dataset.joints = legend;
    $('legend').replaceChildren(...joints.map((joint, i) => {
      const entry = document.createElement('span');
      entry.textContent = nameOf(run, joint);
      entry.style.color = inkOf(i);
      return entry;
    }));
  }
  drawLines($('front'), joints.map((joint, i) => ({ink: inkOf(i), steps: false, points: frontOf(run, joint)})), 0,
            Math.max(2, ...joints.flatMap(joint => [...(run?.fronts.get(joint)?.keys() ?? [])])), x => `${Math.round(x)} ${run?.data?.breeds === 'sets' ? 'effects' : 'nodes'}`);
}

/// What no shorter formula reached.
function frontOf(run, joint) {
  let best = Infinity;
  return [...(run?.fronts.get(joint) ?? [])].sort((a, b) => a[0] - b[0]).filter(([, y]) => y < best && (best = y, true));
}

const tags = new Map();
const tagOf = worker => {
  if (!tags.has(worker)) tags.set(worker, `w${tags.size + 1}`);
  return tags.get(worker);
};

function islandElement(grid, key) {
  const made = document.createElement('div');
  made.dataset.key = key;
  made.append(document.createElement('b'), document.createElement('span'), document.createElement('i'));
  grid.append(made);
  return made;
}

function drawIslands(calibration, run) {
  const grid = $('islands'), joints = run?.data?.joints ?? [], columns = run?.data?.islands_per_joint ?? 0;
  const shape = `${run?.id}:${joints}:${columns}`;
  if (grid.dataset.shape !== shape) {
    grid.dataset.shape = shape;
    grid.style.gridTemplateColumns = `auto repeat(${columns}, minmax(4.4rem, 1fr))`;
    grid.replaceChildren();
    for (const joint of joints) {
      const name = document.createElement('div');
      name.className = 'jointname';
      name.textContent = nameOf(run, joint);
      grid.append(name);
      for (let island = 1; island <= columns; ++island) islandElement(grid, `${joint}/${island}`);
    }
  }
  for (const element of grid.querySelectorAll('[data-key]')) {
    const island = run.islands.get(element.dataset.key), worker = island && state.workers.get(island.worker);
    const orphan = worker !== undefined && worker?.presence === 'lost' && island.generation < run.data.generations;
    element.className = `island${island?.took > 0 && state.time_s - island.t_s < kFresh_s && island.generation < run.data.generations ? ' migrated' : ''}${orphan ? ' orphan' : ''}`;
    text(element.children[0], island ? short(island.best_fitness) : '·');
    text(element.children[1], island ? tagOf(island.worker) : '');
    element.children[2].style.width = `${island ? 100 * island.generation / run.data.generations : 0}%`;
    element.title = island ? `generation ${island.generation}, ${island.migrants_taken} migrants taken, ${island.migrants_sent} sent, ${Math.round(100 * island.diversity)} % differ, ${island.worker}` : 'not begun';
  }
  text($('islandnote'), run === null ? 'no evolution yet' : `best fitness, who breeds it, generations; framed: has just taken in migrants (${short(effort(state, calibration, run).migrants)} in all)`);
}

/// Constants with as many digits as a person compares.
const rounded = formula => (formula ?? '').replace(/\d+\.\d{4,}(e[+-]?\d+)?/g, number => String(Number(Number(number).toPrecision(3))));

function drawTables(calibration, run) {
  const best = [...(run?.best.values() ?? [])].sort((a, b) => a.joint - b.joint), ofSets = run?.data?.breeds === 'sets';
  text($('besttitle'), ofSets ? 'Best explanation' : 'Best evolved formulas');
  text($('bestnote'), ofSets ? 'fitness: exp(description length / measured numbers), 1 without any cause; length: effects' : 'of the evolution that runs or ran last; theta in rad; constants rounded. The model may hold sums of smooth terms, fitted to the poses, in their place: report.html says which');
  text($('besthead'), ofSets ? 'causes' : 'formula');
  text($('frontnote'), `best fitness that ${ofSets ? 'sets of so many effects' : 'formulas of each length'} reached`);
  rows($('formulas'), best, e => [ofSets ? 'all' : String(e.joint), short(e.best_fitness), String(e.best_length), rounded(e.best_formula) || '–']);
  best.forEach((e, i) => {
    const row = $('formulas').rows[i], mark = `${e.run}/${e.joint}/${e.best_fitness}`;
    if (row.dataset.mark !== mark) { row.dataset.mark = mark; row.classList.remove('fresh'); void row.offsetWidth; row.classList.add('fresh'); }
  });
  const count = name => [...(run?.islands.values() ?? [])].filter(island => island.worker === name).length;
  rows($('workers'), [...state.workers.values()].map(worker => ({...worker, style: worker.presence === 'here' ? '' : worker.presence})),
       worker => [`${tagOf(worker.worker)} ${worker.host} (${worker.process})`, String(worker.slots), String(count(worker.worker)),
                  `${Math.round(100 * worker.waited_share)} %`, worker.presence === 'here' ? '' : worker.presence]);
  const rounds = [...(calibration?.rounds.values() ?? [])].sort((a, b) => a.round - b.round);
  const mark = `${calibration?.id}:${calibration?.told}`;
  if ($('rounds').dataset.mark !== mark) {
    $('rounds').dataset.mark = mark;
    $('rounds').replaceChildren(...rounds.map(roundElement));
    $('rounds').scrollTop = $('rounds').scrollHeight;
  }
  const causes = [...(calibration?.causes.values() ?? [])].sort((a, b) => a.number - b.number), last = calibration?.finalFigures;
  if ($('causes').dataset.mark !== `${calibration?.id}:${causes.length}`) {
    $('causes').dataset.mark = `${calibration?.id}:${causes.length}`;
    $('causes').replaceChildren(...causes.map(causeElement));
  }
  $('finalnote').hidden = !last;
  text($('finalnote'), last ? finalNote(last) : '');
  const added = rounds.filter(round => round.verdict === 'added' && round.validation_after_mm !== null);
  text($('roundnote'), rounds.length === 0 ? 'the closed loop has not begun' : added.length === 0 ? `${rounds.length} rounds, nothing added` :
       `mean error on validation poses ${short(added[0].validation_before_mm)} → ${short(added.at(-1).validation_after_mm)} mm`);
  const notices = state.notices.slice(-60).reverse();
  if ($('events').dataset.mark !== `${notices.length}:${notices[0]?.t_s}`) {
    $('events').dataset.mark = `${notices.length}:${notices[0]?.t_s}`;
    $('events').replaceChildren(...notices.map(one => Object.assign(document.createElement('li'), {textContent: `${duration(one.t_s)}: ${one.text}`})));
  }
}

function finalNote(last) {
  const told = ['validation', 'accept'].filter(set => last[`${set}_after_mm`] !== null)
    .map(set => `rms error on ${set} poses ${short(last[`${set}_before_mm`])} → ${short(last[`${set}_after_mm`])} mm`);
  return (told.join('; ') || 'no poses judge the model') + (last.causes > 0 ? `; and on ${last.validation_after_mm === null ? 'calibration poses' : 'validation poses while they were unseen'}, without each cause → with it:` : '');
}

function causeElement(cause) {
  const made = document.createElement('li'), small = document.createElement('small');
  made.value = cause.number;
  made.textContent = cause.without_mm === null || cause.with_mm === null ? cause.label : `${cause.label}: ${short(cause.without_mm)} → ${short(cause.with_mm)} mm`;
  small.textContent = cause.advice;
  made.append(small);
  return made;
}

function roundElement(round) {
  const made = document.createElement('li'), small = document.createElement('small');
  made.value = round.round;
  made.className = round.verdict;
  made.textContent = round.verdict === 'added' && round.validation_after_mm !== null ?
    `${round.label}: ${short(round.validation_before_mm)} → ${short(round.validation_after_mm)} mm` : `${round.label || 'nothing'}: ${round.verdict === 'none' ? 'not added' : round.verdict}`;
  small.textContent = round.text;
  made.append(small);
  return made;
}

function drawArm() {
  const arm = state.arm;
  $('armbox').hidden = arm === null;
  if (arm === null) return;
  const hasAfter = (arm.after_mm?.length ?? 0) > 0;
  $('which').disabled = !hasAfter;
  text($('which'), after && hasAfter ? 'errors after' : 'errors before');
  const enlarged = armView.draw(arm, after && hasAfter ? arm.after_mm : arm.before_mm, pose);
  text($('armnote'), `${arm.data}: ${arm.poses_mm.length / 3} poses, errors enlarged ${short(enlarged)} times; drag to turn`);
}

function draw() {
  fold();
  const calibration = shownCalibration(state), run = shownRun(state);
  drawHead(calibration, run);
  drawArm();
  drawError(run);
  drawIslands(calibration, run);
  drawTables(calibration, run);
  text($('shown'), duration(live ? end_s() : shown_s()));
  if (live) $('time').value = 1000;
}

function setLive(wanted) {
  live = wanted;
  $('live').setAttribute('aria-pressed', String(live));
  if (live) stopPlaying();
  request();
}
function stopPlaying() {
  clearInterval(playing);
  playing = null;
  $('play').setAttribute('aria-pressed', 'false');
}
$('live').addEventListener('click', () => setLive(true));
$('time').addEventListener('input', () => { stopPlaying(); setLive(Number($('time').value) >= 1000); });
$('play').addEventListener('click', () => {
  if (playing !== null) return stopPlaying();
  if (live || Number($('time').value) >= 1000) $('time').value = 0;
  setLive(false);
  $('play').setAttribute('aria-pressed', 'true');
  playing = setInterval(() => {
    $('time').value = Number($('time').value) + kPause_ms / kPlay_s;
    if (Number($('time').value) >= 1000) setLive(true);
    else request();
  }, kPause_ms);
});
$('which').addEventListener('click', () => { after = !after; request(); });
window.addEventListener('resize', request);
setInterval(() => { if (!$('armbox').hidden && document.visibilityState === 'visible') { ++pose; request(); } }, 2000);

/// One message of the stream: lines, of which `id` and `data` count.
function takeMessage(message) {
  for (const line of message.split('\n')) {
    if (line.startsWith('id: ')) last = Number(line.slice(4));
    if (line.startsWith('data: ')) events.push(JSON.parse(line.slice(6)));
  }
}

function forget() {
  last = events.length = folded = 0;
  state = emptyState();
}

async function follow() {
  const answer = await fetch(`/api/stream?after=${last}`, {headers: token === null ? {} : {Authorization: `Bearer ${token}`}, cache: 'no-store'});
  if (!answer.ok) throw new Error((await answer.text()).trim());
  const now = answer.headers.get('Demecal-Session');
  if (session !== null && session !== now && last > 0) {  // another server, with numbers of its own
    session = now;
    forget();
    return answer.body.cancel();
  }
  session = now;
  trouble = '';
  const reader = answer.body.pipeThrough(new TextDecoderStream()).getReader();
  for (let held = '';;) {
    const {done, value} = await reader.read();
    if (done) return undefined;
    const messages = (held + value).split('\n\n');
    held = messages.pop();
    messages.forEach(takeMessage);
    if (events.length > kMostEvents) {  // the server has thinned them out: from the beginning
      forget();
      return reader.cancel();
    }
    request();
  }
}

for (;;) {
  try {
    await follow();
    trouble = 'the connection has ended: trying again';
  } catch (error) {
    trouble = error instanceof TypeError ? 'the monitor does not answer: trying again' : error.message;
  }
  request();
  await new Promise(resolve => setTimeout(resolve, 1000));
}
