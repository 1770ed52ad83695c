// The parameters that a campaign's learners identified, a panel for each prior and parameter.
import { besideEachOther, inFront, quartileRows } from './campaign_figures'
import { chart, fit, heights, type Point, type Series } from './chart'
import { agree, choiceAxis, isChoiceOfRuns } from './choices'
import { present, type Campaign, type GroupKey } from './data'
import { h, type Child } from './dom'
import { largest } from './extent'
import { figure } from './figure'
import { legendOf, medianPoints, panelTitle, type StyleOf } from './groups'
import type { Panel } from './panels'
import { TRUTH } from './run_model'
import { TRIAL } from './trials'

type OfGroup = Campaign['parameters'][0]

export function parameters({ parameters }: Campaign, style: StyleOf): Child {
  if (parameters.length === 0) return null
  const keeping = thatKeepThePrior(parameters)
  const drawn = parameters.filter((one) => !keeping.includes(keyOf(one)) && medianPoints(one).length > 0)
  if (drawn.length === 0)
    return keeping.length > 0 ? h('p', { class: 'about' }, 'All learners kept the prior’s values in all trials.') : null
  const names = [...new Set(drawn.map(({ parameter }) => parameter))]
  const priors = [...new Set(drawn.map(({ prior }) => prior))]
  const choices = names.filter((name) => isChoiceOfRuns(drawn.filter(({ parameter }) => parameter === name)))
  const known = drawn.some(({ truth }) => present(truth))
  const about = [
    'Median and quartiles of the values with which the model chose each trial’s policy.',
    known ? 'The robot’s own value is dashed where it is that of all runs.' : '',
    choices.length > 0
      ? `${choices.join(' and ')} is one of a few values: a hollow median is that of runs that differ.`
      : '',
    keeping.length > 0 ? keptSentence(parameters, keeping) : '',
  ]
  const panels = (prior: string) => names.flatMap((name) => panelOf(drawn, name, prior, style, choices.includes(name)))
  return figure({
    name: 'parameters-by-trial',
    title: 'Identified parameters against the truth',
    about: about.filter(Boolean).join(' '),
    legend: [...legendOf(drawn, style, choices.length < names.length ? { band: 0.16 } : {}), ...(known ? [TRUTH] : [])],
    panels: () => priors.flatMap(panels),
    table: () => parameters.flatMap((one) => quartileRows(one, { parameter: one.parameter, truth: one.truth })),
    minWidth: 220,
    columns: names.length,
  }).element
}

function panelOf(drawn: OfGroup[], name: string, prior: string, style: StyleOf, choice: boolean): Panel[] {
  const all = drawn.filter((one) => one.parameter === name)
  const shown = all.filter((one) => one.prior === prior)
  if (shown.length === 0) return []
  const truths = [...new Set(shown.map((one) => one.truth))]
  const rule = truths.length === 1 ? (truths[0] ?? null) : null
  const values = [
    ...all.flatMap((one) => heights({ points: medianPoints(one) })),
    ...all.map((one) => one.truth).filter(present),
  ]
  const y = { label: '', ...(choice ? choiceAxis(values) : fit(values, { span: 0.2 })) }
  const last = largest(all.flatMap(({ trials }) => trials.map(({ trial }) => trial)))
  const x = choice ? { ...TRIAL, domain: [0.5, last + 0.5] as [number, number] } : TRIAL
  const series = shown.map((one, i): Series => {
    if (!choice) return { ...style(one), points: medianPoints(one) }
    return { ...style(one), points: choicePoints(one, besideEachOther(i, shown.length)), held: true }
  })
  return [
    {
      title: `${name}, ${panelTitle(prior)}`,
      draw: (width) => chart({ width, height: 190, x, y, series: inFront(series), rule }),
    },
  ]
}

/** Nothing lies between two choices: a line is steps, and a band a bar where runs differ. */
function choicePoints(one: OfGroup, shift: number): Point[] {
  return medianPoints(one).map(({ band, ...point }) => {
    const trial = one.trials.find(({ trial }) => trial === point.x)
    const same = trial ? agree(trial) : true
    return { ...point, x: point.x + shift, hollow: !same, ...(band && !same ? { interval: band } : {}) }
  })
}

function keyOf({ learner, prior, variant }: GroupKey): string {
  return JSON.stringify([learner, prior, variant])
}

/** Groups that learned nothing of parameters: their lines would look like parameters that are hard to find. */
export function thatKeepThePrior(parameters: OfGroup[]): string[] {
  const constant = ({ trials }: OfGroup) => {
    const rows = trials.filter(({ median }) => present(median))
    return rows.length > 1 && rows.every((row) => agree(row) && row.median === rows[0]?.median)
  }
  const keys = [...new Set(parameters.map(keyOf))]
  return keys.filter((key) => parameters.filter((one) => keyOf(one) === key).every(constant))
}

/** A learner is named alone where none of its groups learned anything. */
function keptSentence(parameters: OfGroup[], keeping: string[]): string {
  const kept = parameters.filter((one) => keeping.includes(keyOf(one)))
  const whole = (learner: string) => parameters.every((one) => one.learner !== learner || keeping.includes(keyOf(one)))
  const texts = kept.map(({ learner, prior, variant }) =>
    whole(learner) ? learner : `${learner} (${[prior, variant].filter(Boolean).join(', ')})`,
  )
  return `Learners that kept the prior’s values in all trials are not drawn: ${[...new Set(texts)].join(', ')}.`
}
