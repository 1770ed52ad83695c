// A learner's archive of policies: the returns that it predicts before and after the trials, and which were tried.
import { cellChart, cellsOf, type Axis, type Cell, type Spot } from './cells'
import { scaleOf, type Scale } from './colours'
import { parseHeader, present, withUnit, type Archive, type Run } from './data'
import { h, type Child } from './dom'
import type { Row } from './export'
import { largest, least } from './extent'
import { figure, tableFigure } from './figure'
import { count, number } from './format'
import { choice } from './layout'
import type { LegendEntry } from './legend'
import type { Panel } from './panels'

/** A trial, of an elite counted from 0. */
interface Trial {
  trial: number
  elite: number
  /** The return that the prior predicts. */
  promised: number
  /** Just before the trial. */
  expected: number | null
  observed: number | null
  learned: boolean
}

export function archiveFigures(run: Run): Child[] {
  const { archive } = run
  if (!archive) return []
  const trials = trialsOf(run, archive)
  return [elites(archive, trials), trialTable(trials)]
}

function trialsOf({ trials }: Run, { tried }: Archive): Trial[] {
  return (tried?.['trial'] ?? []).flatMap((trial, i): Trial[] => {
    const elite = (tried?.['elite']?.[i] ?? 0) - 1
    if (!present(trial) || elite < 0) return []
    const row = trials?.['trial']?.indexOf(trial) ?? -1
    return [
      {
        trial,
        elite,
        promised: tried?.['promised']?.[i] ?? NaN,
        expected: trials?.['predicted_return']?.[row] ?? null,
        observed: trials?.['return']?.[row] ?? null,
        learned: tried?.['learned']?.[i] === 1,
      },
    ]
  })
}

function elites(archive: Archive, trials: Trial[]): Child {
  const scale = scaleOfArchive(archive, trials)
  const axes = axesOf(archive)
  let pairs = pairsOf(axes.length, false)
  const drawn = figure({
    name: 'archive-of-elites',
    title: 'The archive before and after the trials',
    about: aboutOf(archive),
    legend: legendOf(scale, trials),
    ...(axes.length > 2
      ? {
          controls: choice('Descriptors', PAIRS, (value) => {
            pairs = pairsOf(axes.length, value === 'all')
            drawn.redraw()
          }),
        }
      : {}),
    panels: () =>
      pairs.flatMap((pair) => halves(archive, trials).map((half) => panelOf(archive, half, pair, axes, trials, scale))),
    table: () => rowsOf(archive, trials),
    minWidth: 230,
    columns: 4,
    together: 2,
  })
  return drawn.element
}

const PAIRS: [string, string][] = [
  ['some', 'two by two'],
  ['all', 'every pair'],
]

/** Returns before the trials, or after them. */
interface Half {
  title: string
  values: number[]
}

function halves({ promised, expected, tried }: Archive, trials: Trial[]): Half[] {
  const learned = tried ? count(trials.filter((trial) => trial.learned).length, 'trial') : 'the trials'
  return [
    { title: 'predicted by the prior', values: promised },
    { title: `predicted after ${learned}`, values: expected },
  ]
}

function panelOf(
  { descriptors }: Archive,
  { title, values }: Half,
  [a, b]: Pair,
  axes: Axis[],
  trials: Trial[],
  scale: Scale,
): Panel {
  const [x, y] = [axes[a] as Axis, b === null ? null : (axes[b] as Axis)]
  const [xs, ys] = [a, b].map((d) => descriptors[d ?? -1]?.values ?? []) as [number[], number[]]
  const tip = ({ best, count: n }: Cell) => `predicted ${number(best)}\n${n === 1 ? '1 elite' : `the best of ${n}`}`
  return {
    title,
    label: `${title} by ${[x, y].flatMap((axis) => axis?.label ?? []).join(' and ')}`,
    draw: (width) =>
      cellChart({ width, x, y, cells: cellsOf(x, y, xs, ys, values), spots: spotsOf(trials, xs, ys), scale, tip }),
  }
}

function legendOf(scale: Scale, trials: Trial[]): LegendEntry[] {
  const [low, high] = [scale.low, scale.high].map((value) => number(value, 3))
  const disc = { colour: 'var(--ink)', symbol: 'circle' as const, hollow: true, line: false }
  const ramp = { label: `return, ${low} or less to ${high}`, colour: '', ramp: scale.ramp }
  return trials.length > 0 ? [ramp, { label: 'a trial, in the colour of its return', ...disc }] : [ramp]
}

