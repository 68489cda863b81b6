// Uses the page of jobs in Chromium as a person does, and prints, as one line of JSON, what stood there and what went wrong:
//   node jobs_page.mjs URL TOKEN FOLDER [PICTURES]
// It signs in, uploads what lies in FOLDER as a job, runs it, opens its terminal and its report, looks at the page as a
// phone shows it and in the dark, removes a file and the job, and signs out. With PICTURES, pictures are left in that folder.
import {readdirSync} from 'node:fs';
import puppeteer from 'puppeteer-core';

const [url, token, folder, pictures] = process.argv.slice(2);
const patience = {timeout: 110000, polling: 100};
const found = {faults: [], elsewhere: []};
const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

const browser = await puppeteer.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-dev-shm-usage', '--disable-gpu']});
try {
  const page = await browser.newPage();
  await page.setViewport({width: 1280, height: 900});
  let expected = '401';  // what a browser says of answers before one is signed in
  page.on('console', message => { if (['error', 'warning', 'warn'].includes(message.type()) && !(expected && message.text().includes(expected))) found.faults.push(message.text()); });
  page.on('pageerror', error => found.faults.push(String(error)));
  page.on('request', request => { if (new URL(request.url()).origin !== new URL(url).origin) found.elsewhere.push(request.url()); });
  page.on('dialog', dialog => dialog.accept(dialog.defaultValue()));
  const shows = words => page.waitForFunction(wanted => document.getElementById('stage').textContent.includes(wanted), patience, words);
  const press = words => page.evaluate(wanted => [...document.querySelectorAll('button')].find(button => button.textContent === wanted).click(), words);
  const becomes = state => page.waitForFunction(wanted => document.querySelector('.job')?.dataset.state === wanted, patience, state);
  const isWide = () => page.evaluate(() => document.documentElement.scrollWidth > window.innerWidth);

  await page.goto(url, {waitUntil: 'load'});
  await shows('sign in');
  await page.type('#token', token + '0');
  await page.keyboard.press('Enter');
  await shows('nobody');
  found.refused = await page.$eval('#stage', stage => stage.textContent);
  await page.type('#token', token);
  await page.keyboard.press('Enter');
  await shows('nothing is running');
  expected = '';
  await page.type('#name', 'from-the-page');
  await (await page.$('#files')).uploadFile(...readdirSync(folder).map(name => `${folder}/${name}`));
  await page.evaluate(() => document.querySelector('#newform button').click());
  await becomes('ready');
  await page.waitForFunction(() => document.querySelector('.job .note').textContent.includes('robot.yaml'), patience);
  await press('run');
  await becomes('done');
  await page.waitForFunction(() => document.getElementById('comparison').rows.length === 1, patience);
  found.done = await page.evaluate(() => ({
    state: document.querySelector('.job .state').textContent,
    links: [...document.querySelectorAll('.job a')].map(link => link.textContent),
    compared: [...document.getElementById('comparison').rows].map(row => [...row.cells].map(cell => cell.textContent)),
  }));
  await press('terminal');
  await page.waitForFunction(() => document.getElementById('terminal')?.textContent.includes('model.yaml'), patience);
  found.terminal = await page.$eval('#terminal', box => box.textContent);
  found.wide = await isWide();
  if (pictures) await page.screenshot({path: `${pictures}/jobs-desktop.png`, fullPage: true});

  const opened = new Promise(resolve => browser.once('targetcreated', resolve));
  await page.evaluate(() => [...document.querySelectorAll('.job a')].find(link => link.textContent === 'report.html').click());
  const report = await (await opened).page();
  report.on('pageerror', error => found.faults.push(String(error)));
  await report.waitForSelector('svg, canvas, table', patience);
  await pause(500);
  found.report = await report.evaluate(() => String(self.origin));
  if (pictures) await report.screenshot({path: `${pictures}/jobs-report.png`});
  await report.close();

  await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: 'dark'}]);
  await page.setViewport({width: 400, height: 844, isMobile: true, hasTouch: true, deviceScaleFactor: 2});
  await pause(800);
  found.phone = await isWide();
  if (pictures) await page.screenshot({path: `${pictures}/jobs-phone.png`, fullPage: true});
  await press('remove a file');
  await page.waitForFunction(() => !document.querySelector('.job .note').textContent.includes('robot.yaml'), patience);
  found.left = await page.$eval('.job .note', note => note.textContent);
  await press('remove');
  await page.waitForFunction(() => document.querySelector('.job') === null, patience);
  found.removed = await page.$$eval('.job', jobs => jobs.length);
  expected = '401';
  await press('sign out');
  await shows('sign in');
  found.signed_out = await page.evaluate(() => document.getElementById('jobsbox').hidden);
} catch (error) {
  found.faults.push(String(error));
} finally {
  await browser.close();
}
console.log(JSON.stringify(found));
