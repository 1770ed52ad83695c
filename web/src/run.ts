// The page of one run, and that of one trial of it.
import { archiveFigures } from './archive'
import { chart, fit, heights, type Point, type Series } from './chart'
import { EXPECTED, PREDICTED, REAL } from './colours'
import {
  column,
  indexOfMax,
  parseHeader,
  present,
  withUnit,
  type Cell,
  type Columns,
  type Report,
  type Run,
} from './data'
import { h, type Child } from './dom'
import type { Row } from './export'
import { figure, tableFigure, type Panel } from './figure'
import { count, duration, number } from './format'
import { beside, head, problems, sections, tiles, type Tile } from './layout'
import type { LegendEntry } from './legend'
import { gaps, gapSentence } from './moments'
import { player } from './player'

const TRIAL = { label: 'trial', whole: true }

export function runPage(report: Report, run: Run): Child[] {
  return [
    head(title(run), subtitle(run)),
    problems(report),
    h(
      'main',
      {},
      tiles(keyFigures(run)),
      ...sections([
        { id: 'returns', title: 'Returns', content: [returns(run)] },
        { id: 'replay', title: 'Replay', content: [replay(run)] },
        { id: 'archive', title: 'The archive', content: archiveFigures(run) },
        { id: 'model', title: 'The model', content: [errors(run), gaps(run), beside(parameters(run), evidence(run))] },
        { id: 'computing', title: 'Computing', content: [beside(times(run), rollouts(run)), notes(run)] },
        { id: 'options', title: 'Options', content: [options(run)] },
      ]),
    ),
  ]
}

export function replayPage(report: Report, run: Run): Child[] {
  const trial = run.episodes[0]?.trial ?? 1
  return [
    head(`${title(run)}: trial ${trial}`, subtitle(run)),
    problems(report),
    h('main', { class: 'replay' }, replay(run)),
  ]
}

function title(run: Run): string {
  return `${run.learner} on ${run.scenario}`
}

function subtitle(run: Run): string {
  const done = run.trials?.['trial']?.length ?? run.episodes.length
  const state = run.done ? count(done, 'trial') : `${done} of ${count(run.planned, 'trial')}, not complete`
  return [run.prior ? `prior ${run.prior}` : 'no prior', `seed ${run.seed}`, state].join(' · ')
}

function keyFigures({ trials, timings }: Run): Tile[] {
  if (!trials) return []
  const at = (name: string, i: number) => trials[name]?.[i]
  const all = trials['return'] ?? []
  const solved = (trials['solved'] ?? []).findIndex((value) => value === 1)
  const best = indexOfMax(all)
  const knowsSolved = (trials['solved'] ?? []).some(present)
  const seconds = sum(timings?.['model_s']) + sum(timings?.['search_s'])
  return [
    knowsSolved && {
      label: 'Solved',
      value: solved < 0 ? 'not yet' : `trial ${at('trial', solved)}`,
      ...(solved < 0 ? {} : { note: `after ${number(at('interaction_s', solved))} s on the robot` }),
    },
    all.length > 0 && { label: 'Best return', value: number(all[best]), note: `trial ${at('trial', best)}` },
    {
      label: 'Time on the robot',
      value: `${number(trials['interaction_s']?.at(-1) ?? 0)} s`,
      note: count(all.length, 'trial'),
    },
    timings && { label: 'Time to compute', value: duration(seconds) },
    {
      label: 'Simulated episodes',
      value: number(sum(trials['rollouts'])),
      note: `${number(sum(trials['failed_rollouts']))} failed`,
    },
  ].filter((tile): tile is Tile => Boolean(tile))
}

function returns({ trials }: Run): Child {
  if (!trials?.['return']?.length) return null
  const solved = trials['solved'] ?? []
  const real = pointsOf(trials, 'return').map((p, i) => ({ ...p, hollow: solved[i] !== 1 }))
  const predicted = pointsOf(trials, 'predicted_return')
  const expected = pointsOf(trials, 'expected_return')
  const series: Series[] = [
    { label: 'predicted', colour: PREDICTED, points: predicted, dash: '6 3', symbol: 'square' },
    { label: 'expected', colour: EXPECTED, points: expected, dash: '2 3', symbol: 'triangle' },
    { label: 'robot', colour: REAL, points: real, symbol: 'circle' },
  ]
  const evaluated = expected.length > 0
  const legend: LegendEntry[] = [
    { label: 'on the robot, solved', colour: REAL, symbol: 'circle' },
    { label: 'on the robot, not solved', colour: REAL, symbol: 'circle', hollow: true },
    { label: 'predicted before the trial', colour: PREDICTED, symbol: 'square', dash: '6 3' },
  ]
  if (evaluated) legend.push({ label: 'mean of more episodes', colour: EXPECTED, symbol: 'triangle', dash: '2 3' })
  return figure({
    name: 'returns-by-trial',
    title: 'Return, predicted and real',
    about:
      'Before each trial the model says what return it expects of the policy. ' +
      'The closer the two, the better it knows the robot.',
    legend,
    panels: () => [
      {
        title: '',
        draw: (width) =>
          chart({
            width,
            height: 300,
            x: TRIAL,
            y: { label: 'return', ...fit(series.flatMap(heights), { zero: true }) },
            series,
          }),
      },
    ],
    table: () => {
      const names = ['trial', 'interaction_s', 'return', 'solved', 'predicted_return']
      return rowsOf(trials, evaluated ? [...names, 'expected_return'] : names)
    },
    maxWidth: 1200,
  }).element
}

