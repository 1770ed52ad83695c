// The data that `rehearse report` puts into the page. src/rehearse/report writes it; docs/run-folder.md and
// docs/campaigns.md say what the columns and keys mean.

import { largest } from './extent'

export type Cell = number | null
/** Column name → cells. */
export type Columns = Record<string, Cell[]>

export interface Report {
  format: 1
  name: string
  /** Stands over a replay instead of learner and robot. */
  headline?: string
  problems: { where: string; what: string }[]
  run?: Run
  replay?: Run
  campaign?: Campaign
}

export interface Run {
  scenario: string
  learner: string
  prior: string
  seed: number
  planned: number
  done: boolean
  /** The robot's task, in a line; empty or missing if unknown. */
  task?: string
  /** Units of parameters, by name, where they are known. */
  units?: Record<string, string>
  /** Logs were told before the first trial, whose model has learned from them. */
  logs?: boolean
  options: [string, string][]
  /** Tables; those that could not be read are missing. */
  trials?: Columns
  timings?: Columns
  errors?: Columns
  notes?: { trial: number[]; note: string[] }
  /** Identifiability warnings; not there in the folders of older versions. */
  identifiability?: { trial: number[]; warning: string[] }
  /** limits.csv, of a task that has limits. */
  limits?: { names: string[]; numbers: Columns }
  truth?: Record<string, number>
  /** The archive of a learner that has one. */
  archive?: Archive
  /** The evaluations of a policy with other parameters of the robot, if there are any. settings: what else was set. */
  robustness?: Robustness
  episodes: Episode[]
}

/** robustness.csv by parameter. */
export interface Robustness {
  settings: string
  parameters: { parameter: string; columns: Columns }[]
}

/** elites.csv and tried.csv; a value an elite. */
export interface Archive {
  descriptors: { name: string; values: number[] }[]
  /** Returns that the prior predicts. */
  promised: number[]
  /** Returns predicted after the trials. */
  expected: number[]
  /** The space in archive.bin, if that is usable; bins: of a grid. */
  space: { niches: number; bounds: [number, number][]; bins?: number[] } | null
  /** elite counts from 1. */
  tried: Columns | null
}

export interface Episode {
  trial: number
  trajectory: Columns | null
  prediction: Columns | null
  /** Between moment matching and the samples; null where the prediction is one of samples alone. */
  gap: Gap | null
  motion: Motion | null
}

/** The gap between moment matching and samples; unknown numbers are null, or missing. */
export interface Gap {
  /** The largest difference of means in standard deviations of the samples, and where it is. */
  apart?: number
  state?: string
  time_s?: number
  /** Standard deviations of moment matching to those of the samples, on geometric average. */
  spread?: number
  sampled_return: Cell
  moment_return: Cell
}

/** motion/trial-003.json: a frame for every state of the trial. */
export type Motion = LineMotion | SolidMotion

/** A robot as straight bodies in a plane. A frame has both ends (x, y, x, y) of every body. */
export interface LineMotion {
  dimensions?: undefined
  unit: string
  goal: [number, number] | null
  bodies: { name: string; width: number }[]
  frames: Cell[][]
  predicted?: Cell[][] | null
}

/** A robot as rigid bodies in space. A frame has the pose (x, y, z, then the quaternion w, x, y, z) of every body. */
export interface SolidMotion {
  dimensions: 3
  unit: string
  floor: Cell
  /** Feet nearer to the floor touch it; of a robot that has feet. */
  touching?: number
  bodies: Solid[]
  frames: Cell[][]
  predicted?: Cell[][] | null
}

export type Solid = { name: string; foot?: true } & (
  | { shape: 'box'; size: [number, number, number] }
  | { shape: 'sphere'; radius: number }
  | { shape: 'capsule'; radius: number; length: number }
)

export function isSolid(motion: Motion): motion is SolidMotion {
  return motion.dimensions === 3
}

export interface GroupKey {
  learner: string
  prior: string
  variant: string
}

export interface FiveNumbers {
  min: Cell
  quartile_1: Cell
  median: Cell
  quartile_3: Cell
  max: Cell
}

export interface SuccessRate {
  runs: number
  count: number
  rate: Cell
  low: Cell
  high: Cell
}

