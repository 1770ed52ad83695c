// Tests of what figures show, for units.mjs.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import { source } from './sources.mjs'

const { errorSeries, firstModel, laterModels } = await source('run_errors')
const { firstValues, hasIntervals, keepsPrior } = await source('run_model')
const { bandStrength, fit } = await source('chart')
const { linearTick, logTick, logTicks, powersOfTen, tick, tickRoom, wholeTicks } = await source('ticks')
const { isChoice, isChoiceOfRuns } = await source('choices')
const { thatKeepThePrior } = await source('campaign_parameters')
const { variantLooks } = await source('colours')
const { besideEachOther, returns } = await source('campaign_figures')
const { medianPoint } = await source('groups')
const { held, predictedSeries } = await source('states')
const { placesOf } = await source('export')
const { whichPolicy } = await source('run_robustness')
const { indexOfMax } = await source('data')
const { onTheRobot } = await source('run_returns')

test('returns of a task that cannot say solved are none of trials that failed', () => {
  const trials = { trial: [1, 2], return: [3, 4], solved: [null, null] }
  const unknown = onTheRobot(trials)
  assert.ok(unknown.points.every(({ hollow }) => !hollow))
  assert.deepEqual(
    unknown.legend.map(({ label }) => label),
    ['on the robot'],
  )
  const known = onTheRobot({ ...trials, solved: [0, 1] })
  assert.deepEqual(
    known.points.map(({ hollow }) => hollow),
    [true, false],
  )
  assert.equal(known.legend.length, 2)
  const never = onTheRobot({ ...trials, solved: [0, 0] })
  assert.deepEqual(
    never.legend.map(({ label }) => label),
    ['on the robot, not solved'],
  )
})

test('the first model is the prior as given, unless it has learned from logs', () => {
  assert.equal(firstModel({ prior: 'light' }, 1), 'trial 1: the prior as given')
  assert.equal(firstModel({ prior: 'light', logs: true }, 1), 'trial 1: the model from the logs')
  assert.equal(firstModel({ prior: '', logs: true }, 1), 'trial 1: the model from the logs')
  assert.equal(firstModel({ prior: '' }, 2), 'trial 2: the first model')
  assert.equal(laterModels(2, 5), 'trials 2 to 5, faint to strong')
  assert.equal(laterModels(2, 2), 'trial 2')
  assert.match(firstValues({}), /the prior as given/)
  assert.match(firstValues({ logs: true }), /the model from the logs/)
})

test('figures take more numbers than a function takes arguments', () => {
  const many = Array.from({ length: 300_000 }, (_, i) => i)
  assert.deepEqual(fit(many, { zero: true }), { domain: [0, 1.04 * 299_999] })
  assert.equal(wholeTicks(many, 10).at(-1), 299_000)
  assert.deepEqual(powersOfTen(many), [1, 10, 100, 1000, 10_000, 100_000])
  assert.equal(indexOfMax(many), 299_999)
})

test('logarithmic axes have plain numbers, also where they span little', () => {
  assert.deepEqual(logTicks([0.002, 3]), [0.01, 0.1, 1])
  assert.deepEqual(logTicks([0.08, 0.3]), [0.1, 0.2])
  assert.deepEqual(logTicks([0.0015, 0.006]), [0.002, 0.005])
  assert.equal(logTicks([0.21, 0.45]), undefined)
  assert.equal(logTicks([]), undefined)
  const shown = {
    0.2: '0.2',
    0.25: '0.25',
    0.002: '2·10⁻³',
    0.00025: '2.5·10⁻⁴',
    1000: '10³',
    100: '100',
    1e-12: '10⁻¹²',
  }
  for (const [value, text] of Object.entries(shown)) assert.equal(logTick(Number(value)), text)
})

test('intervals of many groups stay in their trial', () => {
  for (const of of [1, 2, 9, 17, 40]) {
    const places = Array.from({ length: of }, (_, i) => besideEachOther(i, of))
    assert.ok(places.every((x) => Math.abs(x) < 0.45))
    assert.ok(Math.abs(places[0] + places[of - 1]) < 1e-12)
  }
  assert.ok(Math.abs(besideEachOther(1, 2) - 0.06) < 1e-12)
})

test('no two of many variants look the same, nor like one of another learner', () => {
  const learners = ['circle', 'square'].map((symbol) => ({ colour: 'blue', symbol }))
  for (const n of [1, 4, 5, 12, 17, 24]) {
    const all = learners.map((look) => variantLooks(look, n, ['circle', 'square']))
    for (const some of all) assert.equal(new Set(some.map((look) => JSON.stringify(look))).size, n)
    assert.ok(all[0].every(({ symbol }) => symbol !== 'square'))
    if (n <= 4) assert.ok(all[1].every(({ symbol }) => symbol === 'square'))
  }
})

