// The model of a run: its parameters and its evidence.
import { chart, fit, heights, type Point } from './chart'
import { choiceAxis, isChoice } from './choices'
import { PREDICTED, RULE } from './colours'
import { present, withUnit, type Cell, type Columns, type Run } from './data'
import { h, type Child } from './dom'
import type { Row } from './export'
import { figure } from './figure'
import type { Panel } from './panels'
import { number } from './format'
import type { LegendEntry } from './legend'
import { pointsOf, rowsOf, TRIAL } from './trials'

export function parameters(run: Run): Child {
  const { trials, truth = {}, identifiability } = run
  const columns = parameterColumns(trials)
  const names = columns.filter((name) => !isEnd(name, columns))
  if (!trials || names.length === 0 || !trials['trial']?.length || keepsPrior(run)) return null
  const intervals = hasIntervals(trials, names)
  const known = names.some((column) => present(truth[nameOf(column)]))
  return figure({
    name: 'parameters-by-trial',
    title: 'Parameters of the prior',
    about: h(
      'div',
      {},
      `The model chose each trial’s policy with these values. ${firstValues(run)}`,
      warningList(identifiability, trials['trial']?.at(-1)),
    ),
    legend: intervals || known ? [LEARNED, ...(intervals ? [INTERVAL] : []), ...(known ? [TRUTH] : [])] : [],
    panels: () => names.map((column) => parameterPanel(run, trials, column)),
    table: () => rowsOf(trials, ['trial', ...columns]).map((row) => ({ ...row, ...prefixed('truth.', truth) })),
    minWidth: 220,
    columns: 2,
  }).element
}

function parameterPanel({ truth = {}, units = {} }: Run, trials: Columns, column: string): Panel {
  const name = nameOf(column)
  const known = truth[name]
  const points = withIntervals(pointsOf(trials, column), trials, column)
  const ends = ['low', 'high'].flatMap((end) => trials[`${column}.${end}`] ?? [])
  const choice = isChoice(trials[column] ?? [], ends, known)
  const series = [{ label: name, colour: PREDICTED, points, symbol: 'circle' as const, held: choice }]
  const values = [...heights({ points }), ...(present(known) ? [known] : [])]
  const y = { label: '', ...(choice ? choiceAxis(values) : fit(values, { span: 0.2 })) }
  return {
    title: withUnit({ name, unit: units[name] ?? '' }),
    draw: (width) => chart({ width, height: 190, x: TRIAL, y, series, rule: known ?? null }),
  }
}

function parameterColumns(trials: Columns | undefined): string[] {
  return Object.keys(trials ?? {}).filter((name) => name.startsWith('phi.'))
}

function isEnd(name: string, columns: string[]): boolean {
  return /\.(low|high)$/.test(name) && columns.includes(name.replace(/\.[a-z]+$/, ''))
}

function nameOf(column: string): string {
  return column.slice('phi.'.length)
}

/** True of a run that learned nothing of them: its lines would look like parameters that are hard to find. */
export function keepsPrior({ trials, logs }: Pick<Run, 'trials' | 'logs'>): boolean {
  const columns = parameterColumns(trials)
  const names = columns.filter((name) => !isEnd(name, columns))
  if (logs || !trials || names.length === 0 || hasIntervals(trials, names)) return false
  const constant = (cells: Cell[]) => cells.length > 1 && cells.every((value) => value === cells[0])
  return names.every((name) => constant((trials[name] ?? []).filter(present)))
}

/** The sentence in place of the figure, where the prior's values were kept. */
export function keptParameters(run: Run): Child {
  if (!keepsPrior(run)) return null
  const { trials, truth = {}, units = {} } = run
  const columns = parameterColumns(trials)
  const texts = columns.flatMap((column): string[] => {
    const [name, value] = [nameOf(column), trials?.[column]?.find(present)]
    if (isEnd(column, columns) || !present(value)) return []
    const [known, unit] = [truth[name], units[name] ? ` ${units[name]}` : '']
    const other = present(known) && known !== value ? ` (the robot’s is ${number(known)}${unit})` : ''
    return [`${name} ${number(value)}${unit}${other}`]
  })
  return h('p', { class: 'about' }, `All trials had the prior’s own parameters: ${texts.join(', ')}.`)
}

export function firstValues({ logs }: Pick<Run, 'logs'>): string {
  return logs ? 'Trial 1 has those of the model from the logs.' : 'Trial 1 has those of the prior as given.'
}

const LEARNED: LegendEntry = { label: 'learned', colour: PREDICTED, symbol: 'circle' }
const INTERVAL: LegendEntry = { label: '95 % interval', colour: PREDICTED, interval: true, line: false }
export const TRUTH: LegendEntry = { label: 'the robot’s own value', ...RULE }

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
