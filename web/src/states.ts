// States, action and reward of a trial, each with its prediction.
import { chart, fit, heights, type Domain, type Point, type Series } from './chart'
import { PREDICTED, REAL } from './colours'
import {
  column,
  present,
  stepsOf,
  variables,
  withUnit,
  type Cell,
  type Columns,
  type Episode,
  type Variable,
} from './data'
import type { Row } from './export'
import { number } from './format'
import type { LegendEntry } from './legend'
import { momentSeries } from './moments'
import type { StatePanel } from './part_folds'
import { robotCells } from './ranges'

export const ROBOT: LegendEntry = { label: 'the robot', colour: REAL }
export const MEAN: LegendEntry = { label: 'the model’s predicted mean', colour: PREDICTED, dash: '6 3' }

const MEASURED = { symbol: 'circle', radius: 1.5, opacity: 0.5, line: false } as const

export function stateLegend({ trajectory, prediction }: Episode): LegendEntry[] {
  const entries: LegendEntry[] = [ROBOT]
  if (trajectory && isNoisy(trajectory))
    entries.push({ label: 'as measured', colour: REAL, symbol: 'circle', line: false })
  if (prediction)
    entries.push(MEAN, {
      label: `5–95 % and 25–75 % of ${column(prediction, 'particles')?.[0] ?? 'the'} simulated episodes`,
      colour: PREDICTED,
      band: 0.3,
      line: false,
    })
  return entries
}

/** True if measured states differ from the true ones. */
function isNoisy(trajectory: Columns): boolean {
  return variables(trajectory).states.some(({ name }) => {
    const truth = column(trajectory, `true ${name}`)
    return column(trajectory, name)?.some((value, i) => value !== truth?.[i])
  })
}

/** domains: of the actions. */
export function statePanels(
  { trajectory, prediction }: Episode,
  domains: Map<string, Domain>,
  moments: boolean,
): StatePanel[] {
  if (!trajectory) return []
  const times = column(trajectory, 'time') ?? []
  const { states, actions } = variables(trajectory)
  const panel = (variable: Variable, series: Series[], domain = domainOf(series)): StatePanel => ({
    of: variable.name,
    title: withUnit(variable),
    draw: (width) =>
      chart({
        width,
        height: 190,
        x: { label: 'time (s)', domain: [0, times.filter(present).at(-1) ?? 1] },
        y: { label: '', ...domain },
        series,
        cursor: true,
      }),
  })
  const recorded = (name: string) => line('robot', REAL, times, column(trajectory, name))
  // A prediction is drawn last, and dashed: where it is right, both lines are seen.
  const predicted = (name: string) => (prediction ? predictions(name, prediction, moments) : [])
  return [
    ...states.map((state) => panel(state, [...stateSeries(state, times, trajectory), ...predicted(state.name)])),
    ...actions.map((action) => panel(action, [held(recorded(action.name), times)], domains.get(action.name))),
    panel({ name: 'reward', unit: '' }, [recorded('reward'), ...predicted('reward')]),
  ]
}

/** The least width of a panel's domain, relative to its largest number: less is rounding. */
const LEAST_SPAN = 1e-3

/** The domain of all that is drawn; a prediction that runs away is cut, so that what happened stays readable. */
function domainOf(series: Series[]): Domain {
  const domain = (some: Series[]) => fit(some.flatMap(heights), { span: LEAST_SPAN }).domain
  const real = domain(series.filter(({ colour }) => colour === REAL))
  const all = domain(series)
  if (!real || !all) return {}
  const room = 2 * (real[1] - real[0])
  return { domain: [Math.max(all[0], real[0] - room), Math.min(all[1], real[1] + room)] }
}

function stateSeries({ name }: Variable, times: Cell[], trajectory: Columns): Series[] {
  const measured = column(trajectory, name) ?? []
  const all: Series[] = []
  if (isNoisy(trajectory)) all.push({ ...line('measured', REAL, times, measured), ...MEASURED })
  all.push(line('robot', REAL, times, robotCells(name, trajectory)))
  return all
}

function predictions(name: string, prediction: Columns, moments: boolean): Series[] {
  return [predictedSeries(name, prediction), ...(moments ? [momentSeries(name, prediction)] : [])].filter(
    ({ points }) => points.length > 0,
  )
}

/** The simulated episodes, while at least half of them go on. Rewards are of all, also of those that have ended. */
export function predictedSeries(name: string, prediction: Columns): Series {
  const at = (part: string) => column(prediction, `${name} ${part}`) ?? []
  const [mean, low, lower, upper, high] = ['mean', '5%', '25%', '75%', '95%'].map(at)
  const pair = (a: Cell | undefined, b: Cell | undefined): [number, number] | undefined =>
    present(a) && present(b) ? [a, b] : undefined
  const [going, steps] =
    name === 'reward' ? [[], Infinity] : [column(prediction, 'particles') ?? [], stepsOf(prediction)]
  const points = (column(prediction, 'time') ?? []).slice(0, steps).flatMap((x, i): Point[] => {
    const y = mean?.[i]
    if (!present(x) || !present(y)) return []
    const band = pair(low?.[i], high?.[i])
    const core = pair(lower?.[i], upper?.[i])
    return [{ x, y, ...(band ? { band } : {}), ...(core ? { core } : {}), ...left(going, i) }]
  })
  return { label: 'model, mean', colour: PREDICTED, points, dash: '6 3', width: 1.5 }
}

/** A note of how many simulated episodes go on, unless all do. */
function left(going: Cell[], step: number): { note?: string } {
  const [all, now] = [going[0], going[step]]
  return present(all) && present(now) && now < all
    ? { note: `${number(now)} of ${number(all)} simulated episodes go on` }
    : {}
}

function line(label: string, colour: string, times: Cell[], values: Cell[] | undefined): Series {
  const points = times.flatMap((x, i): Point[] => {
    const y = values?.[i]
    return present(x) && present(y) ? [{ x, y }] : []
  })
  return { label, colour, points }
}

/** Each value until the next, the last one until the end: the last state of a trajectory has no action. */
export function held(series: Series, times: Cell[]): Series {
  const [last, end] = [series.points.at(-1), times.filter(present).at(-1)]
  const more = last && present(end) && end > last.x ? [{ x: end, y: last.y }] : []
  return { ...series, points: [...series.points, ...more], held: true }
}

/** The trajectory, and the prediction beside it. */
export function stateTable({ trajectory, prediction }: Episode): Row[] {
  const times = column(trajectory, 'time') ?? []
  const columns = [
    ...Object.entries(trajectory ?? {}),
    ...Object.entries(prediction ?? {}).flatMap(([name, cells]): [string, Cell[]][] =>
      name.startsWith('time') ? [] : [[`predicted ${name}`, cells]],
    ),
  ]
  return times.map((_, i) => Object.fromEntries(columns.map(([name, cells]) => [name, cells[i] ?? null])))
}
