// units.mjs PACKAGES: tests of those sources of the page that need no browser. PACKAGES: the folder of node_modules.
// Exits with 77 where there are none.
import assert from 'node:assert/strict'
import { test } from 'node:test'
import './figures.mjs'
import { source } from './sources.mjs'

const { partsOf, TWO_SCREENS } = await source('parts')
const { actionDomains, rangesOf } = await source('ranges')
const { relativeErrors } = await source('state_errors')
const { partFolds, partsOfRobot } = await source('part_folds')
const { longestErrors } = await source('run_errors')
const { outcome } = await source('limits')
const { duration, number, percent } = await source('format')
const { spans } = await source('run_tables')
const { bestRow } = await source('trials')
const { withEnds } = await source('data')

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

test('a prediction of which fewer than half of the episodes are left is no error', () => {
  const one = episode([0, 1], [0, 1], [0, 5], [0.5, 9])
  const ranges = rangesOf([one])
  const errors = (particles) => [
    ...relativeErrors({ ...one, prediction: { ...one.prediction, particles } }, ranges).values(),
  ]
  assert.deepEqual(errors([100, 49]), [0, 0.5])
  assert.deepEqual(errors([100, 50]), [1, 1])
})

test('an action has one domain in all trials, and one that hardly moves looks so', () => {
  const trial = (...actions) => ({
    trajectory: Object.fromEntries([['time [s]', [0, 1]], ...actions.map((cells, i) => [`u${i} [N]`, cells])]),
  })
  const domains = (...episodes) => [...actionDomains(episodes).values()].map(({ domain }) => domain)
  const [[low, high]] = domains(trial([-2.5, -2.49999]), trial([-2.5, null]))
  assert.ok(low < -2.6 && high > -2.4, `${low} to ${high} magnifies rounding`)
  const both = domains(trial([0, 1], [0, 0]), trial([2, 5], [3e-14, null]))
  assert.ok(both[0][0] <= 0 && both[0][1] >= 5)
  assert.ok(both[1][0] < -0.2 && both[1][1] > 0.2)
  assert.deepEqual(domains(trial([null, null])), [undefined])
  assert.deepEqual(domains({ trajectory: null }), [])
})

test('the longest prediction counts that was compared five times, else the shortest', () => {
  const errors = { trial: [1, 1, 1], horizon: [1, 2, 5], 'rms a': [0.1, 0.2, 0.9], 'rms b': [null, null, null] }
  const longest = (compared) =>
    Object.fromEntries(longestErrors({ ...errors, ...compared }, ['rms a', 'rms b'], 1, new Map([['a', 1]])))
  assert.deepEqual(longest({ compared: [6, 5, 1] }), { a: 0.2 })
  assert.deepEqual(longest({ compared: [3, 2, 1] }), { a: 0.1 })
  assert.deepEqual(longest({}), { a: 0.9 })
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

test('a broken limit does not say that a robot was stopped, which may have been told', () => {
  assert.equal(outcome(1), 'broken, the trial counts up to there')
  assert.equal(outcome(0), 'kept')
})

test('a trial that was cut short is not the best, unless all were', () => {
  assert.equal(bestRow({ return: [-9, -8, -1], cut_short: [0, 0, 1] }), 1)
  assert.equal(bestRow({ return: [-9, -8, -1] }), 2)
  assert.equal(bestRow({ return: [-9, -8], cut_short: [1, 1] }), 0)
})

test('numbers are written in one way', () => {
  const shown = {
    0: '0',
    '-3': '−3',
    501728: '501\u202f728',
    12345678: '12\u202f345\u202f678',
    1e9: '10⁹',
    123456789012345: '1.23·10¹⁴',
    '-1e12': '−10¹²',
    1234.56: '1\u202f235',
    999999.9: '10⁶',
    2345678.9: '2.35·10⁶',
    0.5: '0.5',
    0.00012345: '1.23·10⁻⁴',
  }
  for (const [value, text] of Object.entries(shown)) assert.equal(number(Number(value)), text)
  assert.equal(number(null), '–')
  assert.equal(percent(0.3), '30 %')
  assert.equal(duration(0.00012), '10⁻⁴ s')
})

test('trials with the same note are one row', () => {
  assert.equal(spans([1, 2, 3, 4]), '1–4')
  assert.equal(spans([5, 1, 2, 2, 7, 8]), '1–2, 5, 7–8')
  assert.equal(spans([3]), '3')
  assert.equal(spans([]), '')
})

test('a predicted robot is not drawn once its prediction has ended', () => {
  const frames = [[0], [1], [2]]
  const { motion } = withEnds({ motion: { frames, predicted: frames }, prediction: { particles: [10, 10, 4] } })
  assert.deepEqual(motion.predicted, [[0], [1], [null]])
})
