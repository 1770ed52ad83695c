// browser.mjs CHROMIUM PACKAGES RUN.html REPLAY.html CAMPAIGN.html WALKER.html MOMENTS.html ARCHIVE.html DAMAGED.html:
// a reader's way through real reports. Fails on anything that a page says on the console, on any request, and on what it
// does not show. PACKAGES: the folder of node_modules. WALKER: a run whose robot moves in space. MOMENTS: a run with
// predictions by moment matching. ARCHIVE: one of ite, of 3 trials, DAMAGED: with a damaged archive.bin.
import assert from 'node:assert/strict'
import { readFileSync } from 'node:fs'
import { createRequire } from 'node:module'
import { pathToFileURL } from 'node:url'

const [chromiumPath, packages, runPage, replayPage, campaignPage, walkerPage, momentsPage, archivePage, damagedPage] =
  process.argv.slice(2)
const { chromium } = createRequire(`${packages}/`)('playwright-core')
const launch = (...args) => chromium.launch({ executablePath: chromiumPath, args: ['--no-sandbox', ...args] })
let browser = await launch('--use-angle=swiftshader', '--enable-unsafe-swiftshader') // WebGL without a graphics card

/** Opens a page as a reader would and hands it to `visit`; nothing may have gone wrong when that ends. */
async function open(file, settings, visit) {
  const context = await browser.newContext({
    viewport: { width: 1280, height: 900 },
    acceptDownloads: true,
    ...settings,
  })
  const page = await context.newPage()
  const wrong = []
  page.on('console', (message) => wrong.push(`console: ${message.text()}`))
  page.on('pageerror', (error) => wrong.push(`error: ${error.message}`))
  const url = pathToFileURL(file).href
  page.on('request', (request) => {
    if (request.url() !== url && !/^(data|blob):/.test(request.url())) wrong.push(`request: ${request.url()}`)
  })
  await page.goto(url)
  await page.waitForSelector('h1')
  await visit(page)
  await everyFigure(page)
  const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth)
  assert.ok(overflow <= 0, `${file} is ${overflow} px wider than the window`)
  assert.deepEqual(wrong, [])
  await context.close()
}

/** Every figure draws something when the reader comes to it. */
async function everyFigure(page) {
  for (const figure of await page.locator('figure').all()) {
    await figure.scrollIntoViewIfNeeded()
    await figure.locator('svg path, svg line, tbody tr').first().waitFor({ state: 'attached' })
  }
}

async function saved(page, name) {
  const [download] = await Promise.all([page.waitForEvent('download'), page.getByRole('button', { name }).click()])
  return readFileSync(await download.path(), 'utf8')
}

const cursors = (page) =>
  page.locator('#trajectory line.cursor').evaluateAll((lines) => lines.map((line) => line.getAttribute('x1')))
const robot = (page) => page.locator('.stage').innerHTML()

/** The slider moves the robot and the cursors, by mouse and by keyboard. */
async function moveSlider(page) {
  const slider = page.getByRole('slider', { name: 'Time' })
  await slider.scrollIntoViewIfNeeded()
  await page.locator('#trajectory line.cursor').first().waitFor({ state: 'attached' })
  const before = [await robot(page), await cursors(page)]
  await slider.fill('20')
  const moved = [await robot(page), await cursors(page)]
  assert.notEqual(moved[0], before[0])
  assert.ok(before[1].length > 0 && moved[1].every((x, i) => x !== before[1][i]), 'a cursor stands still')
  await slider.press('ArrowRight')
  assert.equal(await slider.getAttribute('aria-valuetext'), '1.05 s')
  assert.notEqual(await robot(page), moved[0])
}

async function play(page) {
  await page.getByRole('slider', { name: 'Time' }).fill('0')
  await page.getByRole('combobox', { name: 'Speed' }).selectOption('0.25×') // a busy machine looks seldom
  await page.getByRole('button', { name: 'Play' }).press('Enter')
  await page.getByText(/^0\.[1-9]\d \/ 2\.50 s$/).waitFor()
  await page.getByRole('button', { name: 'Pause' }).press('Enter')
}

