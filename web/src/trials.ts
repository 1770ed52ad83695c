// Columns of a table that has one row a trial, as points of a chart and as rows to save.
import type { Point } from './chart'
import { column, indexOfMax, present, type Columns } from './data'
import type { Row } from './export'

/** The axis of trials. */
export const TRIAL = { label: 'trial', whole: true }

export function pointsOf(columns: Columns, name: string): Point[] {
  return (column(columns, 'trial') ?? []).flatMap((x, i): Point[] => {
    const y = columns[name]?.[i]
    return present(x) && present(y) ? [{ x, y }] : []
  })
}

/** The row of the best trial, as the program names it: the first of equals, and none that was cut short unless all were. */
export function bestRow(trials: Columns): number {
  const short = trials['cut_short'] ?? []
  return indexOfMax((trials['return'] ?? []).map((value, i) => (short[i] === 1 ? null : (value ?? null))))
}

export function rowsOf(columns: Columns, names: string[]): Row[] {
  return (columns['trial'] ?? []).map((_, i) =>
    Object.fromEntries(names.map((name) => [name, columns[name]?.[i] ?? null])),
  )
}
