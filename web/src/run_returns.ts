// Returns of a run, trial by trial: predicted by the model, and earned on the robot.
import { chart, fit, heights, type Point, type Series } from './chart'
import { EXPECTED, PREDICTED, REAL } from './colours'
import { present, type Columns, type Run } from './data'
import type { Child } from './dom'
import { figure } from './figure'
import type { LegendEntry } from './legend'
import { pointsOf, rowsOf, TRIAL } from './trials'

export function returns({ trials }: Run): Child {
  if (!trials?.['return']?.length) return null
  const real = onTheRobot(trials)
  const predicted = pointsOf(trials, 'predicted_return')
  const expected = pointsOf(trials, 'expected_return')
  const series: Series[] = [
    { label: 'predicted', colour: PREDICTED, points: predicted, dash: '6 3', symbol: 'square' },
    { label: 'expected', colour: EXPECTED, points: expected, dash: '2 3', symbol: 'triangle' },
    { label: 'robot', colour: REAL, points: real.points, symbol: 'circle' },
  ]
  const evaluated = expected.length > 0
  const legend: LegendEntry[] = [...real.legend]
  if (predicted.length > 0)
    legend.push({ label: 'predicted before the trial', colour: PREDICTED, symbol: 'square', dash: '6 3' })
  if (evaluated) legend.push({ label: 'mean of more episodes', colour: EXPECTED, symbol: 'triangle', dash: '2 3' })
  return figure({
    name: 'returns-by-trial',
    title: 'Return, predicted and real',
    about:
      'The model predicts the return of each trial’s policy. ' +
      'The closer the two, the better the model knows the robot.',
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

/** The points of the returns, and what they mean: hollow are trials that did not solve a task that can say so. */
export function onTheRobot(trials: Columns): { points: Point[]; legend: LegendEntry[] } {
  const solved = trials['solved'] ?? []
  const points = pointsOf(trials, 'return')
  const look = { colour: REAL, symbol: 'circle' as const }
  if (!solved.some(present)) return { points, legend: [{ label: 'on the robot', ...look }] }
  const marked = points.map((p, i) => ({ ...p, hollow: solved[i] !== 1 }))
  const entries: LegendEntry[] = [
    { label: 'on the robot, solved', ...look },
    { label: 'on the robot, not solved', ...look, hollow: true },
  ]
  const drawn = (hollow: boolean) => marked.some((point) => point.hollow === hollow)
  return { points: marked, legend: entries.filter(({ hollow = false }) => drawn(hollow)) }
}
