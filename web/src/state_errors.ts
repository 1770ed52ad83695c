// The model's error in each state of a trial, as a fraction of that state's range.
import { column, present, variables, type Cell, type Columns, type Episode } from './data'

export type ByState = Map<string, number>

/** The values that are drawn as the robot: the truth where the plant knows it, else what was measured. */
export function robotCells(name: string, trajectory: Columns): Cell[] {
  const truth = column(trajectory, `true ${name}`) ?? []
  return truth.some(present) ? truth : (column(trajectory, name) ?? [])
}

/**
 * From the least to the largest value of each state on the robot, over all trials; at least a tenth of the widest range of
 * its unit, so that a state that stands still is not wrong by many times its range.
 */
export function rangesOf(episodes: Episode[]): ByState {
  const trajectories = episodes.flatMap(({ trajectory }) => (trajectory ? [trajectory] : []))
  const states = trajectories[0] ? variables(trajectories[0]).states : []
  const own = states.map(({ name, unit }) => {
    const cells = trajectories.flatMap((one) => robotCells(name, one)).filter(present)
    return {
      name,
      unit,
      range: cells.reduce((a, b) => Math.max(a, b), -Infinity) - cells.reduce((a, b) => Math.min(a, b), Infinity),
    }
  })
  const widest = (unit: string) => Math.max(...own.filter((other) => other.unit === unit).map(({ range }) => range))
  return new Map(own.map(({ name, unit, range }) => [name, Math.max(range, 0.1 * widest(unit))]))
}

/** The root mean square error of the predicted mean over the trial, relative to the range; no states without a prediction. */
export function relativeErrors({ trajectory, prediction }: Episode, ranges: ByState): ByState {
  const errors: ByState = new Map()
  for (const [name, range] of ranges) {
    const mean = column(prediction, `${name} mean`) ?? []
    const squares = (trajectory ? robotCells(name, trajectory) : []).flatMap((value, t) => {
      const predicted = mean[t]
      return present(value) && present(predicted) ? [(value - predicted) ** 2] : []
    })
    if (squares.length === 0) continue
    errors.set(name, relative(Math.sqrt(squares.reduce((a, b) => a + b) / squares.length), range))
  }
  return errors
}

/** At most 1: what is wrong by its whole range or more is as wrong as can be. 0 where nothing moved or was to move. */
export function relative(error: number, range: number): number {
  return error === 0 ? 0 : Math.min(1, error / range)
}
