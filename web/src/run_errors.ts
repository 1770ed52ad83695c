// The errors of a run's model, by the length of its predictions.
import { chart, type Point, type Series } from './chart'
import { PREDICTED, REAL } from './colours'
import { parseHeader, present, withUnit, type Columns, type Run, type Variable } from './data'
import type { Child } from './dom'
import { figure } from './figure'
import { number } from './format'
import type { LegendEntry } from './legend'
import { partFolds, partsOfRobot, type StatePanel } from './part_folds'
import { rangesOf, type ByState } from './ranges'
import { relative } from './state_errors'
import { rowsOf } from './trials'

const RMS = 'rms '
const SOME_FAILED: LegendEntry = {
  label: 'some predictions failed',
  colour: PREDICTED,
  symbol: 'circle',
  hollow: true,
  line: false,
}
/** Fewer comparisons may be right or wrong by chance. */
const ENOUGH = 5
const BY_PARTS =
  'States stand by body part, the worst first: by the error of the longest prediction of the last trial that was ' +
  `compared ${ENOUGH} times or more, relative to the range in which the state moved in all trials.`

/** One panel a state, one line a trial. */
export function errors(run: Run): Child {
  const { errors, episodes } = run
  const trials = [...new Set((errors?.['trial'] ?? []).filter(present))]
  if (!errors || !present(trials[0])) return null
  const last = trials.at(-1) ?? trials[0]
  const headers = Object.keys(errors).filter((header) => header.startsWith(RMS))
  const panel = (header: string): StatePanel => ({
    of: stateOf(header).name,
    title: withUnit(stateOf(header)),
    draw: (width) =>
      chart({
        width,
        x: { label: 'horizon (steps)', log: true },
        y: { label: 'root mean square error', log: true },
        series: trials.map((trial, i) => errorSeries(errors, header, trial, i / trials.length)),
      }),
  })
  const others = { label: laterModels(trials[1] ?? last, last), colour: PREDICTED }
  const parts = partsOfRobot(episodes)
  const someFailed = (errors['failed'] ?? []).some((n) => present(n) && n > 0)
  const folds = () => {
    const ofLast = longestErrors(errors, headers, last, rangesOf(episodes))
    return partFolds(parts, headers.map(panel), ofLast)
  }
  return figure({
    name: 'prediction-error',
    title: 'How wrong is the model?',
    about:
      'The error of its mean prediction of each trial over 1, 2, 5, … steps, before it learned from the trial. ' +
      'One step is on the left, the longest prediction on the right. The actions that were taken are taken again, whatever ' +
      'is predicted: the errors of an unstable robot grow fast, though its policy would correct them.' +
      (parts.length > 0 ? ` ${BY_PARTS}` : ''),
    legend: [
      { label: firstModel(run, trials[0]), colour: REAL },
      ...(trials.length > 1 ? [others] : []),
      ...(someFailed ? [SOME_FAILED] : []),
    ],
    panels: () => headers.map(panel),
    ...(parts.length > 0 ? { folds } : {}),
    table: () => rowsOf(errors, Object.keys(errors)),
    minWidth: 260,
  }).element
}

/** A label of the trials after the first one with errors. */
export function laterModels(from: number, to: number): string {
  return from === to ? `trial ${from}` : `trials ${from} to ${to}, faint to strong`
}

/** A label of the first trial with errors: the model that chose its policy. */
export function firstModel({ logs, prior }: Pick<Run, 'logs' | 'prior'>, trial: number): string {
  if (trial !== 1 || !(logs || prior)) return `trial ${trial}: the first model`
  return `trial 1: ${logs ? 'the model from the logs' : 'the prior as given'}`
}

/** age: 0 is the first trial, which stands out. Points of which some predictions failed are hollow. */
export function errorSeries(errors: Columns, header: string, trial: number, age: number): Series {
  const points = (errors['horizon'] ?? []).flatMap((x, i): Point[] => {
    const y = errors[header]?.[i]
    if (errors['trial']?.[i] !== trial || !present(x) || !present(y) || y <= 0) return []
    const [compared, failed] = [errors['compared']?.[i], errors['failed']?.[i]]
    if (!present(compared) || !present(failed)) return [{ x, y }]
    return [{ x, y, hollow: failed > 0, note: `${number(compared)} compared, ${number(failed)} failed` }]
  })
  const look = age === 0 ? { colour: REAL } : { colour: PREDICTED, opacity: 0.25 + 0.75 * age }
  return { label: `trial ${trial}`, symbol: 'circle', points, ...look }
}

function stateOf(header: string): Variable {
  return parseHeader(header.slice(RMS.length))
}

/** Errors, relative to the range, of the longest predictions that were compared often enough, else the shortest. */
export function longestErrors(errors: Columns, headers: string[], trial: number, ranges: ByState): ByState {
  const rows = (errors['trial'] ?? []).flatMap((value, i) => (value === trial ? [i] : []))
  const enough = (i: number) => (errors['compared']?.[i] ?? ENOUGH) >= ENOUGH
  return new Map(
    headers.flatMap((header): [string, number][] => {
      const known = rows.filter((i) => present(errors[header]?.[i]))
      const error = errors[header]?.[known.filter(enough).at(-1) ?? known[0] ?? -1]
      const { name } = stateOf(header)
      const range = ranges.get(name)
      return present(error) && present(range) ? [[name, relative(error, range)]] : []
    }),
  )
}
