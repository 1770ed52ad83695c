// The model of a run: its parameters and its evidence.
import { chart, fit, heights, type Point } from './chart'
import { PREDICTED } from './colours'
import { present, withUnit, type Cell, type Columns, type Run } from './data'
import { h, type Child } from './dom'
import type { Row } from './export'
import { figure } from './figure'
import type { Panel } from './panels'
import { number } from './format'
import type { LegendEntry } from './legend'
import { pointsOf, rowsOf, TRIAL } from './trials'

export function parameters(run: Run): Child {
  const { trials, truth = {}, units = {}, identifiability } = run
  const columns = Object.keys(trials ?? {}).filter((name) => name.startsWith('phi.'))
  const isEnd = (name: string) => /\.(low|high)$/.test(name) && columns.includes(name.replace(/\.[a-z]+$/, ''))
  const names = columns.filter((name) => !isEnd(name))
  if (!trials || names.length === 0 || !trials['trial']?.length) return null
  const panel = (column: string): Panel => {
    const name = column.slice(4)
    const known = truth[name]
    const points = withIntervals(pointsOf(trials, column), trials, column)
    const series = [{ label: name, colour: PREDICTED, points, symbol: 'circle' as const }]
    const values = [...heights({ points }), ...(present(known) ? [known] : [])]
    return {
      title: withUnit({ name, unit: units[name] ?? '' }),
      draw: (width) =>
        chart({
          width,
          height: 190,
          x: TRIAL,
          y: { label: '', ...fit(values, { span: 0.2 }) },
          series,
          rule: present(known) ? { y: known, label: 'robot' } : null,
        }),
    }
  }
  return figure({
    name: 'parameters-by-trial',
    title: 'Parameters of the prior',
    about: h(
      'div',
      {},
      `The model chose each trial’s policy with these values. ${firstValues(run)} ` +
        'A dashed line is the robot’s own value, where the scenario says it.',
      warningList(identifiability, trials['trial']?.at(-1)),
    ),
    ...(hasIntervals(trials, names) ? { legend: INTERVAL_LEGEND } : {}),
    panels: () => names.map(panel),
    table: () => rowsOf(trials, ['trial', ...columns]).map((row) => ({ ...row, ...prefixed('truth.', truth) })),
    minWidth: 220,
    columns: 2,
  }).element
}

export function firstValues({ logs }: Pick<Run, 'logs'>): string {
  return logs ? 'Trial 1 has those of the model from the logs.' : 'Trial 1 has those of the prior as given.'
}

const INTERVAL_LEGEND: LegendEntry[] = [
  { label: 'learned', colour: PREDICTED, symbol: 'circle' },
  { label: '95 % interval', colour: PREDICTED, interval: true, line: false },
]

/** False of a learner that never learns an interval, whose cells are all empty. */
export function hasIntervals(trials: Columns, names: string[]): boolean {
  return names.some((name) => trials[`${name}.low`]?.some(present))
}

function withIntervals(points: Point[], trials: Columns, column: string): Point[] {
  return points.map((point) => {
    const row = trials['trial']?.indexOf(point.x) ?? -1
    const [low, high] = ['low', 'high'].map((end) => trials[`${column}.${end}`]?.[row])
    if (!present(low) || !present(high)) return point
    const tip = `trial ${point.x}\n${number(point.y)}\n${number(low)} to ${number(high)}`
    return { ...point, interval: [low, high], tip }
  })
}

/** Warnings of the last model: parameters that its data cannot separate, or leave uncertain. */
function warningList(warnings: Run['identifiability'], trial: Cell | undefined): Child {
  const last = (warnings?.warning ?? []).filter((_, i) => warnings?.trial[i] === trial)
  if (last.length === 0) return null
  const items = last.map((warning) => h('li', {}, `${warning}.`))
  return h('div', { class: 'warnings' }, 'Identifiability warnings:', h('ul', {}, ...items))
}

export function evidence({ trials }: Run): Child {
  const points = trials ? pointsOf(trials, 'log_evidence') : []
  if (!trials || points.length === 0) return null
  return figure({
    name: 'evidence',
    title: 'Log evidence of the model',
    about: 'It is of all data so far and all outputs together. It grows with the data.',
    panels: () => [
      {
        title: '',
        draw: (width) =>
          chart({
            width,
            height: 320,
            x: TRIAL,
            y: { label: 'nats', ...fit(heights({ points })) },
            series: [{ label: 'log evidence', colour: PREDICTED, points, symbol: 'circle' }],
          }),
      },
    ],
    table: () => rowsOf(trials, ['trial', 'log_evidence']),
  }).element
}

function prefixed(prefix: string, values: Record<string, number>): Row {
  return Object.fromEntries(Object.entries(values).map(([name, value]) => [prefix + name, value]))
}
