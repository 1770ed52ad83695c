// One trial: the robot moving, and every state with its prediction, under one time slider.
import { moveCursor } from './chart'
import { column, isSolid, present, stepsOf, withEnds, type Episode, type Motion } from './data'
import { h } from './dom'
import { figure, type Figure } from './figure'
import { number } from './format'
import { hasMoments, momentLegend, momentSwitch } from './moments'
import { partFolds, partsOfRobot } from './part_folds'
import { actionDomains, rangesOf } from './ranges'
import { stage, type Stage } from './stage'
import { stage3d } from './stage3d'
import { relativeErrors } from './state_errors'
import { MEAN, ROBOT, stateLegend, statePanels, stateTable } from './states'
import { walkPanels, walkTable, walks } from './walk'

const WRONG = 'Where the line leaves the band, the model was wrong about the robot.'
const ENDS = ' A prediction ends where fewer than half of its simulated episodes go on.'
const BY_PARTS =
  ' States stand by body part, those first that the model got most wrong in this trial. The error of a state is the root ' +
  'mean square over the trial, relative to the range in which the state moved in all trials.'
/** A page that takes longer to draw goes on from where it was seen last. */
const LONGEST_STEP_S = 0.1
const SPEEDS = [0.25, 0.5, 1, 2]

/** describe: what is said of a trial ("Return 21.9, solved."). */
export function player(episodes: Episode[], start: Episode, describe: (trial: number) => string): HTMLElement {
  const ended = episodes.map(withEnds)
  return new Player(ended, ended[episodes.indexOf(start)] ?? start, describe).element
}

class Player {
  readonly element: HTMLElement
  private episode: Episode
  private time = 0
  private playing = false
  private moments: boolean

  private readonly picture: Stage | null
  private readonly walk: Figure | null
  private readonly states: Figure
  private readonly slider = h('input', { type: 'range', min: 0, value: 0, step: 1, 'aria-label': 'Time' })
  private readonly clock = h('output', { class: 'clock' })
  private readonly play = h('button', { type: 'button', class: 'play', onclick: () => this.toggle(!this.playing) })
  /** The controls say it on a screen. */
  private readonly printed = h('p', { class: 'printed' })
  private readonly about = h('p', { class: 'about', 'aria-live': 'polite' })
  private readonly trials: HTMLSelectElement
  private readonly speed = h(
    'select',
    { 'aria-label': 'Speed' },
    ...SPEEDS.map((value) => h('option', { value, selected: value === 1 }, `${value}×`)),
  )

  constructor(
    private readonly episodes: Episode[],
    start: Episode,
    private readonly describe: (trial: number) => string,
  ) {
    this.episode = start
    this.moments = episodes.some(({ prediction }) => hasMoments(prediction))
    const motions = episodes.flatMap((one) => (one.motion ? [one.motion] : []))
    this.picture = motions.length > 0 ? pictureOf(motions) : null
    this.walk = motions.some(walks) ? this.walkFigure() : null
    this.states = this.stateFigure()
    this.trials = h(
      'select',
      { 'aria-label': 'Trial', onchange: () => this.choose(Number(this.trials.value)) },
      ...episodes.map(({ trial }, i) => h('option', { value: i }, `Trial ${trial}`)),
    )
    this.slider.addEventListener('input', () => this.seek(Number(this.slider.value) * this.step()))
    this.element = h(
      'div',
      { class: 'player' },
      this.controls(),
      this.printed,
      this.about,
      this.picture ? h('div', { class: 'stage-frame' }, this.picture.element) : null,
      h('div', { class: 'figures' }, this.walk?.element ?? null, this.states.element),
    )
    this.choose(episodes.indexOf(start))
    this.toggle(false)
  }

  private walkFigure(): Figure {
    return figure({
      name: 'walk',
      title: 'The walk of the trial',
      about: 'When each foot is on the floor, and the way of the trunk, seen from above.',
      legend: this.episodes.some(({ motion }) => motion?.predicted) ? [ROBOT, MEAN] : [ROBOT],
      panels: () => walkPanels(this.episode, this.step()),
      table: () => walkTable(this.episode, this.step()),
      minWidth: 320,
      columns: 2,
      afterDrawing: () => this.show(),
    })
  }

