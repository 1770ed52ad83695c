// Moment matching's predictions of a trial, beside the samples (docs/pilco.md).
import { chart, fit, heights, type ChartOptions, type Domain, type Point, type Series } from './chart'
import { MOMENTS, PREDICTED, RULE } from './colours'
import { column, present, type Columns, type Run } from './data'
import { h, type Child } from './dom'
import { largest, least } from './extent'
import { figure } from './figure'
import type { Panel } from './panels'
import { number } from './format'
import type { LegendEntry } from './legend'

/** The distance from the mean of a Gaussian to its 5 and 95 %, in standard deviations: the band of the samples. */
const REACH = 1.645

export function hasMoments(prediction: Columns | null | undefined): boolean {
  return Object.keys(prediction ?? {}).some((name) => name.includes(' moment mean'))
}

/** No points where the prediction is one of samples alone. */
export function momentSeries(name: string, prediction: Columns): Series {
  const mean = column(prediction, `${name} moment mean`)
  const deviation = column(prediction, `${name} moment std`)
  const points = (column(prediction, 'time') ?? []).flatMap((x, i): Point[] => {
    const [y, std] = [mean?.[i], deviation?.[i]]
    if (!present(x) || !present(y) || !present(std)) return []
    const reach = name === 'reward' ? 0 : REACH * std // it is bounded, and no Gaussian
    return [reach > 0 ? { x, y, band: [y - reach, y + reach] } : { x, y }]
  })
  return { label: 'moment matching, mean', colour: MOMENTS, points, dash: '2 3', width: 1.5, outline: true }
}

export function momentLegend(): LegendEntry {
  return { label: 'mean and 5–95 % by moment matching', colour: MOMENTS, dash: '2 3', outline: true }
}

/** A switch for it, on at first. */
export function momentSwitch(changed: (on: boolean) => void): HTMLElement {
  const box = h('input', { type: 'checkbox', checked: true, onchange: () => changed(box.checked) })
  return h('fieldset', { class: 'choice' }, h('label', {}, box, 'Show moment matching'))
}

/** A sentence on the gap in one trial; empty if it has no moments. */
export function gapSentence({ episodes }: Run, trial: number): string {
  const gap = episodes.find((one) => one.trial === trial)?.gap
  if (!gap) return ''
  const parts = [
    present(gap.moment_return) &&
      `moment matching predicts ${number(gap.moment_return)}, the samples ${number(gap.sampled_return)}`,
    present(gap.apart) &&
      `means of states are at most ${number(gap.apart, 2)} of the samples’ standard deviations apart` +
        (gap.state ? ` (${gap.state} at ${number(gap.time_s)} s)` : ''),
  ].filter(Boolean)
  return parts.length > 0 ? ` From the robot’s start ${parts.join('; ')}.` : ''
}

/** A domain from one power of ten to another. */
function decades(values: number[]): Domain {
  if (values.length === 0) return {}
  const low = Math.floor(Math.log10(least(values)))
  const high = Math.max(low + 1, Math.ceil(Math.log10(largest(values))))
  return { domain: [10 ** low, 10 ** high] }
}

/** Charts of the gap to the samples, trial by trial. */
export function gaps({ episodes }: Run): Child {
  const known = episodes.flatMap(({ trial, gap }) => (gap ? [{ trial, ...gap }] : []))
  if (known.length === 0) return null
  const series = (part: 'apart' | 'spread' | 'moment_return' | 'sampled_return', look: Partial<Series>): Series => ({
    label: 'moment matching',
    colour: MOMENTS,
    symbol: 'triangle',
    ...look,
    points: known.flatMap((gap): Point[] => {
      const y = gap[part]
      return present(y) && (part !== 'apart' || y > 0) ? [{ x: gap.trial, y }] : []
    }),
  })
  const samples: Partial<Series> = { label: 'samples', colour: PREDICTED, symbol: 'square', dash: '6 3' }
  const values = (all: Series[]) => all.flatMap(heights)
  const panel = (title: string, y: ChartOptions['y'], all: Series[], equal = false): Panel => ({
    title,
    draw: (width) =>
      chart({
        width,
        height: 190,
        x: { label: 'trial', whole: true },
        y: { ...y, ...(y.log ? decades(values(all)) : fit([...values(all), ...(equal ? [1] : [])], { zero: true })) },
        series: all,
        rule: equal ? 1 : null,
      }),
  })
  return figure({
    name: 'moments-by-trial',
    title: 'Moment matching against samples',
    about:
      'Both predict the same trial with the same model: one with Gaussians in closed form, one with 100 sampled ' +
      'episodes. A mean of the samples is known to a tenth of their standard deviation. The two differ where states are ' +
      'not Gaussian, and where states are measured with noise, which moment matching does not know.',
    legend: [
      { label: 'moment matching', colour: MOMENTS, symbol: 'triangle' },
      ...(known.some((gap) => present(gap.sampled_return))
        ? [{ label: 'samples', colour: PREDICTED, symbol: 'square' as const, dash: '6 3' }]
        : []),
      { label: 'equal', ...RULE },
    ],
    panels: () => [
      panel('Largest difference of means', { label: 'standard deviations of the samples', log: true }, [
        series('apart', {}),
      ]),
      panel('Standard deviations, moments to samples', { label: 'ratio' }, [series('spread', {})], true),
      panel('Predicted return', { label: 'return' }, [series('sampled_return', samples), series('moment_return', {})]),
    ],
    table: () => known,
    minWidth: 260,
    columns: 3,
  }).element
}