test('many bands over each other are lighter', () => {
  const some = (n) => Array.from({ length: n }, () => ({ points: [{ x: 0, y: 1, band: [0, 2] }] }))
  assert.equal(bandStrength([]), 1)
  assert.equal(bandStrength([...some(4), { points: [{ x: 0, y: 1 }] }]), 1)
  assert.equal(bandStrength(some(16)), 0.25)
})

test('an action holds until the end of the trial', () => {
  const points = [
    { x: 0, y: 1 },
    { x: 0.1, y: 2 },
  ]
  assert.deepEqual(held({ points }, [0, 0.1, 0.2]), { points: [...points, { x: 0.2, y: 2 }], held: true })
  assert.deepEqual(held({ points }, [0, 0.1]).points, points)
  assert.deepEqual(held({ points: [] }, [0]).points, [])
})

test('a legend has intervals where there are some', () => {
  const empty = { 'phi.m': [1, 1], 'phi.m.low': [null, null], 'phi.m.high': [null, null] }
  assert.equal(hasIntervals(empty, ['phi.m']), false)
  assert.equal(hasIntervals({ ...empty, 'phi.m.low': [null, 0.5] }, ['phi.m']), true)
  assert.equal(hasIntervals({ 'phi.m': [1] }, ['phi.m']), false)
})

test('a parameter is a choice where all its values are whole and none has an interval', () => {
  assert.ok(isChoice([-1, 2, null, 2], [null, null]))
  assert.ok(!isChoice([1, 2], [null, 1.9]))
  assert.ok(!isChoice([1, 1.5], []))
  assert.ok(!isChoice([1, 2], [], 0.5))
  const group = (rows, truth = null) => ({
    truth,
    trials: rows.map(([quartile_1, median, quartile_3]) => ({ quartile_1, median, quartile_3 })),
  })
  assert.ok(
    isChoiceOfRuns([
      group([[-1, -1, -1]]),
      group([
        [-1, 1.5, 4],
        [4, 4, 4],
        [null, null, null],
      ]),
    ]),
  )
  assert.ok(
    !isChoiceOfRuns([
      group([
        [0.5, 0.5, 0.5],
        [1, 1, 1],
      ]),
    ]),
  )
  assert.ok(
    !isChoiceOfRuns([
      group([
        [1, 1, 1],
        [1, 1.1, 1.25],
      ]),
    ]),
  )
  assert.ok(!isChoiceOfRuns([group([[1, 1, 1]]), group([[1, 1, 1]])]))
  assert.ok(
    !isChoiceOfRuns([
      group(
        [
          [1, 1, 1],
          [2, 2, 2],
        ],
        1.5,
      ),
    ]),
  )
})

test('what keeps the parameters of the prior is no figure', () => {
  const trials = { trial: [1, 2], 'phi.m': [1, 1], 'phi.l': [0.5, 0.5], 'phi.l.low': [null, null] }
  assert.ok(keepsPrior({ trials }))
  assert.ok(!keepsPrior({ trials, logs: true }))
  assert.ok(!keepsPrior({ trials: { ...trials, 'phi.m': [1, 1.1] } }))
  assert.ok(!keepsPrior({ trials: { ...trials, 'phi.l.low': [null, 0.4], 'phi.l.high': [null, 0.6] } }))
  assert.ok(!keepsPrior({ trials: { trial: [1], 'phi.m': [1] } }))
  assert.ok(!keepsPrior({ trials: { trial: [1, 2] } }))
  const of = (learner, parameter, ...medians) => ({
    ...{ learner, prior: 'light', variant: '', parameter, truth: 1 },
    trials: medians.map((median) => ({ quartile_1: median, median, quartile_3: median })),
  })
  const all = [of('a', 'm', 1, 1), of('a', 'l', 2, 2), of('b', 'm', 1, 1), of('b', 'l', 2, 1), of('c', 'm', 1)]
  assert.deepEqual(thatKeepThePrior(all), [JSON.stringify(['a', 'light', ''])])
})

test('a campaign without a trial has no figures of returns', () => {
  const group = { learner: 'gp-mi', prior: '', variant: '', trials: [] }
  assert.equal(
    returns({ summary: { groups: [group] } }, () => ({})),
    null,
  )
})

