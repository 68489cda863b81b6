// The page of jobs: asks every two seconds how they stand, and sends what its buttons mean.
const kPause_ms = 2000;
const $ = id => document.getElementById(id);
let jobs = [], busy = false, comparedAt = '', opened = null, trouble = '', drawn = '';

async function ask(path, options = {}) {
  const answer = await fetch('/api/' + path, {credentials: 'same-origin', cache: 'no-store', redirect: 'error', ...options});
  if (answer.ok) return answer;
  const why = (await answer.text()).trim();
  throw Object.assign(new Error(why || `the server answered ${answer.status}`), {status: answer.status});
}

function send(path, body) {
  const headers = {'Demecal-Request': '1'};
  if (body !== undefined) headers['Content-Type'] = 'application/octet-stream';
  return ask(path, {method: 'POST', headers, body: body ?? ''});
}

function make(tag, words, style = '') {
  const made = document.createElement(tag);
  made.textContent = words;
  made.className = style;
  return made;
}

function say(words, bad = false) {
  $('stage').textContent = words;
  $('stage').className = bad ? 'bad' : '';
}

/// What a button does; what goes wrong is said where one looks first.
async function act(words, deed) {
  if (busy) return;
  busy = true;
  trouble = '';
  say(words);
  try {
    await deed();
  } catch (error) {
    trouble = error.message;
    if (error.status === 401) showSignIn();
  }
  busy = false;
  await look();
}

function size(bytes) {
  return bytes < 1e6 ? `${Math.max(1, Math.round(bytes / 1e3))} kB` : `${(bytes / 1e6).toFixed(1)} MB`;
}

function duration(from_s, to_s) {
  const s = Math.max(0, Math.round(to_s - from_s));
  return s < 90 ? `${s} s` : s < 5400 ? `${Math.round(s / 60)} min` : `${(s / 3600).toFixed(1)} h`;
}

const kWhy = {10: 'its options or files do not fit', 11: 'a file is missing or wrong', 12: 'data and robot file contradict each other', 20: 'no worker came', 21: 'the run failed'};

function stateOf(job) {
  switch (job.state) {
    case 'ready': return job.results.length > 0 ? 'not run since its files changed: results are of an earlier run' : 'not run yet';
    case 'waiting': return job.before > 1 ? `waiting: ${job.before} jobs before it` : job.before === 1 ? 'waiting: one job before it' : 'waiting';
    case 'running': return `running for ${duration(job.began_s, Date.now() / 1000)}`;
    case 'done': return `done, in ${duration(job.began_s, job.ended_s)}`;
    case 'interrupted': return job.goes_on ? 'interrupted; what was reached is saved, and it can go on from there' : 'interrupted; results, if any, are what was reached';
    default: return `failed: ${kWhy[job.exit_code] ?? `exit code ${job.exit_code}`}${job.results.length > 0 ? '' : '; it left no results'}`;
  }
}

function button(row, words, deed) {
  const made = make('button', words);
  made.type = 'button';
  made.addEventListener('click', deed);
  row.append(made);
  return made;
}

function card(job) {
  const box = make('article', '', `job ${job.state}`), at = `jobs/${encodeURIComponent(job.name)}`;
  box.dataset.name = job.name;
  box.dataset.state = job.state;
  box.append(make('h3', job.name), make('p', stateOf(job), 'state'));
  box.append(make('p', job.files.length === 0 ? 'no files' : job.files.map(file => `${file.name} (${size(file.bytes)})`).join(', '), 'note'));
  if (job.said !== '') box.append(make('p', job.said, 'said'));
  const row = make('div', '', 'row'), idle = job.state !== 'running' && job.state !== 'waiting';
  if (idle) {
    button(row, job.goes_on ? 'go on' : job.state === 'ready' ? 'run' : 'run again', () => act(`asking for ${job.name}`, () => send(`${at}/run`)));
    button(row, 'run and certify', () => {
      const tolerance = prompt('Tolerance of the certificate, in mm:', '0.5');
      if (tolerance !== null) act(`asking for ${job.name}`, () => send(`${at}/run?tolerance_mm=${encodeURIComponent(tolerance)}`));
    });
    button(row, 'add files', () => pick(job.name));
    if (job.files.length > 0) button(row, 'remove a file', () => {
      const file = prompt('Name of the file to be removed:', job.files.at(-1).name);
      if (file !== null) act(`removing ${file}`, () => send(`${at}/files/${encodeURIComponent(file)}/remove`));
    });
    button(row, 'remove', () => {
      if (confirm(`Remove the job ${job.name}, its files and its results?`)) act(`removing ${job.name}`, () => send(`${at}/remove`));
    });
  } else {
    button(row, 'stop', () => act(`stopping ${job.name}`, () => send(`${at}/stop`)));
  }
  if (job.began_s > 0) button(row, opened === job.name ? 'hide terminal' : 'terminal', () => { opened = opened === job.name ? null : job.name; drawn = ''; look(); });
  box.append(row);
  const links = make('div', '', 'row');
  for (const file of job.results) {
    const link = make('a', file.name);
    link.href = `/api/${at}/results/${encodeURIComponent(file.name)}`;
    link.target = '_blank';
    link.rel = 'noopener noreferrer';
    links.append(link);
  }
  box.append(links);
  if (opened === job.name) box.append(Object.assign(make('pre', ''), {id: 'terminal', tabIndex: 0}));
  return box;
}

