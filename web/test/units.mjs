// units.mjs PACKAGES: tests of those sources of the page that need no browser. PACKAGES: the folder of node_modules.
// Exits with 77 where there are none.
import assert from 'node:assert/strict'
import { existsSync } from 'node:fs'
import { createRequire } from 'node:module'
import { test } from 'node:test'
import { fileURLToPath } from 'node:url'

const packages = process.argv[2]
if (!existsSync(`${packages}/node_modules/esbuild`)) process.exit(77)
const { buildSync } = createRequire(`${packages}/`)('esbuild')

/** A source of the page as a module. */
async function source(name) {
  const path = fileURLToPath(new URL(`../src/${name}.ts`, import.meta.url))
  const settings = { bundle: true, format: 'esm', write: false, nodePaths: [`${packages}/node_modules`] }
  const { outputFiles } = buildSync({ entryPoints: [path], ...settings })
  return import(`data:text/javascript,${encodeURIComponent(outputFiles[0].text)}`)
}

const { partsOf, TWO_SCREENS } = await source('parts')
const { rangesOf, relativeErrors } = await source('state_errors')
const { partFolds, partsOfRobot } = await source('part_folds')
const { firstModel, laterModels } = await source('run_errors')
const { firstValues, hasIntervals } = await source('run_model')
const { bandStrength, fit, logTicks, plainTick, powersOfTen, wholeTicks } = await source('chart')
const { variantLooks } = await source('colours')
const { besideEachOther, returns } = await source('campaign_figures')
const { held } = await source('states')
const { whichPolicy } = await source('run_robustness')
const { indexOfMax } = await source('data')
const { outcome } = await source('limits')
const { onTheRobot } = await source('run_returns')
const { bestRow } = await source('trials')

const named = (states, others) =>
  Object.fromEntries(partsOf(states, others).map((part) => [part.name, [...part.states, ...part.others].join(', ')]))
const withRates = (joints) => [...joints, ...joints.map((joint) => `d ${joint}`)]

test('the legs of a walker are parts, and its trunk is not', () => {
  const joints = ['rear-left coxa', 'rear-left femur', 'mid-right coxa', 'mid-right femur']
  const trunk = ['rotation x', 'rotation y', 'x', 'y', 'omega x', 'v x']
  assert.deepEqual(named([...withRates(joints), ...trunk], [...joints.map((one) => `${one} target`), 'reward']), {
    'rear-left':
      'rear-left coxa, rear-left femur, d rear-left coxa, d rear-left femur, rear-left coxa target, rear-left femur target',
    'mid-right':
      'mid-right coxa, mid-right femur, d mid-right coxa, d mid-right femur, mid-right coxa target, mid-right femur target',
    '': 'rotation x, rotation y, x, y, omega x, v x, reward',
  })
})

test('names with underscores, as MuJoCo’s models have them, are parted the same', () => {
  const states = ['FL_hip', 'FL_calf', 'RR_hip', 'RR_calf', 'dFL_hip', 'd_FL_calf', 'dRR_hip', 'd_RR_calf', 'height']
  assert.deepEqual(named(states, ['FL_hip_torque', 'reward']), {
    FL: 'FL_hip, FL_calf, dFL_hip, d_FL_calf, FL_hip_torque',
    RR: 'RR_hip, RR_calf, dRR_hip, d_RR_calf',
    '': 'height, reward',
  })
})

test('numbers name the joints of an arm', () => {
  assert.deepEqual(named(['q1', 'q2', 'dq1', 'dq2', 'load'], ['torque1', 'torque2', 'reward']), {
    q1: 'q1, dq1, torque1',
    q2: 'q2, dq2, torque2',
    '': 'load, reward',
  })
  assert.deepEqual(Object.keys(named(['joint 1', 'joint 2'], ['u 1', 'u 2'])), ['joint 1', 'joint 2'])
})

test('a word that would take more than two screens is followed by the next', () => {
  const joints = [1, 2, 3].flatMap((leg) => ['hip', 'knee', 'foot'].map((joint) => `leg ${leg} ${joint}`))
  assert.ok(2 * joints.length > TWO_SCREENS)
  assert.deepEqual(Object.keys(named(withRates(joints), ['reward'])), ['leg 1', 'leg 2', 'leg 3', ''])
})

test('every variable is in one part', () => {
  const [states, others] = [
    ['a b', 'd', 'd a', 'd a b', '1', 'x.y', '', 'a b c'],
    ['a b c d', 'reward', ' '],
  ]
  const all = partsOf(states, others).flatMap((part) => [...part.states, ...part.others])
  assert.deepEqual(all.sort(), [...states, ...others].sort())
})