await open(runPage, {}, async (page) => {
  assert.equal(await page.locator('h1').textContent(), 'gp-mi on pendubot')
  assert.equal(await page.locator('#trajectory input, #moments-by-trial').count(), 0) // GPs around a simulator have none
  await moveSlider(page)
  await play(page)
  await page.getByRole('combobox', { name: 'Trial' }).selectOption('Trial 1')
  const first = await page.locator('.player .about').textContent()
  await page.getByRole('button', { name: 'Next trial' }).click()
  assert.notEqual(await page.locator('.player .about').textContent(), first)
  await page.getByRole('button', { name: 'Dark' }).click()
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark')

  const svg = await saved(page, 'Save “Return, predicted and real” as SVG')
  assert.match(svg, /^<svg [^]*Return, predicted and real[^]*<\/svg>$/)
  assert.doesNotMatch(svg, /var\(|light-dark/)
  const csv = (await saved(page, 'Save “Return, predicted and real” as CSV')).trim().split('\n')
  assert.equal(csv[0], 'trial,interaction_s,return,solved,predicted_return')
  assert.equal(csv.length, 3)
  const identified = page.locator('#parameters-by-trial')
  await identified.scrollIntoViewIfNeeded()
  await identified.locator('.panel').first().waitFor()
  assert.equal(await identified.locator('.panel').count(), 4) // none for the intervals
  assert.match(await identified.textContent(), /95 % interval/)
  const robust = page.locator('#robustness-by-parameter')
  await robust.scrollIntoViewIfNeeded()
  await robust.locator('.panel').first().waitFor()
  assert.deepEqual(await robust.locator('.panel h4').allTextContents(), ['m1', 'm2', 'l1', 'l2', 'b1', 'b2'])
  assert.match(await robust.textContent(), /How often the policy solves the task/)
  const changed = (await saved(page, 'Save “Robustness: one parameter of the robot at a time” as CSV')).trim().split('\n')
  assert.match(changed[0], /^parameter,factor,value,episodes,solved,/)
  assert.equal(changed.length, 1 + 6 * 5)
  const warnings = await identified.locator('.warnings li').allTextContents()
  assert.equal(warnings.at(-1), 'm1 and m2 cannot be told apart by these trials.')
  const parameters = await saved(page, 'Save “Parameters of the prior” as CSV')
  assert.match(parameters, /^trial,phi\.m1,phi\.m1\.low,phi\.m1\.high,phi\.m2,/)
})

/** The lines of moment matching in the figure of the states. */
const outlines = (page) => page.locator('#trajectory g[stroke="var(--green)"]').count()

for (const settings of [{}, { viewport: { width: 400, height: 800 }, colorScheme: 'dark' }])
  await open(momentsPage, settings, async (page) => {
    await page.locator('#trajectory').scrollIntoViewIfNeeded()
    await page.locator('#trajectory .panel').first().waitFor()
    await page.getByRole('combobox', { name: 'Trial' }).selectOption('Trial 1')
    assert.equal(await outlines(page), 0)
    await page.getByRole('combobox', { name: 'Trial' }).selectOption('Trial 2')
    assert.match(await page.locator('#trajectory').textContent(), /5–95 % by moment matching/)
    assert.equal(await outlines(page), 4 * 3 + 1) // a mean and two edges of each state, and the mean reward
    await page.getByRole('checkbox', { name: 'Show moment matching' }).press('Space')
    assert.equal(await outlines(page), 0)
    assert.match(
      await page.locator('.player .about').textContent(),
      /moment matching predicts [^;]+; means of states are at most /,
    )
    const csv = (await saved(page, 'Save “Moment matching against samples” as CSV')).trim().split('\n')
    assert.equal(csv[0], 'trial,sampled_return,moment_return,apart,state,time_s,spread')
    assert.equal(csv.length, 2) // none of the random first trial
  })

await open(replayPage, { colorScheme: 'dark' }, async (page) => {
  assert.match(await page.locator('h1').textContent(), /trial 2$/)
  await moveSlider(page)
})

await open(campaignPage, { viewport: { width: 400, height: 800 } }, async (page) => {
  const problems = await page.locator('.problems li').allTextContents()
  for (const name of ['stray.txt', 'trials.csv', 'another version'])
    assert.ok(
      problems.some((line) => line.includes(name)),
      `${name} is not named`,
    )
  await page.locator('#return-by-interaction-time').scrollIntoViewIfNeeded()
  await page.getByRole('radio', { name: 'best so far' }).press('Space')
  await page.locator('#success-by-trial').scrollIntoViewIfNeeded()
  const csv = await saved(page, 'Save “Return against time on the robot” as CSV')
  assert.match(csv, /^learner,prior,variant,trial,runs,interaction_s,return_min,/)
})

const ARCHIVE = 'The archive before and after the trials'

/** The archive, by three pairs of its six descriptors and by all fifteen, and the trials in it. */
async function readArchive(page) {
  const figure = page.locator('#archive-of-elites')
  await figure.scrollIntoViewIfNeeded()
  await figure.locator('.panel').first().waitFor()
  const panels = figure.locator('.panel svg')
  assert.equal(await panels.count(), 6)
  assert.equal(await figure.locator('h4', { hasText: 'predicted after 2 trials' }).count(), 3)
  assert.match(
    await panels.first().getAttribute('aria-label'),
    /predicted by the prior by tip x at 0\.8 s \(m\) and tip y/,
  )
  assert.ok((await panels.first().locator('[aria-label=cells] path').count()) > 5, 'all cells have the same colours')

  const csv = (await saved(page, 'Save “Which policies of the archive were tried” as CSV')).trim().split('\n')
  assert.equal(csv[0], 'trial,elite,promised,predicted_return,return,learned')
  const trials = csv.slice(1).map((line) => line.split(',').map(Number))
  assert.equal(trials.map(([trial, , , , , learned]) => `${trial}:${learned}`).join(), '1:1,2:1,3:0')
  assert.equal(trials[0][2], trials[0][3], 'before the first trial another return is predicted than by the prior')
  const labels = await panels.nth(1).locator('[aria-label=trials] text').allTextContents()
  assert.equal(labels.length, new Set(trials.map(([, elite]) => elite)).size)
  assert.ok(labels.includes('1'))

  const elites = (await saved(page, `Save “${ARCHIVE}” as CSV`)).trim().split('\n')
  assert.match(elites[0], /^tip x at 0\.8 s \[m\],.*,promised,expected,trials$/)
  assert.match(elites[trials[0][1]], /,1( 3)?$/)
  const svg = await saved(page, `Save “${ARCHIVE}” as SVG`)
  assert.doesNotMatch(svg, /var\(|light-dark/)
  await page.getByRole('radio', { name: 'every pair' }).press('Space')
  assert.equal(await panels.count(), 30)
  return elites.length - 1
}

for (const settings of [{}, { viewport: { width: 400, height: 800 }, colorScheme: 'dark' }])
  await open(archivePage, settings, async (page) => {
    const elites = await readArchive(page)
    assert.ok((await page.locator('#archive-of-elites').textContent()).includes(`${elites} elites in 400 niches`))
    assert.equal(await page.locator('.problems').count(), 0)
  })

await open(damagedPage, {}, async (page) => {
  assert.match(await page.locator('.problems').textContent(), /archive\.bin – it is no usable archive/)
  await readArchive(page)
})

/** What three.js has drawn, without what the page has under, over and around it. */
const ALONE = `* { visibility: hidden !important }
  .stage canvas { visibility: visible !important; outline: none !important; background: gray !important }`
async function picture(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))))
  return (await page.locator('.stage canvas').screenshot({ style: ALONE })).toString('base64')
}

