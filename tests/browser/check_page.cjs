// Opens a report page in a browser without a window and uses it as a person would; prints what happened as one line of
// JSON. usage: node check_page.cjs PUPPETEER CHROMIUM PAGE [SCREENSHOTS]
"use strict";
const [puppeteerFolder, chromium, page_file, screenshots] = process.argv.slice(2);
const puppeteer = require(puppeteerFolder);

const seen = {complaints: [], requests: []};

const columnOf = (page, index) => page.$$eval("#pose-errors tbody tr", (rows, at) =>
  rows.map(row => row.cells[at].textContent), index);
const picture = (page, id) => page.$eval("#" + id, canvas => canvas.toDataURL());
const settled = page => page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 50)))));
const set = async (page, id, value) => {
  await page.$eval("#" + id, (element, text) => {
    if (element.type === "checkbox") element.checked = text; else element.value = text;
    element.dispatchEvent(new Event("input", {bubbles: true}));
  }, value);
  await settled(page);
};
/// Elements that reach beyond the window's right edge and that no scrolling ancestor holds.
const cutOff = page => page.evaluate(() => {
  const width = document.documentElement.clientWidth, cut = [];
  for (const element of document.querySelectorAll("body *")) {
    const box = element.getBoundingClientRect();
    if (box.width === 0 || box.right <= width + 1) continue;
    let held = false;
    for (let up = element.parentElement; up; up = up.parentElement)
      held = held || ["auto", "scroll", "hidden"].includes(getComputedStyle(up).overflowX);
    if (!held) cut.push(element.tagName + "#" + element.id + "." + element.className);
  }
  return cut;
});

(async () => {
  const browser = await puppeteer.launch({executablePath: chromium, args: ["--no-sandbox", "--disable-gpu"]});
  try {
    const page = await browser.newPage();
    page.on("console", message => { if (["error", "warn"].includes(message.type())) seen.complaints.push(message.text()); });
    page.on("pageerror", error => seen.complaints.push(String(error)));
    page.on("request", request => { if (!request.url().startsWith("file:")) seen.requests.push(request.url()); });
    const shot = name => screenshots ? page.screenshot({path: screenshots + "/" + name + ".png", fullPage: true}) : null;
    await page.setViewport({width: 1280, height: 900});
    // The least of three: other programs of the machine may take their time of one.
    seen.opened_ms = Infinity;
    for (let time = 0; time < 3; ++time) {
      const begin = Date.now();
      await page.goto("file://" + page_file);
      await settled(page);
      seen.opened_ms = Math.min(seen.opened_ms, Date.now() - begin);
    }
    seen.pages = await page.$eval("#pose-pages", element => element.textContent);
    await shot("wide");

    seen.after_descending = await columnOf(page, 3);
    await page.click('#pose-errors thead button[data-key="before"]');
    seen.before_descending = await columnOf(page, 2);
    await page.click('#pose-errors thead button[data-key="before"]');
    seen.before_ascending = await columnOf(page, 2);
    seen.sorted_by = await page.$eval('#pose-errors th[aria-sort]', head => head.textContent + " " + head.getAttribute("aria-sort"));
    await set(page, "pose-set", "validation");
    seen.filtered_sets = [...new Set(await columnOf(page, 1))];
    await set(page, "pose-search", "no pose has this name");
    seen.rows_of_no_pose = (await columnOf(page, 0)).length;
    await set(page, "pose-search", "");
    await set(page, "pose-set", "");

    const still = await picture(page, "view-canvas");
    await set(page, "view-exaggeration", "3.5");
    const exaggerated = await picture(page, "view-canvas");
    await page.click('[data-view="left"]');
    await settled(page);
    const turned = await picture(page, "view-canvas");
    await set(page, "view-slice", "2");
    const sliced = await picture(page, "view-canvas");
    seen.slider_draws = still !== exaggerated;
    seen.button_turns = exaggerated !== turned;
    seen.slice_draws = turned !== sliced;
    seen.slice_place = await page.$eval("#view-slice-place", element => element.textContent);
    await page.focus("#view-canvas");
    await page.keyboard.press("ArrowUp");
    await settled(page);
    seen.key_tilts = sliced !== await picture(page, "view-canvas");
    await set(page, "view-slice", "");

    const against = [];
    for (const choice of await page.$$eval("#plot-what option", options => options.map(option => option.value))) {
      await set(page, "plot-what", choice);
      against.push(await picture(page, "plot-against"));
    }
    seen.plots_differ = new Set(against).size === against.length;
    await page.$eval("#plot-against", canvas => canvas.scrollIntoView({block: "center"}));
    const plot = await (await page.$("#plot-against")).boundingBox();
    const unnamed = await page.$eval("#pose-name", element => element.textContent);
    for (let x = 60; x < plot.width - 10; x += 6) {
      for (let y = 20; y < plot.height - 40; y += 12) await page.mouse.move(plot.x + x, plot.y + y);
      if (await page.$eval("#pose-name", element => element.textContent) !== unnamed) break;
    }
    seen.hovered = await page.$eval("#pose-name", element => element.textContent);
    await page.focus("#pose-errors tbody tr");
    await settled(page);
    seen.picked = await page.$eval("#pose-name", element => element.textContent);
    seen.first_row = await page.$eval("#pose-errors tbody tr", row => row.cells[0].textContent);
    await page.mouse.move(1, 1);

    // A finger has no hover: it comes down on a pose.
    await page.$eval("#pose-name", element => { element.textContent = ""; });
    await page.$eval("#plot-against", canvas => canvas.scrollIntoView({block: "center"}));
    const under = await (await page.$("#plot-against")).boundingBox();
    const tapped = () => page.$eval("#pose-name", element => element.textContent);
    for (let x = 60; x < under.width - 10 && await tapped() === ""; x += 24) {
      for (let y = 20; y < under.height - 40 && await tapped() === ""; y += 24)
        await page.touchscreen.tap(under.x + x, under.y + y);
    }
    seen.tapped = await tapped();

    const advice = () => page.evaluate(() => {
      const table = document.getElementById("causes");
      return table ? table.parentElement.scrollWidth - table.parentElement.clientWidth : 0;
    });
    seen.causes_beyond_at_1280 = await advice();
    await page.evaluate(() => { for (const part of document.querySelectorAll("details")) part.open = true; });
    await page.setViewport({width: 400, height: 800});
    await settled(page);
    seen.cut_at_400 = await cutOff(page);
    seen.width_at_400 = await page.evaluate(() => document.documentElement.scrollWidth);
    seen.causes_beyond_at_400 = await advice();
    await shot("narrow");
    // The width of A4 within the browser's margins.
    await page.emulateMediaType("print");
    await page.setViewport({width: 718, height: 1000});
    await settled(page);
    seen.cut_in_print = await page.$$eval("table", tables => tables.map(table =>
      table.id + " " + Math.ceil(table.getBoundingClientRect().right)).filter(text => Number(text.split(" ")[1]) > 718));
    await page.emulateMediaType(null);
    await page.emulateMediaFeatures([{name: "prefers-color-scheme", value: "dark"}]);
    await page.setViewport({width: 1280, height: 900});
    await settled(page);
    seen.dark_page = await page.evaluate(() => getComputedStyle(document.body).backgroundColor);
    await shot("dark");
    seen.printed_bytes = (await page.pdf({format: "A4"})).length;
    console.log(JSON.stringify(seen));
  } finally {
    await browser.close();
  }
})().catch(error => { console.error(error); process.exit(1); });
