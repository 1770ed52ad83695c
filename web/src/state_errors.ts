// The model's error in each state of a trial, as a fraction of that state's range.
import { column, present, stepsOf, type Episode } from './data'
import { robotCells, type ByState } from './ranges'

/** The root mean square error of the predicted mean over the trial, relative to the range; no states without a prediction. */
export function relativeErrors({ trajectory, prediction }: Episode, ranges: ByState): ByState {
  const errors: ByState = new Map()
  const steps = prediction ? stepsOf(prediction) : 0
  for (const [name, range] of ranges) {
    const mean = (column(prediction, `${name} mean`) ?? []).slice(0, steps)
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
