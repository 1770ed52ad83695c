// One trial: the robot moving, and every state with what the model had expected, under one time slider.
import { chart, extent, moveCursor, type Point, type Series } from './chart'
import { PREDICTED, REAL } from './colours'
import { column, present, variables, withUnit, type Cell, type Columns, type Episode, type Variable } from './data'
import { h } from './dom'
import type { Row } from './export'
import { figure, type Panel } from './figure'
import { number } from './format'
import type { LegendEntry } from './legend'
import { stage } from './stage'

const SPEEDS = [0.25, 0.5, 1, 2]

const MEASURED = { symbol: 'circle', radius: 1.5, opacity: 0.5, line: false } as const

/** describe: what is said of a trial ("Return 21.9, solved."). */
export function player(episodes: Episode[], start: Episode, describe: (trial: number) => string): HTMLElement {
  let episode = start
  let time = 0
  let playing = false
  let speed = 1

  const times = () => (column(episode.trajectory, 'time') ?? []).filter(present)
  const end = () => times().at(-1) ?? 0
  const step = () => times()[1] ?? 1

  const motions = episodes.flatMap((one) => (one.motion ? [one.motion] : []))
  const picture = motions.length > 0 ? stage(motions) : null
  const states = figure({
    name: 'trajectory',
    title: 'States, action and reward of the trial',
    about: 'Where the line leaves the band, the model was wrong about the robot.',
    legend: legendOf(start),
    panels: () => panelsOf(episode),
    table: () => tableOf(episode),
    minWidth: 280,
    columns: 3,
    afterDrawing: () => show(),
  })

  const slider = h('input', { type: 'range', min: 0, value: 0, step: 1, 'aria-label': 'Time', oninput: () => seek(Number(slider.value) * step()) })
  const clock = h('output', { class: 'clock' })
  const play = h('button', { type: 'button', class: 'play', onclick: () => toggle() })
  const rate = h(
    'select',
    { 'aria-label': 'Speed', onchange: () => (speed = Number(rate.value)) },
    ...SPEEDS.map((value) => h('option', { value, selected: value === 1 }, `${value}×`)),
  )
  const choice = h(
    'select',
    { 'aria-label': 'Trial', onchange: () => choose(Number(choice.value)) },
    ...episodes.map(({ trial }, i) => h('option', { value: i }, `Trial ${trial}`)),
  )
  const by = (way: number) => () => choose(Math.min(episodes.length - 1, Math.max(0, Number(choice.value) + way)))
  const about = h('p', { class: 'about', 'aria-live': 'polite' })

  function show() {
    const frame = time / step()
    slider.value = String(Math.round(frame))
    slider.setAttribute('aria-valuetext', `${number(time, 3)} s`)
    clock.value = `${time.toFixed(2)} / ${end().toFixed(2)} s`
    for (const { svg } of states.drawn()) moveCursor(svg, time)
    if (picture && episode.motion) picture.show(episode.motion, frame)
  }
  function seek(to: number) {
    time = Math.min(end(), Math.max(0, to))
    show()
  }
  function choose(index: number) {
    episode = episodes[index] ?? episode
    choice.value = String(index)
    slider.max = String(Math.max(0, times().length - 1))
    about.textContent = describe(episode.trial)
    states.redraw()
    picture?.element.classList.toggle('empty', !episode.motion)
    seek(time)
  }
  function toggle(on = !playing) {
    playing = on
    play.textContent = playing ? '❚❚' : '▶'
    play.setAttribute('aria-label', playing ? 'Pause' : 'Play')
    if (!playing) return
    if (time >= end()) time = 0
    let last = performance.now()
    const tick = (now: number) => {
      if (!playing) return
      seek(time + (speed * (now - last)) / 1000)
      last = now
      if (time >= end()) toggle(false)
      else requestAnimationFrame(tick)
    }
    requestAnimationFrame(tick)
  }

  choose(episodes.indexOf(start))
  toggle(false)
  return h(
    'div',
    { class: 'player' },
    h(
      'div',
      { class: 'controls', role: 'group', 'aria-label': 'Replay' },
      episodes.length > 1
        ? h(
            'div',
            { class: 'choice' },
            h('button', { type: 'button', onclick: by(-1), 'aria-label': 'Trial before' }, '‹'),
            choice,
            h('button', { type: 'button', onclick: by(1), 'aria-label': 'Next trial' }, '›'),
          )
        : null,
      play,
      slider,
      clock,
      rate,
    ),
    about,
    picture ? h('div', { class: 'stage-frame' }, picture.element) : null,
    states.element,
  )
}

