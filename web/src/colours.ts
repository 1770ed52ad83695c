// Okabe and Ito's colours, which colour-blind readers tell apart; style.css has their values for light and dark.
// A learner has the same colour and symbol in every figure and every report.

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
  ite: { colour: 'var(--black)', symbol: 'wye' },
}

export const REAL = 'var(--vermillion)'
export const PREDICTED = 'var(--blue)'
export const EXPECTED = 'var(--orange)'
export const MOMENTS = 'var(--green)'
/** Of the vertical bars of intervals. */
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

/** Variants of a learner differ in how their lines are drawn. */
export const DASHES = ['none', '6 3', '2 3', '8 3 2 3']