async function upload(name, files) {
  for (const file of files) {
    say(`uploading ${file.name}`);
    await send(`jobs/${encodeURIComponent(name)}/files/${encodeURIComponent(file.name)}`, file);
  }
}

function pick(name) {
  const input = document.createElement('input');
  input.type = 'file';
  input.multiple = true;
  input.addEventListener('change', () => act(`uploading to ${name}`, () => upload(name, input.files)));
  input.click();
}

function draw(answer) {
  jobs = answer.jobs;
  $('user').textContent = `jobs of ${answer.user}`;
  $('signout').hidden = !answer.signs_in;
  $('signin').hidden = true;
  for (const id of ['new', 'jobsbox']) $(id).hidden = false;
  const running = jobs.filter(job => job.state === 'running').length, waiting = jobs.filter(job => job.state === 'waiting').length;
  $('jobsnote').textContent = jobs.length === 0 ? 'none yet' : `${jobs.length} of at most ${answer.limits.jobs}; one runs at a time`;
  say(trouble !== '' ? trouble : running > 0 ? `${jobs.find(job => job.state === 'running').name} is running` : waiting > 0 ? 'waiting for the run of another user' : 'nothing is running', trouble !== '');
  const now = JSON.stringify([jobs, opened]) + (running > 0 ? Math.round(Date.now() / 5000) : '');
  if (now === drawn) return;
  drawn = now;
  const kept = $('terminal')?.textContent ?? '', focus = document.activeElement, at = [focus?.closest?.('.job')?.dataset.name, focus?.textContent];
  $('jobs').replaceChildren(...jobs.map(card));
  if ($('terminal')) $('terminal').textContent = kept;
  if (at[0]) [...$('jobs').querySelectorAll('button, a')].find(one => one.closest('.job').dataset.name === at[0] && one.textContent === at[1])?.focus();
}

function figures(row, set) {
  const before = row.error_mm?.registered?.[set]?.rms, after = row.error_mm?.after?.[set]?.rms;
  return after == null ? '-' : `${before == null ? '-' : before.toFixed(3)} → ${after.toFixed(3)}`;
}

async function compare() {
  const finished = jobs.filter(job => job.state === 'done').map(job => `${job.name} ${job.ended_s}`).join();
  if (finished === comparedAt) return;
  const rows = finished === '' ? [] : (await (await ask('comparison')).json()).jobs;
  comparedAt = finished;
  $('comparebox').hidden = rows.length === 0;
  $('comparison').replaceChildren(...rows.map(row => {
    const line = document.createElement('tr');
    const words = row.readable ? [row.job, `${row.method ?? ''}, ${row.seed ?? ''}`, ...['calibration', 'validation', 'accept'].map(set => figures(row, set))] : [row.job, 'its report cannot be read', '', '', ''];
    line.append(...words.map(word => make('td', word)));
    return line;
  }));
  const data = new Set(rows.map(row => row.data_sha256));
  $('comparenote').textContent = data.size > 1 ? 'These jobs are of different data: their errors were measured at different poses.' : '';
}

function showSignIn() {
  for (const id of ['new', 'jobsbox', 'comparebox', 'signout']) $(id).hidden = true;
  $('signin').hidden = false;
  $('user').textContent = 'jobs';
  drawn = comparedAt = '';
}

async function look() {
  if (busy) return;
  try {
    draw(await (await ask('jobs')).json());
    if (opened !== null && $('terminal')) {
      const text = (await (await ask(`jobs/${encodeURIComponent(opened)}/terminal`)).json()).text, box = $('terminal');
      if (box && box.textContent !== text) { box.textContent = text; box.scrollTop = box.scrollHeight; }
    }
    await compare();
  } catch (error) {
    if (error.status === 401) {
      showSignIn();
      say(trouble !== '' ? trouble : 'sign in with the token that you were given', trouble !== '');
    } else {
      say(error.status === undefined ? 'the server does not answer: is it still running?' : error.message, true);
    }
  }
}

$('newform').addEventListener('submit', event => {
  event.preventDefault();
  const name = $('name').value, files = [...$('files').files];
  act(`making ${name}`, async () => {
    await send(`jobs/${encodeURIComponent(name)}/make`);
    await upload(name, files);
    $('newform').reset();
  });
});
$('tokenform').addEventListener('submit', event => {
  event.preventDefault();
  const token = $('token').value;
  $('token').value = '';
  act('signing in', () => send('sign-in', token));
});
$('signout').addEventListener('click', () => act('signing out', () => send('sign-out')));

async function run() {
  await look();
  setTimeout(run, kPause_ms);
}
run();