function replay(run: Run): Child {
  const usable = run.episodes.filter((episode) => episode.trajectory)
  const best = indexOfMax(run.trials?.['return'] ?? []) + 1
  const start = usable.find(({ trial }) => trial === best) ?? usable[0]
  if (!start) return null
  return player(usable, start, (trial) => {
    const value = (name: string) => run.trials?.[name]?.[trial - 1]
    const expected = present(value('predicted_return')) ? `, ${number(value('predicted_return'))} predicted` : ''
    const solved = value('solved')
    const verdict = present(solved) ? (solved === 1 ? ', solved' : ', not solved') : ''
    return `Return ${number(value('return'))}${expected}${verdict}.${gapSentence(run, trial)}`
  })
}

function parameters({ trials, truth = {}, identifiability }: Run): Child {
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
      title: name,
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
      'With these values the model chose each trial’s policy; in trial 1 they are those of the prior as given. ' +
        'Dashed: the robot’s own, where the scenario says them.',
      warningList(identifiability, trials['trial']?.at(-1)),
    ),
    ...(columns.length > names.length ? { legend: INTERVAL_LEGEND } : {}),
    panels: () => names.map(panel),
    table: () => rowsOf(trials, ['trial', ...columns]).map((row) => ({ ...row, ...prefixed('truth.', truth) })),
    minWidth: 220,
    columns: 2,
  }).element
}

const INTERVAL_LEGEND: LegendEntry[] = [
  { label: 'learned', colour: PREDICTED, symbol: 'circle' },
  { label: '95 % interval', colour: PREDICTED, interval: true, line: false },
]

function withIntervals(points: Point[], trials: Columns, column: string): Point[] {
  return points.map((point) => {
    const row = trials['trial']?.indexOf(point.x) ?? -1
    const [low, high] = ['low', 'high'].map((end) => trials[`${column}.${end}`]?.[row])
    if (!present(low) || !present(high)) return point
    const tip = `trial ${point.x}\n${number(point.y)}\n${number(low)} to ${number(high)}`
    return { ...point, interval: [low, high], tip }
  })
}

/** What the data of the last model could not tell. */
function warningList(warnings: Run['identifiability'], trial: Cell | undefined): Child {
  const last = (warnings?.warning ?? []).filter((_, i) => warnings?.trial[i] === trial)
  return last.length > 0 && h('ul', { class: 'warnings' }, ...last.map((warning) => h('li', {}, `${warning}.`)))
}

/** One panel a state, one line a trial. */
function errors({ errors, prior }: Run): Child {
  const trials = [...new Set((errors?.['trial'] ?? []).filter(present))]
  if (!errors || !present(trials[0])) return null
  const panel = (header: string): Panel => ({
    title: withUnit(parseHeader(header.slice(4))),
    draw: (width) =>
      chart({
        width,
        x: { label: 'horizon (steps)', log: true },
        y: { label: 'root mean square error', log: true },
        series: trials.map((trial, i) => errorSeries(errors, header, trial, i / trials.length)),
      }),
  })
  const first = trials[0] === 1 && prior ? 'trial 1: the prior as given' : `trial ${trials[0]}: the first model`
  const others = { label: `trials ${trials[1]} to ${trials.at(-1)}, faint to strong`, colour: PREDICTED }
  return figure({
    name: 'prediction-error',
    title: 'How wrong is the model?',
    about:
      'Error of its mean prediction of each trial over 1, 2, 5, … steps, before it was told of the trial: ' +
      'left one step, right the longest forecast.',
    legend: [{ label: first, colour: REAL }, ...(trials.length > 1 ? [others] : [])],
    panels: () =>
      Object.keys(errors)
        .filter((header) => header.startsWith('rms '))
        .map(panel),
    table: () => rowsOf(errors, Object.keys(errors)),
    minWidth: 260,
  }).element
}

