// browser.mjs CHROMIUM PACKAGES FOLDER: a reader's way through real reports. Fails on anything that a page says on the
// console, on any request, and on what it does not show. PACKAGES: the folder of node_modules. FOLDER: has the pages of
// these names; report.sh makes them.
import assert from 'node:assert/strict'
import { cursors, moveSlider, play, print, Reader } from './reader.mjs'

const [chromium, packages, folder] = process.argv.slice(2)
const reader = await Reader.start(chromium, packages)
const open = (page, settings, visit) => reader.open(`${folder}/${page}.html`, settings, visit)

await open('run/report', {}, async (page) => {
  assert.equal(await page.locator('h1').textContent(), 'gp-mi on pendubot')
  assert.match(await page.locator('.lead').textContent(), /^swing up two links .*; solved: the tip within 0\.2 m/)
  assert.equal(await page.locator('#trajectory input, #moments-by-trial').count(), 0) // GPs around a simulator have none
  await moveSlider(page)
  const top = page.locator('#trajectory .panel').first().locator('g[aria-label=line] g').last()
  assert.equal(await top.getAttribute('stroke-dasharray'), '6 3') // a prediction that is right is seen on the robot's line
  await play(page)
  await page.getByRole('combobox', { name: 'Trial' }).selectOption('Trial 1')
  const first = await page.locator('.player .about').textContent()
  await page.getByRole('button', { name: 'Next trial' }).click()
  assert.notEqual(await page.locator('.player .about').textContent(), first)
  await page.getByRole('button', { name: 'Dark' }).click()
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), 'dark')
  await print(page)

  const svg = await reader.saved('Save “Return, predicted and real” as SVG')
  assert.match(svg, /^<svg [^]*Return, predicted and real[^]*<\/svg>$/)
  assert.doesNotMatch(svg, /var\(|light-dark/)
  const csv = (await reader.saved('Save “Return, predicted and real” as CSV')).trim().split('\n')
  assert.equal(csv[0], 'trial,interaction_s,return,solved,predicted_return')
  assert.equal(csv.length, 3)
  const identified = page.locator('#parameters-by-trial')
  await identified.scrollIntoViewIfNeeded()
  await identified.locator('.panel').first().waitFor()
  assert.equal(await identified.locator('.panel').count(), 4) // none for the intervals
  assert.match(await identified.textContent(), /95 % interval.*the robot’s own value/)
  const robust = page.locator('#robustness-by-parameter')
  await robust.scrollIntoViewIfNeeded()
  await robust.locator('.panel').first().waitFor()
  assert.deepEqual(await robust.locator('.panel h4').allTextContents(), ['m1', 'm2', 'l1', 'l2', 'b1', 'b2'])
  assert.match(await robust.textContent(), /How often the policy solves the task/)
  const changed = (await reader.saved('Save “Robustness: one parameter of the robot at a time” as CSV'))
    .trim()
    .split('\n')
  assert.match(
    await robust.textContent(),
    /policy of trial \d in 6 episodes of 2\.5 s for each value, with measurement_noise=0\.01\./,
  )
  assert.match(changed[0], /^parameter,settings,trial,seed,seconds,factor,value,episodes,solved,/)
  assert.equal(changed.length, 1 + 6 * 5)
  const warnings = await identified.locator('.warnings li').allTextContents()
  assert.equal(warnings.at(-1), 'm1 and m2 cannot be told apart by these data.')
  const parameters = await reader.saved('Save “Parameters of the prior” as CSV')
  assert.match(parameters, /^trial,phi\.m1,phi\.m1\.low,phi\.m1\.high,phi\.m2,/)
})

/** The lines of moment matching in the figure of the states. */
const outlines = (page) => page.locator('#trajectory g[stroke="var(--green)"]').count()

for (const settings of [{}, { viewport: { width: 400, height: 800 }, colorScheme: 'dark' }])
  await open('moments/report', settings, async (page) => {
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
    const csv = (await reader.saved('Save “Moment matching against samples” as CSV')).trim().split('\n')
    assert.equal(csv[0], 'trial,sampled_return,moment_return,apart,state,time_s,spread')
    assert.equal(csv.length, 2) // none of the random first trial
  })

await open('logs/identify', { viewport: { width: 400, height: 800 } }, async (page) => {
  assert.ok((await page.locator('svg .measured').count()) > 0)
})

await open('replay', { colorScheme: 'dark' }, async (page) => {
  assert.match(await page.locator('h1').textContent(), /trial 2$/)
  await moveSlider(page)
})

