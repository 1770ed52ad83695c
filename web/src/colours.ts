// Okabe and Ito's colours, which colour-blind readers tell apart; style.css has their values for light and dark.
// A learner has the same colour and symbol in every figure and every report.
import * as Plot from '@observablehq/plot'

export type Symbol = 'circle' | 'square' | 'triangle' | 'diamond2' | 'star' | 'cross' | 'wye'

export interface Look {
  colour: string
  symbol: Symbol
}

const LOOKS: Record<string, Look> = {
  'gp-mi': { colour: 'var(--blue)', symbol: 'circle' },
  mi: { colour: 'var(--green)', symbol: 'square' },
  'black-drops-prior': { colour: 'var(--orange)', symbol: 'triangle' },
  'black-drops': { colour: 'var(--vermillion)', symbol: 'diamond2' },
  'pilco-prior': { colour: 'var(--purple)', symbol: 'star' },
  pilco: { colour: 'var(--sky)', symbol: 'cross' },
  'pi-rem': { colour: 'var(--purple)', symbol: 'diamond2' },
  ite: { colour: 'var(--black)', symbol: 'wye' },
  'gp-ilqg': { colour: 'var(--yellow)', symbol: 'square' },
}

export const REAL = 'var(--vermillion)'
export const PREDICTED = 'var(--blue)'
export const EXPECTED = 'var(--orange)'
export const MOMENTS = 'var(--green)'
/** A dashed line at a number that the others are compared with. */
export const RULE = { colour: 'currentColor', dash: '4 3' }
/** The opacity of intervals' vertical bars. */
export const INTERVAL_OPACITY = 0.55

/** Learners that are not in the list take the looks that are free, in order. */
export function looks(learners: string[]): (learner: string) => Look {
  const free = Object.keys(LOOKS).filter((name) => !learners.includes(name))
  const others = learners.filter((name) => !(name in LOOKS))
  return (learner) => {
    const name = learner in LOOKS ? learner : (free[others.indexOf(learner) % Math.max(free.length, 1)] ?? 'ite')
    return LOOKS[name] as Look
  }
}

/** Variants of a learner differ in how their lines are drawn, more than four of them in their symbols, too. */
const DASHES = ['none', '6 3', '2 3', '8 3 2 3']

const SYMBOLS: Symbol[] = ['circle', 'square', 'triangle', 'diamond2', 'star', 'cross', 'wye']

/** The looks of so many variants of a learner. taken: symbols of all learners, which no variant of another one has. */
export function variantLooks(look: Look, variants: number, taken: Symbol[]): (Look & { dash: string })[] {
  const symbols = [look.symbol, ...SYMBOLS.filter((symbol) => !taken.includes(symbol))]
  // Symbols are told apart more easily than dashes, so that many variants have as few dashes as do.
  const needed = variants <= DASHES.length ? variants : Math.max(2, Math.ceil(variants / symbols.length))
  const dashes = DASHES.slice(0, needed)
  return Array.from({ length: variants }, (_, i) => ({
    ...look,
    symbol: symbols[Math.floor(i / dashes.length) % symbols.length] as Symbol,
    dash: dashes[i % dashes.length] as string,
  }))
}

/** Colours of numbers, from dark and low to bright and high, which grow in lightness: viridis. */
export interface Scale {
  low: number
  high: number
  colour: (value: number) => string
  /** A text colour that is readable on it. */
  inkOn: (value: number) => string
  ramp: string[]
}

const STEPS = 32

export function scaleOf(low: number, high: number): Scale {
  const top = low < high ? high : low + 1
  const part = (value: number) => Math.min(1, Math.max(0, (value - low) / (top - low))) || 0
  const viridis = Plot.scale({ color: { type: 'linear', scheme: 'viridis', domain: [0, 1] } })
  const ramp = Array.from({ length: STEPS }, (_, i) => String(viridis.apply(i / (STEPS - 1))))
  return {
    low,
    high,
    colour: (value) => ramp[Math.round(part(value) * (STEPS - 1))] as string,
    inkOn: (value) => (part(value) > 0.55 ? '#1b1f24' : '#ffffff'),
    ramp,
  }
}