test('robustness says whose it is', () => {
  const columns = { trial: [1, 1], seconds: [8, 8], episodes: [100, 100], factor: [0.75, 1] }
  const parameters = [{ parameter: 'm', columns }]
  assert.equal(
    whichPolicy({ settings: 'measurement_noise=0.01', parameters }),
    ' It is the policy of trial 1 in 100 episodes of 8 s for each value, with measurement_noise=0.01.',
  )
  assert.match(whichPolicy({ settings: '', parameters }), /for each value\.$/)
  assert.equal(whichPolicy({ settings: '', parameters: [{ parameter: 'm', columns: { factor: [1] } }] }), '')
})

test('a group has no point where no run is left', () => {
  const quarters = { quartile_1: null, median: null, quartile_3: null }
  assert.deepEqual(medianPoint(null, quarters, 'trial 3', 0), [])
  assert.deepEqual(medianPoint(null, { ...quarters, median: 4 }, 'trial 3', 0), [])
})

test('linear axes have powers of ten where plain numbers are too long', () => {
  const shown = (domain, ...ticks) => ticks.map(linearTick(domain)).join(' ')
  assert.equal(shown([-1e-15, 3e-14], 0, 5e-15, 3e-14), '0 5·10⁻¹⁵ 3·10⁻¹⁴')
  assert.equal(shown([-2.5e-4, 1e-4], -2e-4, 1e-4), '−2·10⁻⁴ 10⁻⁴')
  assert.equal(shown([0, 3e6], 5e5, 1e6, 2.5e6), '5·10⁵ 10⁶ 2.5·10⁶')
  assert.equal(shown([0, 1.5e12], 5e11, 1e12, 1.5e12), '5·10¹¹ 10¹² 1.5·10¹²')
  assert.equal(shown([-2.5, 2.5], -2.5, 0, 0.1 + 0.2), '−2.5 0 0.3')
  assert.equal(shown([0, 0.002], 0.0005, 0.0015), '0.0005 0.0015')
  assert.equal(shown([1000, 1001], 1000, 1000.5), '1\u202f000 1\u202f000.5')
  assert.equal(shown([0, 9e5], -5e4, 15e4), '−50\u202f000 150\u202f000')
  assert.equal(tick(1200), '1\u202f200')
  assert.equal(tickRoom([0, 150_000]), tickRoom([0, 3e-14]))
  for (const small of [[-250, 2.5], [0, 0], []]) assert.ok(tickRoom(small) < tickRoom([0, 150_000]))
})

test('a prediction ends where fewer than half of the episodes are left, and says how many are', () => {
  const columns = (name) => ['mean', '5%', '25%', '75%', '95%'].map((part) => [`${name} ${part}`, [1, 2, 3, 4]])
  const prediction = Object.fromEntries([
    ['time [s]', [0, 1, 2, 3]],
    ['particles', [100, 60, 49, 80]],
    ...columns('z'),
    ...columns('reward'),
  ])
  const { points } = predictedSeries('z', prediction)
  assert.deepEqual(
    points.map(({ y, note }) => [y, note]),
    [
      [1, undefined],
      [2, '60 of 100 simulated episodes go on'],
    ],
  )
  assert.equal(predictedSeries('reward', prediction).points.length, 4) // of all episodes
  const { particles, ...older } = prediction
  assert.equal(predictedSeries('z', older).points.length, 4)
})

test('an error says how often predictions were compared, and is hollow where some failed', () => {
  const errors = { trial: [1, 1], horizon: [1, 10], 'rms z': [0.1, 0.2] }
  const points = (more) => errorSeries({ ...errors, ...more }, 'rms z', 1, 0).points
  assert.deepEqual(points({ compared: [10, 1], failed: [0, 2] }), [
    { x: 1, y: 0.1, hollow: false, note: '10 compared, 0 failed' },
    { x: 10, y: 0.2, hollow: true, note: '1 compared, 2 failed' },
  ])
  assert.deepEqual(points({}), [
    { x: 1, y: 0.1 },
    { x: 10, y: 0.2 },
  ])
})

test('a legend of an SVG is wrapped at its width', () => {
  const entries = (...labels) => labels.map((label) => ({ label, colour: 'blue' }))
  const five = placesOf(entries(...Array(5).fill('gp-mi, without-front-left')), 720)
  assert.deepEqual(
    five.map(({ row }) => row),
    [0, 0, 0, 1, 1],
  )
  assert.equal(five[3].x, 0)
  assert.deepEqual(placesOf(entries('x'.repeat(200), 'y'), 300), [
    { x: 0, row: 0 },
    { x: 0, row: 1 },
  ])
  assert.deepEqual(placesOf([], 300), [])
})