await open('campaign/report', { viewport: { width: 400, height: 800 } }, async (page) => {
  const problems = await page.locator('.problems li').allTextContents()
  for (const name of ['stray.txt', 'trials.csv', 'another version'])
    assert.ok(
      problems.some((line) => line.includes(name)),
      `${name} is not named`,
    )
  await page.locator('#return-by-interaction-time').scrollIntoViewIfNeeded()
  await page.getByRole('radio', { name: 'best so far' }).press('Space')
  await page.locator('#success-by-trial').scrollIntoViewIfNeeded()
  const csv = await reader.saved('Save “Return against time on the robot” as CSV')
  assert.match(csv, /^learner,prior,variant,trial,runs,interaction_s,return_min,/)
})

await open('bent/report', {}, async (page) => {
  assert.match(await page.locator('.problems').textContent(), /row 3: return = 7\.0x3, must be a number/)
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

  const csv = (await reader.saved('Save “Which policies of the archive were tried” as CSV')).trim().split('\n')
  assert.equal(csv[0], 'trial,elite,promised,predicted_return,return,learned')
  const trials = csv.slice(1).map((line) => line.split(',').map(Number))
  assert.equal(trials.map(([trial, , , , , learned]) => `${trial}:${learned}`).join(), '1:1,2:1,3:0')
  assert.equal(trials[0][2], trials[0][3], 'before the first trial another return is predicted than by the prior')
  const labels = await panels.nth(1).locator('[aria-label=trials] text').allTextContents()
  assert.equal(labels.length, new Set(trials.map(([, elite]) => elite)).size)
  assert.ok(labels.includes('1'))

  const elites = (await reader.saved(`Save “${ARCHIVE}” as CSV`)).trim().split('\n')
  assert.match(elites[0], /^tip x at 0\.8 s \[m\],.*,promised,expected,trials$/)
  assert.match(elites[trials[0][1]], /,1( 3)?$/)
  const svg = await reader.saved(`Save “${ARCHIVE}” as SVG`)
  assert.doesNotMatch(svg, /var\(|light-dark/)
  await page.getByRole('radio', { name: 'every pair' }).press('Space')
  assert.equal(await panels.count(), 30)
  return elites.length - 1
}

for (const settings of [{}, { viewport: { width: 400, height: 800 }, colorScheme: 'dark' }])
  await open('ite/report', settings, async (page) => {
    const elites = await readArchive(page)
    assert.ok((await page.locator('#archive-of-elites').textContent()).includes(`${elites} elites in 400 niches`))
    assert.equal(await page.locator('.problems').count(), 0)
  })

await open('damaged/report', {}, async (page) => {
  assert.match(await page.locator('.problems').textContent(), /archive\.bin – it is no usable archive/)
  await readArchive(page)
})

/** The canvas of three.js alone, without the page under, over and around it. */
const ALONE = `* { visibility: hidden !important }
  .stage canvas { visibility: visible !important; outline: none !important; background: gray !important }`
async function picture(page) {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))))
  return (await page.locator('.stage canvas').screenshot({ style: ALONE })).toString('base64')
}

/** Asserts that `change` changes the canvas. before: the last picture. Returns the new one. */
async function changed(page, before, what, change) {
  await change()
  const now = await picture(page)
  assert.notEqual(now, before, `${what} changes nothing in the picture`)
  return now
}

for (const settings of [{}, { viewport: { width: 400, height: 800 }, colorScheme: 'dark' }])
  await open('walker/report', settings, async (page) => {
    const canvas = page.locator('.stage canvas')
    const slider = page.getByRole('slider', { name: 'Time' })
    await canvas.scrollIntoViewIfNeeded()
    const still = await picture(page)
    assert.equal(await picture(page), still)
    const box = await canvas.boundingBox()
    const drag = async () => {
      await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2)
      await page.mouse.down()
      await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 10)
      await page.mouse.up()
    }
    let seen = await changed(page, still, 'the slider', () => slider.fill('20'))
    seen = await changed(page, seen, 'a key on the slider', () => slider.press('ArrowRight'))
    seen = await changed(page, seen, 'another view', () => page.getByRole('button', { name: 'Nearer' }).click())
    seen = await changed(page, seen, 'a key on the picture', () => canvas.press('ArrowLeft'))
    await changed(page, seen, 'dragging', drag)
    await play(page)
    const bars = page.locator('#walk svg rect')
    await bars.first().waitFor({ state: 'attached' })
    const before = await bars.count()
    assert.ok(before >= 4, `${before} bars are too few for two feet that swing, real and expected`)
    const rows = (await reader.saved('Save “The walk of the trial” as CSV')).trim().split('\n')
    assert.match(rows[0], /left foot.*predicted right foot.*predicted x/)
    assert.equal(rows.length, 52)
  })