/** What `change` does is seen in the canvas. */
async function changes(page, what, change) {
  const before = await picture(page)
  await change()
  assert.notEqual(await picture(page), before, `${what} changes nothing in the picture`)
}

for (const settings of [{}, { viewport: { width: 400, height: 800 }, colorScheme: 'dark' }])
  await open(walkerPage, settings, async (page) => {
    const canvas = page.locator('.stage canvas')
    const slider = page.getByRole('slider', { name: 'Time' })
    await canvas.scrollIntoViewIfNeeded()
    assert.equal(await picture(page), await picture(page))
    await changes(page, 'the slider', () => slider.fill('20'))
    await changes(page, 'a key on the slider', () => slider.press('ArrowRight'))
    await changes(page, 'another view', () => page.getByRole('button', { name: 'Nearer' }).click())
    await changes(page, 'a key on the picture', () => canvas.press('ArrowLeft'))
    const box = await canvas.boundingBox()
    await changes(page, 'dragging', async () => {
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2)
      await page.mouse.down()
      await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 10)
      await page.mouse.up()
    })
    await play(page)
    const bars = page.locator('#walk svg rect')
    await bars.first().waitFor({ state: 'attached' })
    const before = await bars.count()
    assert.ok(before >= 4, `${before} bars are too few for two feet that swing, real and expected`)
    const rows = (await saved(page, 'Save “The walk of the trial” as CSV')).trim().split('\n')
    assert.match(rows[0], /left foot.*predicted right foot.*predicted x/)
    assert.equal(rows.length, 52)
  })
await browser.close()

browser = await launch('--disable-3d-apis')
await open(walkerPage, {}, async (page) => {
  assert.match(await page.locator('.stage').textContent(), /WebGL 2 is switched off or missing/)
  await page.getByRole('slider', { name: 'Time' }).fill('20')
})

await browser.close()
console.log('every page is as it should be')
