// Parameters that are one of a few whole numbers, such as the number of a missing leg. The data do not name them: what
// tells them is that all their values are whole, and that no interval was ever learned.
import { present, type Cell, type Quartiles } from './data'
import { largest, least } from './extent'

/** values: of a run's trials. others: ends of intervals. truth: the robot's own value, if known. */
export function isChoice(values: Cell[], others: Cell[], truth?: Cell): boolean {
  return !others.some(present) && [...values, truth ?? null].filter(present).every(Number.isInteger)
}

/**
 * The same for quartiles over runs. Those of whole numbers may lie between two, at fourths, unless they agree. A number
 * that is the same everywhere is more likely a prior's that was right.
 */
export function isChoiceOfRuns(groups: (Quartiles & { truth: Cell })[]): boolean {
  const rows = groups.flatMap(({ trials }) => trials).filter(({ median }) => present(median))
  const numbers = rows.flatMap(({ quartile_1, median, quartile_3 }) => [quartile_1, median, quartile_3]).filter(present)
  const whole = (row: (typeof rows)[0]) => !agree(row) || Number.isInteger(row.median)
  return (
    new Set(numbers).size > 1 &&
    rows.every(whole) &&
    numbers.every((value) => Number.isInteger(4 * value)) &&
    groups.every(({ truth }) => !present(truth) || Number.isInteger(truth))
  )
}

/** True where at least half of the runs have the same value. */
export function agree({ quartile_1, median, quartile_3 }: Quartiles['trials'][0]): boolean {
  return quartile_1 === median && median === quartile_3
}

/** The axis of choices. */
export function choiceAxis(values: number[]): { whole: boolean; domain: [number, number] } {
  return { whole: true, domain: [least(values) - 0.5, largest(values) + 0.5] }
}