function legendOf({ trajectory, prediction }: Episode): LegendEntry[] {
  const entries: LegendEntry[] = [{ label: 'the robot', colour: REAL }]
  if (trajectory && isNoisy(trajectory)) entries.push({ label: 'as measured', colour: REAL, symbol: 'circle', line: false })
  if (prediction)
    entries.push(
      { label: 'the model’s mean before the trial', colour: PREDICTED, dash: '6 3' },
      { label: '5–95 % and 25–75 % of 100 imagined episodes', colour: PREDICTED, band: 0.3, line: false },
    )
  return entries
}

/** Whether what was measured is not what was true. */
function isNoisy(trajectory: Columns): boolean {
  return variables(trajectory).states.some(({ name }) => {
    const truth = column(trajectory, `true ${name}`)
    return column(trajectory, name)?.some((value, i) => value !== truth?.[i])
  })
}

function panelsOf({ trajectory, prediction }: Episode): Panel[] {
  if (!trajectory) return []
  const times = column(trajectory, 'time') ?? []
  const { states, actions } = variables(trajectory)
  const panel = (variable: Variable, series: Series[]): Panel => ({
    title: withUnit(variable),
    draw: (width) =>
      chart({
        width,
        height: 190,
        x: { label: 'time (s)', domain: [0, times.filter(present).at(-1) ?? 1] },
        y: { label: '', ...domainOf(series) },
        series,
        cursor: true,
      }),
  })
  const recorded = (variable: Variable, held: boolean) =>
    panel(variable, [{ ...line('real', REAL, times, column(trajectory, variable.name)), held }])
  return [
    ...states.map((state) => panel(state, stateSeries(state, times, trajectory, prediction))),
    ...actions.map((action) => recorded(action, true)),
    recorded({ name: 'reward', unit: '' }, false),
  ]
}

/** Of what is drawn; but a prediction that runs away is cut, so that what happened stays readable. */
function domainOf(series: Series[]): { domain?: [number, number] } {
  const real = extent(series.flatMap((one) => (one.colour === REAL ? one.points.map((p) => p.y) : [])))
  const all = extent(series.flatMap(({ points }) => points.flatMap((p) => [p.y, ...(p.band ?? [])])))
  if (!real || !all) return {}
  const room = 2 * (real[1] - real[0])
  return { domain: [Math.max(all[0], real[0] - room), Math.min(all[1], real[1] + room)] }
}

function stateSeries({ name }: Variable, times: Cell[], trajectory: Columns, prediction: Episode['prediction']): Series[] {
  const truth = column(trajectory, `true ${name}`) ?? []
  const measured = column(trajectory, name) ?? []
  const all: Series[] = []
  if (prediction) all.push(predictedSeries(name, prediction))
  if (isNoisy(trajectory)) all.push({ ...line('measured', REAL, times, measured), ...MEASURED })
  all.push(line('real', REAL, times, truth.some(present) ? truth : measured))
  return all
}

function predictedSeries(name: string, prediction: Columns): Series {
  const at = (part: string) => column(prediction, `${name} ${part}`) ?? []
  const [mean, low, lower, upper, high] = ['mean', '5%', '25%', '75%', '95%'].map(at)
  const pair = (a: Cell | undefined, b: Cell | undefined): [number, number] | undefined => (present(a) && present(b) ? [a, b] : undefined)
  const points = (column(prediction, 'time') ?? []).flatMap((x, i): Point[] => {
    const y = mean?.[i]
    if (!present(x) || !present(y)) return []
    const band = pair(low?.[i], high?.[i])
    const core = pair(lower?.[i], upper?.[i])
    return [{ x, y, ...(band ? { band } : {}), ...(core ? { core } : {}) }]
  })
  return { label: 'predicted mean', colour: PREDICTED, points, dash: '6 3', width: 1.5 }
}

function line(label: string, colour: string, times: Cell[], values: Cell[] | undefined): Series {
  const points = times.flatMap((x, i): Point[] => {
    const y = values?.[i]
    return present(x) && present(y) ? [{ x, y }] : []
  })
  return { label, colour, points }
}

/** The trajectory, and the prediction beside it. */
function tableOf({ trajectory, prediction }: Episode): Row[] {
  const times = column(trajectory, 'time') ?? []
  const columns = [
    ...Object.entries(trajectory ?? {}),
    ...Object.entries(prediction ?? {}).flatMap(([name, cells]): [string, Cell[]][] =>
      name.startsWith('time') ? [] : [[`predicted ${name}`, cells]],
    ),
  ]
  return times.map((_, i) => Object.fromEntries(columns.map(([name, cells]) => [name, cells[i] ?? null])))
}
