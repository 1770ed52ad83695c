// The ranges of a robot's states and actions in all trials.
import { fit, type Domain } from './chart'
import { column, present, variables, type Cell, type Columns, type Episode } from './data'
import { largest, least } from './extent'

export type ByState = Map<string, number>

/** The values that are drawn as the robot: the truth where the plant knows it, else what was measured. */
export function robotCells(name: string, trajectory: Columns): Cell[] {
  const truth = column(trajectory, `true ${name}`) ?? []
  return truth.some(present) ? truth : (column(trajectory, name) ?? [])
}

/** The part of the widest range of its unit that every range is at least. */
const LEAST = 0.1

interface Extent {
  name: string
  low: number
  high: number
  /** From low to high, or more. */
  range: number
}

/** The least and the largest values in all trials; a range is at least a tenth of the widest of its unit. */
function extents(
  which: 'states' | 'actions',
  cellsOf: (name: string, of: Columns) => Cell[],
  all: Episode[],
): Extent[] {
  const trajectories = all.flatMap(({ trajectory }) => (trajectory ? [trajectory] : []))
  const own = (trajectories[0] ? variables(trajectories[0])[which] : []).map(({ name, unit }) => {
    const cells = trajectories.flatMap((one) => cellsOf(name, one)).filter(present)
    return { name, unit, low: least(cells), high: largest(cells) }
  })
  const widest = (unit: string) => largest(own.filter((one) => one.unit === unit).map(({ low, high }) => high - low))
  return own.map((one) => ({ ...one, range: Math.max(one.high - one.low, LEAST * widest(one.unit)) }))
}

/**
 * From the least to the largest value of each state on the robot, over all trials; at least a tenth of the widest range
 * of its unit, so that a state that stands still is not wrong by many times its range.
 */
export function rangesOf(episodes: Episode[]): ByState {
  return new Map(extents('states', robotCells, episodes).map(({ name, range }) => [name, range]))
}

/** The domain of each action, the same in all trials, and so wide that an action that hardly moves looks so. */
export function actionDomains(episodes: Episode[]): Map<string, Domain> {
  const cells = (name: string, trajectory: Columns) => column(trajectory, name) ?? []
  return new Map(
    extents('actions', cells, episodes).map(({ name, low, high, range }) => {
      const middle = (low + high) / 2
      return [name, fit([middle - range / 2, middle + range / 2], { span: 0.2 })]
    }),
  )
}