/** age: 0 is the first trial, which stands out. */
function errorSeries(errors: Columns, header: string, trial: number, age: number): Series {
  const points = (errors['horizon'] ?? []).flatMap((x, i): Point[] => {
    const y = errors[header]?.[i]
    return errors['trial']?.[i] === trial && present(x) && present(y) && y > 0 ? [{ x, y }] : []
  })
  const look = age === 0 ? { colour: REAL } : { colour: PREDICTED, opacity: 0.25 + 0.75 * age }
  return { label: `trial ${trial}`, symbol: 'circle', points, ...look }
}

function evidence({ trials }: Run): Child {
  const points = trials ? pointsOf(trials, 'log_evidence') : []
  if (!trials || points.length === 0) return null
  return figure({
    name: 'evidence',
    title: 'Log evidence of the model',
    about: 'Of all data so far, all outputs together; it grows with the data.',
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

function times({ timings }: Run): Child {
  if (!timings?.['trial']?.length) return null
  const series: Series[] = [
    { label: 'search', colour: 'var(--green)', symbol: 'circle', points: pointsOf(timings, 'search_s') },
    { label: 'model', colour: 'var(--purple)', symbol: 'square', points: pointsOf(timings, 'model_s') },
  ]
  return figure({
    name: 'times',
    title: 'Time to compute',
    about: 'Learning the model, and searching a policy on it. Differs from run to run and machine to machine.',
    legend: series,
    panels: () => [
      {
        title: '',
        draw: (width) =>
          chart({ width, x: TRIAL, y: { label: 'seconds', ...fit(series.flatMap(heights), { zero: true }) }, series }),
      },
    ],
    table: () => rowsOf(timings, Object.keys(timings)),
  }).element
}

function rollouts({ trials }: Run): Child {
  if (!trials?.['rollouts']?.length) return null
  const series: Series[] = [
    { label: 'simulated', colour: 'var(--green)', symbol: 'circle', points: pointsOf(trials, 'rollouts') },
    { label: 'failed', colour: REAL, symbol: 'cross', points: pointsOf(trials, 'failed_rollouts') },
  ]
  return figure({
    name: 'rollouts',
    title: 'Simulated episodes',
    about: 'How many the search needed, and how many ended because a simulation failed.',
    legend: series,
    panels: () => [
      {
        title: '',
        draw: (width) =>
          chart({
            width,
            x: TRIAL,
            y: { label: 'episodes', ...fit(series.flatMap(heights), { zero: true }) },
            series,
          }),
      },
    ],
    table: () => rowsOf(trials, ['trial', 'rollouts', 'failed_rollouts']),
  }).element
}

function notes({ notes }: Run): Child {
  if (!notes?.trial.length) return null
  const rows = notes.trial.map((trial, i) => ({ trial, note: notes.note[i] ?? '' }))
  const lines = rows.map(({ trial, note }) => h('tr', {}, h('td', {}, trial), h('td', {}, note)))
  return tableFigure({
    name: 'notes',
    title: 'Numerical failures that were survived',
    columns: ['Trial', 'What happened'],
    lines,
    table: () => rows,
  })
}

function options({ options }: Run): Child {
  if (options.length === 0) return null
  return h(
    'details',
    {},
    h('summary', {}, `All ${options.length} options of this run`),
    h(
      'div',
      { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': 'Options' },
      h(
        'table',
        {},
        h(
          'tbody',
          {},
          ...options.map(([key, text]) =>
            h('tr', {}, h('th', { scope: 'row' }, h('code', {}, key)), h('td', {}, text)),
          ),
        ),
      ),
    ),
  )
}

function pointsOf(columns: Columns, name: string): Point[] {
  return (column(columns, 'trial') ?? []).flatMap((x, i): Point[] => {
    const y = columns[name]?.[i]
    return present(x) && present(y) ? [{ x, y }] : []
  })
}

function rowsOf(columns: Columns, names: string[]): Row[] {
  return (columns['trial'] ?? []).map((_, i) =>
    Object.fromEntries(names.map((name) => [name, columns[name]?.[i] ?? null])),
  )
}

function prefixed(prefix: string, values: Record<string, number>): Row {
  return Object.fromEntries(Object.entries(values).map(([name, value]) => [prefix + name, value]))
}

function sum(cells: Cell[] | undefined): number {
  return (cells ?? []).reduce((so: number, value) => so + (value ?? 0), 0)
}