function aboutOf({ promised, space }: Archive): Child {
  const niches = space
    ? `${count(promised.length, 'elite')} in ${count(space.niches, 'niche')}`
    : count(promised.length, 'elite')
  return (
    `${niches}, each the best policy of its kind on the prior. A cell has the colour of the best predicted return in ` +
    'it, by the prior or after the trials. A trial stands where the archive has its policy, with a second ring if that ' +
    'was tried again.'
  )
}

/** A scale whose lowest colour is the lowest return that the prior predicts, and any below it. */
function scaleOfArchive({ promised, expected }: Archive, trials: Trial[]): Scale {
  const observed = trials.flatMap((trial) => (trial.observed === null ? [] : [trial.observed]))
  return scaleOf(least(promised), largest([promised, expected, observed].map(largest)))
}

/** The axes of the descriptors. Cells are those of a grid; else the fewer elites, the larger the cells. */
function axesOf({ descriptors, promised, space }: Archive): Axis[] {
  const cells = Math.min(36, Math.max(8, Math.round(0.8 * Math.sqrt(promised.length))))
  return descriptors.map(({ name, values }, d) => ({
    label: withUnit(parseHeader(name)),
    domain: space?.bounds[d] ?? extent(values),
    cells: Math.min(space?.bins?.[d] ?? cells, 100),
  }))
}

function extent(values: number[]): [number, number] {
  const [low, high] = [least(values), largest(values)]
  return low < high ? [low, high] : [low - 1, high + 1]
}

/** Numbers of descriptors; of one alone, without another. */
type Pair = [number, number | null]

/** Two by two, the last with the one before it if it is left alone; or every one with every other. */
function pairsOf(descriptors: number, all: boolean): Pair[] {
  if (descriptors === 1) return [[0, null]]
  const numbers = Array.from({ length: descriptors }, (_, d) => d)
  if (all) return numbers.flatMap((a) => numbers.slice(a + 1).map((b): Pair => [a, b]))
  return numbers.filter((d) => d % 2 === 0).map((d): Pair => (d + 1 < descriptors ? [d, d + 1] : [d - 1, d]))
}

/** One an elite, the first trial on top. */
function spotsOf(trials: Trial[], xs: number[], ys: number[]): Spot[] {
  const elites = [...new Set(trials.map(({ elite }) => elite))].reverse()
  return elites.map((elite) => {
    const of = trials.filter((trial) => trial.elite === elite)
    return {
      x: xs[elite] ?? 0,
      y: ys[elite] ?? 0,
      label: String(of[0]?.trial),
      value: of[0]?.observed ?? NaN,
      again: of.length > 1,
      tip: of.slice(0, 4).map(tipOf).join('\n') + (of.length > 4 ? `\nand ${of.length - 4} more` : ''),
    }
  })
}

function tipOf({ trial, promised, expected, observed }: Trial): string {
  const predicted = `${number(promised)} predicted by the prior, ${number(expected)} before the trial`
  return `trial ${trial}: ${predicted}, ${number(observed)} on the robot`
}

function rowsOf({ descriptors, promised, expected }: Archive, trials: Trial[]): Row[] {
  const tried = new Map<number, number[]>()
  for (const { elite, trial } of trials) tried.set(elite, [...(tried.get(elite) ?? []), trial])
  return promised.map((value, e) => ({
    ...Object.fromEntries(descriptors.map(({ name, values }) => [name, values[e] ?? null])),
    promised: value,
    expected: expected[e] ?? null,
    trials: tried.get(e)?.join(' '),
  }))
}

function trialTable(trials: Trial[]): Child {
  if (trials.length === 0) return null
  const cell = (value: number | null) => h('td', { class: 'number' }, number(value))
  return tableFigure({
    name: 'archive-trials',
    title: 'Which policies of the archive were tried',
    about: 'The return of each, as the prior predicted it, as predicted just before the trial, and on the robot.',
    columns: ['Trial', 'Elite', 'Predicted by the prior', 'Predicted before the trial', 'On the robot', 'Note'],
    lines: trials.map(({ trial, elite, promised, expected, observed, learned }) =>
      h(
        'tr',
        {},
        h('th', { scope: 'row' }, trial),
        cell(elite + 1),
        cell(promised),
        cell(expected),
        cell(observed),
        h('td', {}, learned ? '' : 'repeats the best'),
      ),
    ),
    table: () =>
      trials.map(({ trial, elite, promised, expected, observed, learned }) => ({
        trial,
        elite: elite + 1,
        promised,
        predicted_return: expected,
        return: observed,
        learned: learned ? 1 : 0,
      })),
  })
}