  private stateFigure(): Figure {
    const parts = partsOfRobot(this.episodes)
    const ranges = rangesOf(this.episodes)
    const domains = actionDomains(this.episodes)
    const predictions = this.episodes.flatMap(({ prediction }) => (prediction ? [prediction] : []))
    const panels = () => statePanels(this.episode, domains, this.moments)
    const about = [
      predictions.length > 0 ? WRONG : '',
      predictions.some((one) => stepsOf(one) < Infinity) ? ENDS : '',
      parts.length > 0 ? BY_PARTS : '',
    ]
    return figure({
      name: 'trajectory',
      title: 'States, action and reward of the trial',
      about: about.join(''),
      legend: [
        ...stateLegend(this.episodes.find(({ prediction }) => prediction) ?? this.episode),
        ...(this.moments ? [momentLegend()] : []),
      ],
      ...(this.moments ? { controls: momentSwitch((on) => this.showMoments(on)) } : {}),
      panels,
      ...(parts.length > 0 ? { folds: () => partFolds(parts, panels(), relativeErrors(this.episode, ranges)) } : {}),
      table: () => stateTable(this.episode),
      minWidth: 280,
      columns: 3,
      afterDrawing: () => this.show(),
    })
  }

  private showMoments(on: boolean) {
    this.moments = on
    this.states.redraw()
  }

  private controls(): HTMLElement {
    const last = this.episodes.length - 1
    const by = (label: string, sign: string, way: number) => {
      const onclick = () => this.choose(Math.min(last, Math.max(0, Number(this.trials.value) + way)))
      return h('button', { type: 'button', 'aria-label': label, onclick }, sign)
    }
    return h(
      'div',
      { class: 'controls', role: 'group', 'aria-label': 'Replay' },
      last > 0
        ? h('div', { class: 'choice' }, by('Trial before', '‹', -1), this.trials, by('Next trial', '›', 1))
        : null,
      this.play,
      this.slider,
      this.clock,
      this.speed,
    )
  }

  private times(): number[] {
    return (column(this.episode.trajectory, 'time') ?? []).filter(present)
  }
  private end(): number {
    return this.times().at(-1) ?? 0
  }
  private step(): number {
    return this.times()[1] ?? 1
  }

  private show() {
    const frame = this.time / this.step()
    this.slider.value = String(Math.round(frame))
    this.slider.setAttribute('aria-valuetext', `${number(this.time, 3)} s`)
    this.clock.value = `${this.time.toFixed(2)} / ${this.end().toFixed(2)} s`
    this.printed.textContent = `Trial ${this.episode.trial} at ${this.time.toFixed(2)} s`
    for (const { svg } of [...(this.walk?.drawn() ?? []), ...this.states.drawn()]) moveCursor(svg, this.time)
    if (this.episode.motion) this.picture?.show(this.episode.motion, frame)
  }

  private seek(time: number) {
    this.time = Math.min(this.end(), Math.max(0, time))
    this.show()
  }

  private choose(index: number) {
    this.episode = this.episodes[index] ?? this.episode
    this.trials.value = String(index)
    this.slider.max = String(Math.max(0, this.times().length - 1))
    this.about.textContent = this.describe(this.episode.trial)
    this.picture?.element.classList.toggle('empty', !this.episode.motion)
    this.walk?.redraw()
    this.states.redraw()
    this.seek(this.time)
  }

  private toggle(playing: boolean) {
    this.playing = playing
    this.play.textContent = playing ? '❚❚' : '▶'
    this.play.setAttribute('aria-label', playing ? 'Pause' : 'Play')
    if (!playing) return
    if (this.time >= this.end()) this.time = 0
    requestAnimationFrame((now) => this.tick(now))
  }

  private tick(before: number) {
    requestAnimationFrame((now) => {
      if (!this.playing) return
      const passed = Math.min((now - before) / 1000, LONGEST_STEP_S)
      this.seek(this.time + Number(this.speed.value) * passed)
      if (this.time >= this.end()) this.toggle(false)
      else this.tick(now)
    })
  }
}

/** The robots of a run are all drawn in one way. */
function pictureOf(motions: Motion[]): Stage {
  const solid = motions.filter(isSolid)
  return solid.length > 0 ? stage3d(solid) : stage(motions.filter((motion) => !isSolid(motion)))
}
