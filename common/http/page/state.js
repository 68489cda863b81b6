// What was seen up to a moment: a fold of events, so that any moment can be shown again.

const kMostNotices = 200;

export function emptyState() {
  return {time_s: 0, calibrations: new Map(), runs: new Map(), workers: new Map(), notices: [], arm: null};
}

function runOf(state, id) {
  if (!state.runs.has(id)) state.runs.set(id, {id, data: null, state: 'running', islands: new Map(), curves: new Map(), fronts: new Map(), best: new Map(), figures: null});
  return state.runs.get(id);
}

function calibrationOf(state, id) {
  if (!state.calibrations.has(id)) state.calibrations.set(id, {id, job: '', stage: '', text: '', run: '', runs: new Set(), told: 0, lost: false, rounds: new Map(), causes: new Map(), finalFigures: null});
  return state.calibrations.get(id);
}

function notice(state, e, text) {
  state.notices.push({t_s: e.t_s, text});
  if (state.notices.length > kMostNotices) state.notices.shift();
}

const isOver = stage => stage === 'finished' || stage === 'interrupted' || stage === 'failed';
export const isLive = calibration => !calibration.lost && !isOver(calibration.stage);

/// The calibration that began last among those that go on, or else among all.
export function shownCalibration(state) {
  let shown = null;
  for (const one of state.calibrations.values()) if (shown === null || isLive(one) || !isLive(shown)) shown = one;
  return shown;
}

export function shownRun(state) {
  const calibration = shownCalibration(state);
  if (calibration !== null && state.runs.has(calibration.run)) return state.runs.get(calibration.run);
  return calibration === null ? [...state.runs.values()].at(-1) ?? null : null;
}

/// Of all evolutions of the calibration that were seen; without one, of the run.
export function effort(state, calibration, run) {
  const all = {evaluations: 0, sets: 0, migrants: 0};
  const runs = calibration === null ? [run] : [...calibration.runs].map(id => state.runs.get(id));
  for (const one of runs) for (const island of one?.islands.values() ?? []) {
    all[one.data?.breeds === 'sets' ? 'sets' : 'evaluations'] += island.evaluations;
    all.migrants += island.migrants_taken;
  }
  return all;
}

function takeProgress(state, e) {
  const run = runOf(state, e.run), key = e.joint + '/' + e.island, before = run.islands.get(key);
  if (before !== undefined && e.epoch < before.epoch) return;
  const worker = before !== undefined && before.worker !== e.worker ? before.worker : null;
  if (worker !== null) notice(state, e, `joint ${e.joint}, island ${e.island}: taken over by ${e.worker}`);
  run.islands.set(key, {...e, took: before === undefined ? 0 : e.migrants_taken - before.migrants_taken});
  if (e.best_fitness === null) return;
  const best = run.best.get(e.joint);
  if (best === undefined || e.best_fitness < best.best_fitness) {
    run.best.set(e.joint, e);
    if (!run.curves.has(e.joint)) run.curves.set(e.joint, []);
    run.curves.get(e.joint).push([e.t_s, e.best_fitness]);
  }
  if (!run.fronts.has(e.joint)) run.fronts.set(e.joint, new Map());
  const front = run.fronts.get(e.joint), known = front.get(e.best_length);
  if (known === undefined || e.best_fitness < known) front.set(e.best_length, e.best_fitness);
}

function takeStage(state, e) {
  const calibration = calibrationOf(state, e.calibration);
  if (calibration.stage !== e.stage || calibration.text !== e.text) notice(state, e, `${e.job}: ${e.text || e.stage}`);
  if (e.run) calibration.runs.add(e.run);
  Object.assign(calibration, {job: e.job, stage: e.stage, text: e.text, run: e.run || calibration.run, lost: false});
}

function takeWorker(state, e) {
  const before = state.workers.get(e.worker);
  if (before === undefined && e.leaving) return;
  const presence = e.leaving ? 'left' : 'here';
  if (before === undefined) notice(state, e, `worker ${e.worker} joined`);
  else if (before.presence !== presence) notice(state, e, `worker ${e.worker} ${e.leaving ? 'left' : 'is back'}`);
  state.workers.set(e.worker, {...e, presence});
}

const kTakers = {
  progress: takeProgress,
  stage: takeStage,
  worker: takeWorker,
  run: (state, e) => { runOf(state, e.run).data = e; },
  run_state: (state, e) => { runOf(state, e.run).state = e.state; },
  figures: (state, e) => { runOf(state, e.run).figures = e; },
  arm: (state, e) => { state.arm = e; },
  round: (state, e) => {
    const calibration = calibrationOf(state, e.calibration);
    if (!calibration.rounds.has(e.round) && e.verdict === 'added') notice(state, e, `found: ${e.label}`);
    calibration.job ||= e.job;
    calibration.rounds.set(e.round, e);
    ++calibration.told;
  },
  cause: (state, e) => { calibrationOf(state, e.calibration).causes.set(e.number, e); },
  final_figures: (state, e) => {
    const calibration = calibrationOf(state, e.calibration);
    calibration.job ||= e.job;
    calibration.finalFigures = e;
  },
  worker_lost: (state, e) => {
    const worker = state.workers.get(e.worker);
    if (worker !== undefined && worker.presence === 'here') {
      state.workers.set(e.worker, {...worker, presence: 'lost'});
      notice(state, e, `worker ${e.worker} is lost`);
    }
  },
  calibration_lost: (state, e) => {
    const calibration = calibrationOf(state, e.calibration);
    if (!isLive(calibration)) return;
    notice(state, e, `the coordinator of ${calibration.job} is gone`);
    calibration.lost = true;
  },
};

/// Takes an event into the state; words that it does not know change nothing.
export function take(state, e) {
  state.time_s = Math.max(state.time_s, e.t_s ?? 0);
  if (Object.hasOwn(kTakers, e.event)) kTakers[e.event](state, e);
}
