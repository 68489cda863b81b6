// Opens a live page in Chromium and prints, as one line of JSON, what stands there and what went wrong:
//   node live_page.mjs URL WORD [FOLDER]
// It waits until the stage holds WORD, moves the time slider to the middle and back, and looks at the page as a phone
// shows it. With FOLDER, pictures of both are left there.
import puppeteer from 'puppeteer-core';

const [url, word, folder] = process.argv.slice(2);
const patience = {timeout: 110000, polling: 100};
const found = {faults: [], elsewhere: []};

const browser = await puppeteer.launch({executablePath: '/usr/bin/chromium', args: ['--no-sandbox', '--disable-dev-shm-usage', '--disable-gpu']});
try {
  const page = await browser.newPage();
  await page.setViewport({width: 1280, height: 900});
  page.on('console', message => { if (['error', 'warning', 'warn'].includes(message.type())) found.faults.push(message.text()); });
  page.on('pageerror', error => found.faults.push(String(error)));
  page.on('request', request => { if (new URL(request.url()).origin !== new URL(url).origin) found.elsewhere.push(request.url()); });
  await page.goto(url, {waitUntil: 'load'});
  found.paint_ms = await page.evaluate(() => new Promise(resolve => new PerformanceObserver(list => resolve(list.getEntries()[0].startTime)).observe({type: 'paint', buffered: true})));
  await page.waitForFunction(wanted => document.getElementById('stage').textContent.includes(wanted), patience, word);
  await new Promise(resolve => setTimeout(resolve, 1500));

  const look = () => page.evaluate(() => ({
    title: document.title,
    stage: document.getElementById('stage').textContent,
    figures: document.getElementById('figures').textContent,
    islands: [...document.querySelectorAll('.island')].map(island => ({key: island.dataset.key, title: island.title})),
    formulas: [...document.getElementById('formulas').rows].map(row => [...row.cells].map(cell => cell.textContent)),
    workers: document.getElementById('workers').rows.length,
    causes: [...document.getElementById('causes').children].map(cause => cause.firstChild.textContent),
    final: document.getElementById('finalnote').textContent,
    rounds: document.getElementById('rounds').children.length,
    events: document.getElementById('events').children.length,
    inked: Object.fromEntries([...document.querySelectorAll('canvas')].map(canvas => {
      const copy = new OffscreenCanvas(64, 64).getContext('2d', {willReadFrequently: true});
      if (canvas.width > 0) copy.drawImage(canvas, 0, 0, 64, 64);
      return [canvas.id, copy.getImageData(0, 0, 64, 64).data.some(value => value !== 0)];
    })),
    wide: document.documentElement.scrollWidth > window.innerWidth,
  }));
  const slide = async value => {
    await page.evaluate(wanted => {
      const slider = document.getElementById('time');
      slider.value = wanted;
      slider.dispatchEvent(new Event('input'));
    }, value);
    await new Promise(resolve => setTimeout(resolve, 800));
  };
  found.now = await look();
  if (folder) await page.screenshot({path: `${folder}/desktop.png`, fullPage: true});
  found.turned_ms = await page.evaluate(async () => {  // of one drawing of the arm while it is turned
    const canvas = document.getElementById('arm'), send = (type, x) => canvas.dispatchEvent(new PointerEvent(type, {pointerId: 1, clientX: x, clientY: 50}));
    if (canvas.clientWidth === 0) return null;
    canvas.setPointerCapture = () => {};
    const frame = () => new Promise(resolve => requestAnimationFrame(resolve));
    send('pointerdown', 0);
    await frame();
    const begin = performance.now();
    for (let i = 1; i <= 30; ++i) {
      send('pointermove', 4 * i);
      await frame();
    }
    send('pointerup', 120);
    return (performance.now() - begin) / 30;
  });
  await slide(0);
  found.begin = await look();
  await slide(300);
  found.before = await look();
  await slide(1000);
  found.again = await look();
  await page.setViewport({width: 390, height: 844, isMobile: true, hasTouch: true, deviceScaleFactor: 2});
  await new Promise(resolve => setTimeout(resolve, 800));
  found.phone = await look();
  if (folder) await page.screenshot({path: `${folder}/phone.png`, fullPage: true});
} catch (error) {
  found.faults.push(String(error));
} finally {
  await browser.close();
}
console.log(JSON.stringify(found));