/** One trial of two lines and their predictions, as columns of the data of a page. */
const episode = (a, b, predictedA, predictedB) => ({
  trajectory: { 'time [s]': [0, 1], 'a [m]': a, 'b [m]': b, 'true a [m]': a, 'true b [m]': b, 'u [N]': [1, null] },
  prediction: predictedA ? { 'time [s]': [0, 1], 'a mean [m]': predictedA, 'b mean [m]': predictedB } : null,
})

test('an error is relative to the range of all trials, or to a tenth of the widest of its unit', () => {
  const episodes = [
    episode([0, 2], [0, 0]),
    episode([0, 1], [0, 0], [0, 1], [0.25, 0.25]),
    episode([0, 4], [0, 0], [0, 2], [0, 9]),
  ]
  const ranges = rangesOf(episodes)
  assert.deepEqual(
    [...ranges],
    [
      ['a', 4],
      ['b', 0.4],
    ],
  )
  assert.deepEqual([...relativeErrors(episodes[0], ranges)], [])
  assert.deepEqual(
    [...relativeErrors(episodes[1], ranges)],
    [
      ['a', 0],
      ['b', 0.25 / 0.4],
    ],
  )
  assert.deepEqual(
    [...relativeErrors(episodes[2], ranges)],
    [
      ['a', Math.SQRT2 / 4],
      ['b', 1],
    ],
  )
})

test('what is not measured or not predicted is no error', () => {
  const one = episode([0, null], [0, 1], [0, 5], [null, null])
  assert.deepEqual([...relativeErrors(one, rangesOf([one]))], [['a', 0]])
  assert.deepEqual([...rangesOf([{ trajectory: null, prediction: null }])], [])
})

test('the worst part stands first and open, and the others as long as two screens are not full', () => {
  const parts = ['a', 'b', 'c'].map((name) => ({
    name,
    states: [1, 2, 3, 4, 5, 6].map((i) => `${name} ${i}`),
    others: [],
  }))
  const panels = parts.flatMap(({ states }) => states.map((of) => ({ of, title: of, draw: () => null })))
  const errors = new Map(panels.map(({ of }) => [of, { a: 0.0001, b: 0.5, c: 0.2 }[of[0]]]))
  const folds = partFolds(parts, panels, errors.set('b 3', 2))
  assert.deepEqual(
    folds.map(({ title, open }) => `${title} ${open}`),
    ['b true', 'c true', 'a false'],
  )
  assert.equal(
    folds[0].about,
    '1, 2, 3, 4, 5, 6. The model is off by 75 % of the range on average, by most for b 3: 100 % or more.',
  )
  assert.equal(folds[2].about, '1, 2, 3, 4, 5, 6. The model is off by less than 0.1 % of the range on average.')
  const unknown = partFolds(parts, panels, new Map())
  assert.deepEqual(
    unknown.map(({ title }) => title),
    ['a', 'b', 'c'],
  )
  assert.match(unknown[0].about, /There is no prediction\.$/)
})

test('robots with few states, or without parts, have none', () => {
  const robot = (states) => ({
    trajectory: Object.fromEntries(
      [...states, ...states.map((state) => `true ${state}`), 'reward'].map((key) => [key, [0]]),
    ),
  })
  const legs = withRates(['left hip', 'left knee', 'right hip', 'right knee'])
  assert.deepEqual(partsOfRobot([robot(legs)]), [])
  assert.deepEqual(partsOfRobot([robot('abcdefghijklmnopqrstuvw'.split(''))]), [])
  const arms = withRates(['left arm', 'left hand', 'right arm', 'right hand'])
  assert.deepEqual(
    partsOfRobot([robot([...legs, ...arms])]).map(({ name }) => name),
    ['left', 'right', ''],
  )
  assert.deepEqual(partsOfRobot([]), [])
})

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

test('a broken limit does not say that a robot was stopped, which may have been told', () => {
  assert.equal(outcome(1), 'broken, the trial counts up to there')
  assert.equal(outcome(0), 'kept')
})

test('figures take more numbers than a function takes arguments', () => {
  const many = Array.from({ length: 300_000 }, (_, i) => i)
  assert.deepEqual(fit(many, { zero: true }), { domain: [0, 1.04 * 299_999] })
  assert.equal(wholeTicks(many, 10).at(-1), 299_000)
  assert.deepEqual(powersOfTen(many), [1, 10, 100, 1000, 10_000, 100_000])
  assert.equal(indexOfMax(many), 299_999)
})

test('a trial that was cut short is not the best, unless all were', () => {
  assert.equal(bestRow({ return: [-9, -8, -1], cut_short: [0, 0, 1] }), 1)
  assert.equal(bestRow({ return: [-9, -8, -1] }), 2)
  assert.equal(bestRow({ return: [-9, -8], cut_short: [1, 1] }), 0)
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
  for (const [value, text] of Object.entries(shown)) assert.equal(plainTick(Number(value)), text)
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