// The robot of many.mjs.
const JOINTS = ['hip', 'knee', 'ankle']
const WHOLE = 'the robot as a whole'
const LONG = 'pitch_of_the_trunk_as_filtered_by_the_estimator'
const WORST_FIRST = {
  1: ['front true', 'middle false', 'hind false', `${WHOLE} false`],
  2: ['hind true', 'middle false', 'front false', `${WHOLE} false`],
  errors: ['middle true', 'hind true', 'front false', `${WHOLE} false`],
}
const panelsOf = (leg) => [
  ...JOINTS.map((joint) => `${leg} ${joint} (rad)`),
  ...JOINTS.map((joint) => `d ${leg} ${joint} (rad/s)`),
  ...JOINTS.map((joint) => `${leg} ${joint} target (rad)`),
]
const A_LEG = panelsOf('').length

/** The parts in a figure of a robot with many states, from above. */
async function partsOf(page, figure) {
  const folds = page.locator(`${figure} details`)
  await folds.first().waitFor()
  return folds.evaluateAll((all) => all.map((one) => `${one.querySelector('strong').textContent} ${one.open}`))
}

/** Whichever part the model got most wrong in a trial stands first, alone open. */
async function worstFirst(page) {
  await page.locator('#trajectory').scrollIntoViewIfNeeded()
  for (const trial of [1, 2]) {
    await page.getByRole('combobox', { name: 'Trial' }).selectOption(`Trial ${trial}`)
    assert.deepEqual(await partsOf(page, '#trajectory'), WORST_FIRST[trial])
  }
  assert.deepEqual(await page.locator('#trajectory .panel h4').allTextContents(), panelsOf('hind'))
  assert.match(
    await page.locator('#trajectory summary').first().textContent(),
    /^hind hip, knee, ankle, their rates, 3 actions\. The model is off by 4\d % of the range on average, by most for .*hind .*: 4\d %\.$/,
  )
  await page.locator('#prediction-error').scrollIntoViewIfNeeded()
  assert.deepEqual(await partsOf(page, '#prediction-error'), WORST_FIRST.errors)
}

await open('many/report', {}, async (page) => {
  await worstFirst(page)
  const summaries = page.locator('#trajectory summary')
  const panels = page.locator('#trajectory .panel h4')
  const count = (n) => page.waitForFunction((n) => document.querySelectorAll('#trajectory .cursor').length === n, n)
  await page.getByRole('slider', { name: 'Time' }).fill('20')
  await summaries.nth(1).press('Enter') // what is opened stands at the same time as the rest
  await count(2 * A_LEG)
  const at = await cursors(page)
  assert.ok(
    at.every((x) => x === at[0]),
    `cursors at ${at}`,
  )
  await summaries.first().press('Space')
  await count(A_LEG)
  await page.getByRole('combobox', { name: 'Trial' }).selectOption('Trial 1') // and stays open, or folded
  assert.deepEqual(await partsOf(page, '#trajectory'), ['front true', 'middle true', 'hind false', `${WHOLE} false`])
  assert.equal((await cursors(page)).length, 2 * A_LEG)
  await page.locator('#trajectory').getByRole('button', { name: 'Open all' }).press('Enter')
  assert.equal(await panels.count(), 3 * A_LEG + 3) // height, pitch and the reward
  const svg = await reader.saved('Save “States, action and reward of the trial” as SVG')
  for (const title of ['front', 'middle', 'hind'].flatMap(panelsOf)) assert.ok(svg.includes(`>${title}<`), title)
  await page.locator('#trajectory').getByRole('button', { name: 'Fold all' }).press('Enter')
  assert.equal(await panels.count(), 0)
  assert.ok(
    await page.getByRole('button', { name: 'Save “States, action and reward of the trial” as SVG' }).isDisabled(),
  )
  await page.locator('#trajectory').getByRole('button', { name: 'Open all' }).press('Enter')
})
await open('many/report', { viewport: { width: 400, height: 800 }, colorScheme: 'dark' }, async (page) => {
  await worstFirst(page)
  for (const figure of ['#trajectory', '#prediction-error']) {
    await page.locator(figure).getByRole('button', { name: 'Open all' }).press('Enter') // a long name among others
    await page.locator(`${figure} h4`, { hasText: LONG }).waitFor()
  }
})

await reader.loseWebGL()
await open('walker/report', {}, async (page) => {
  assert.match(await page.locator('.stage').textContent(), /WebGL 2 is switched off or missing/)
  await page.getByRole('slider', { name: 'Time' }).fill('20')
})

await reader.close()
console.log('every page is as it should be')
