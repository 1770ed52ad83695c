// many.mjs RUN: makes the robot of a run folder one of many states, with legs in front, in the middle and behind. The model
// of trial 1 is most wrong about those in front, that of trial 2 about those behind, and long predictions of trial 2 about
// those in the middle.
import { writeFileSync } from 'node:fs'

const run = process.argv[2]
const STEPS = 50
const joints = ['front', 'middle', 'hind'].flatMap((leg) => ['hip', 'knee', 'ankle'].map((joint) => `${leg} ${joint}`))
const states = [
  ...joints.map((name) => ({ name, unit: 'rad', reach: 1 })),
  ...joints.map((name) => ({ name: `d ${name}`, unit: 'rad/s', reach: 6 })),
  { name: 'height', unit: 'm', reach: 0.1 },
  { name: 'pitch_of_the_trunk_as_filtered_by_the_estimator', unit: 'rad', reach: 0.3 },
]
const WRONG = [
  { front: 0.4, middle: 0.2, hind: 0.1 },
  { front: 0.1, middle: 0.2, hind: 0.4 },
]
const LONGEST = { front: 0.1, middle: 0.8, hind: 0.4 }

const legOf = (state) => /front|middle|hind/.exec(state.name)?.[0]
const value = (state, t) => state.reach * Math.sin(0.3 * t + states.indexOf(state))

function write(file, columns) {
  const rows = columns[0].cells.map((_, i) => columns.map(({ cells }) => cells[i]).join(','))
  writeFileSync(`${run}/${file}`, `${[columns.map(({ header }) => header).join(','), ...rows].join('\n')}\n`)
}

const steps = Array.from({ length: STEPS + 1 }, (_, t) => t)
const column = (header, cell) => ({ header, cells: steps.map(cell) })
const time = column('time [s]', (t) => 0.05 * t)

WRONG.forEach((wrong, i) => {
  const trial = `trial-00${i + 1}.csv`
  const real = (prefix) =>
    states.map((state) => column(`${prefix}${state.name} [${state.unit}]`, (t) => value(state, t)))
  const actions = joints.map((name) => column(`${name} target [rad]`, (t) => (t < STEPS ? Math.sign(Math.sin(t)) : '')))
  const reward = column('reward', (t) => (t > 0 ? 0.1 : ''))
  write(`trajectories/${trial}`, [time, ...real(''), ...real('true '), ...actions, reward])
  const predicted = (state, away) => (t) => value(state, t) + 2 * state.reach * ((wrong[legOf(state)] ?? 0.01) + away)
  const parts = Object.entries({
    mean: 0,
    '5%': -0.1,
    '25%': -0.05,
    '50%': 0,
    '75%': 0.05,
    '95%': 0.1,
  })
  const bands = parts.flatMap(([part, away]) =>
    states.map((state) => column(`${state.name} ${part} [${state.unit}]`, predicted(state, away))),
  )
  write(`predictions/${trial}`, [time, column('particles', () => 100), ...bands])
})

const rows = [1, 2].flatMap((trial) => [1, 5, 20].map((horizon) => ({ trial, horizon })))
write('errors.csv', [
  ...['trial', 'horizon'].map((header) => ({
    header,
    cells: rows.map((row) => row[header]),
  })),
  ...states.map((state) => ({
    header: `rms ${state.name} [${state.unit}]`,
    cells: rows.map(({ horizon }) => (state.reach * (LONGEST[legOf(state)] ?? 0.05) * horizon) / 20),
  })),
])
