// The computing of a run: its time, and its simulated episodes.
import { chart, fit, heights, type Series } from './chart'
import { REAL } from './colours'
import type { Run } from './data'
import type { Child } from './dom'
import { figure } from './figure'
import { pointsOf, rowsOf, TRIAL } from './trials'

export function times({ timings }: Run): Child {
  if (!timings?.['trial']?.length) return null
  const series: Series[] = [
    { label: 'search', colour: 'var(--green)', symbol: 'circle', points: pointsOf(timings, 'search_s') },
    { label: 'model', colour: 'var(--purple)', symbol: 'square', points: pointsOf(timings, 'model_s') },
  ]
  return figure({
    name: 'times',
    title: 'Time to compute',
    about: 'The times to learn the model and to search a policy on it. They differ from run to run.',
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

export function rollouts({ trials }: Run): Child {
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
