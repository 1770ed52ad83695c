// The outcome of the policy on robots with one parameter changed: robustness.csv.
import { chart, fit, heights, type Point } from './chart'
import { REAL } from './colours'
import { present, type Columns, type Robustness, type Run } from './data'
import type { Child } from './dom'
import { figure } from './figure'
import { count, number, percent } from './format'
import type { Panel } from './panels'

/** The rate at the end of the episodes; where the task cannot say it, the return. */
export function robustness({ robustness }: Run): Child {
  if (!robustness?.parameters.length) return null
  const { settings, parameters } = robustness
  const known = parameters.some(({ columns }) => (columns['solved_at_end'] ?? []).some(present))
  const of = (columns: Columns) => (known ? rates(columns) : returns(columns))
  const domain = known
    ? { domain: [0, 1] as [number, number] }
    : fit(parameters.flatMap(({ columns }) => heights({ points: of(columns) })))
  const factors = fit(parameters.flatMap(({ columns }) => (columns['factor'] ?? []).filter(present)))
  const panel = ({ parameter, columns }: { parameter: string; columns: Columns }): Panel => ({
    title: parameter,
    draw: (width) =>
      chart({
        width,
        height: 200,
        x: { label: 'times the robot’s value', ...factors },
        y: { label: known ? 'solved at the end' : 'return', percent: known, ...domain },
        series: [{ label: parameter, colour: REAL, points: of(columns), symbol: 'circle' }],
      }),
  })
  return figure({
    name: 'robustness-by-parameter',
    title: 'Robustness: one parameter of the robot at a time',
    about:
      (known
        ? 'How often the policy solves the task, at the end of its episodes, with 95 % intervals (Clopper and Pearson 1934).'
        : 'The median return of the policy, and its quartiles.') + whichPolicy(robustness),
    panels: () => parameters.map(panel),
    table: () =>
      parameters.flatMap(({ parameter, columns }) =>
        (columns['factor'] ?? []).map((_, i) => ({
          parameter,
          settings,
          ...Object.fromEntries(Object.entries(columns).map(([name, cells]) => [name, cells[i] ?? null])),
        })),
      ),
    minWidth: 220,
  }).element
}

/** Says it of files that have it: those of older versions do not. */
export function whichPolicy({ settings, parameters }: Robustness): string {
  const [trial, seconds, episodes] = ['trial', 'seconds', 'episodes'].map((name) => parameters[0]?.columns[name]?.[0])
  if (!present(trial)) return ''
  const set = settings ? `, with ${settings}` : ''
  return ` It is the policy of trial ${trial} in ${count(episodes ?? 0, 'episode')} of ${number(seconds)} s for each value${set}.`
}

function rates(columns: Columns): Point[] {
  return pointsBy(columns, 'solved_at_end', 'solved_at_end_low', 'solved_at_end_high', percent)
}

function returns(columns: Columns): Point[] {
  return pointsBy(columns, 'return_50', 'return_25', 'return_75', number)
}

function pointsBy(columns: Columns, name: string, low: string, high: string, text: (value: number) => string): Point[] {
  return (columns['factor'] ?? []).flatMap((x, i) => {
    const at = (column: string) => columns[column]?.[i]
    const [y, least, most] = [at(name), at(low), at(high)]
    if (!present(x) || !present(y)) return []
    const tip = `${number(at('value'))}, ${number(x)} of the robot’s\n${text(y)}`
    return [{ x, y, tip, ...(present(least) && present(most) ? { interval: [least, most] as [number, number] } : {}) }]
  })
}