export interface GroupTrial {
  trial: number
  runs: number
  interaction_s: Cell
  return: FiveNumbers
  best_return: FiveNumbers
  solved: SuccessRate | null
  solved_by: SuccessRate | null
}

export interface Group extends GroupKey {
  runs: number
  done: number
  failed: number
  trials: GroupTrial[]
}

export interface ClaimPart {
  learner: string
  priors: string[]
  variants: string[]
  against: { learner: string; priors: string[]; variants: string[] } | null
  measure: string
  runs: number
  of: number
  count: Cell
  estimate: Cell
  low: Cell
  high: Cell
  required: string
  result: 'pass' | 'fail' | 'undecided'
  reason: string | null
}

export interface CampaignRun extends GroupKey {
  run: string
  seed: number
  state: 'done' | 'failed' | 'unfinished'
  trials: number
  first_success: Cell
  best_return: Cell
  reason: string | null
}

/** Quartiles by trial over the runs of a group. */
export interface Quartiles extends GroupKey {
  trials: { trial: number; runs: number; quartile_1: Cell; median: Cell; quartile_3: Cell }[]
}

export interface Campaign {
  summary: {
    title: string
    scenario: string
    trials: number
    seeds: number[]
    learners: string[]
    priors: string[]
    variants: string[]
    complete: boolean
    counts: { runs: number; done: number; failed: number; unfinished: number }
    missing: { learner: string; reason: string }[]
    runs: CampaignRun[]
    groups: Group[]
    claims: { text: string; result: ClaimPart['result']; parts: ClaimPart[] }[]
  }
  parameters: (Quartiles & { parameter: string; truth: Cell })[]
  times: (Quartiles & { part: 'model_s' | 'search_s' })[]
}

/** A column of a trajectory or a prediction: "theta1 5% [rad]" is theta1, 5%, rad. */
export interface Variable {
  name: string
  unit: string
}

export function parseHeader(header: string): Variable {
  const match = /^(.*?)(?: \[(.*)\])?$/.exec(header)
  return { name: match?.[1] ?? header, unit: match?.[2] ?? '' }
}

/** The column of that name, whatever its unit. */
export function column(columns: Columns | null | undefined, name: string): Cell[] | undefined {
  if (!columns) return undefined
  const header = Object.keys(columns).find((key) => parseHeader(key).name === name)
  return header === undefined ? undefined : columns[header]
}

/** States are what a trajectory also has as true values; what stands behind them are actions, then the reward. */
export function variables(trajectory: Columns): { states: Variable[]; actions: Variable[] } {
  const all = Object.keys(trajectory).map(parseHeader)
  const isState = (v: Variable) => all.some((other) => other.name === `true ${v.name}`)
  const states = all.filter(isState)
  const actions = all.filter(
    (v) => !isState(v) && v.name !== 'time' && v.name !== 'reward' && !states.some((s) => v.name === `true ${s.name}`),
  )
  return { states, actions }
}

export function withUnit(v: Variable): string {
  return v.unit ? `${v.name} (${v.unit})` : v.name
}

export function present(value: Cell | undefined): value is number {
  return value !== null && value !== undefined
}

/** The first steps of a prediction, as long as half of its simulated episodes go on: few that are left look certain. */
export function stepsOf(prediction: Columns): number {
  const going = column(prediction, 'particles') ?? []
  const end = going.findIndex((n) => present(n) && 2 * n < (going[0] ?? 0))
  return end < 0 ? Infinity : end
}

/** The episode with the predicted robot ending where its prediction does. */
export function withEnds(episode: Episode): Episode {
  const { motion, prediction } = episode
  if (!motion?.predicted || !prediction) return episode
  const end = stepsOf(prediction)
  const predicted = motion.predicted.map((frame, i) => (i < end ? frame : frame.map(() => null)))
  return { ...episode, motion: { ...motion, predicted } }
}

/** Position of the largest number, the first of equals; 0 without any. */
export function indexOfMax(cells: Cell[]): number {
  const numbers = cells.map((value) => value ?? -Infinity)
  return Math.max(0, numbers.indexOf(largest(numbers)))
}
