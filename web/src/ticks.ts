// The ticks of axes, and their labels.
import { largest, least } from './extent'
import { number } from './format'

/** Every integer between the least and the largest, or every second, fifth, … */
export function wholeTicks(values: number[], most: number): number[] {
  if (values.length === 0) return []
  const [low, high] = [Math.ceil(least(values)), Math.floor(largest(values))]
  const step = [1, 2, 5, 10, 20, 50, 100, 200, 500].find((size) => (high - low) / size < most) ?? 1000
  const first = step === 1 ? low : Math.ceil(low / step) * step
  return Array.from({ length: Math.floor((high - first) / step) + 1 }, (_, i) => first + i * step)
}

/** At most six powers of ten among these numbers; undefined, which leaves it to Plot, without two. */
export function powersOfTen(values: number[]): number[] | undefined {
  const exponents = values.filter((value) => value > 0).map(Math.log10)
  const low = Math.ceil(least(exponents) - 1e-9)
  const high = Math.floor(largest(exponents) + 1e-9)
  if (exponents.length === 0 || high <= low) return undefined
  const step = Math.ceil((high - low + 1) / 6)
  return Array.from({ length: Math.floor((high - low) / step) + 1 }, (_, i) => 10 ** (low + i * step))
}

/** Powers of ten, or 1, 2, 5, 10, … of these numbers; undefined, which leaves it to Plot, without two. */
export function logTicks(values: number[]): number[] | undefined {
  const powers = powersOfTen(values)
  if (powers) return powers
  const positive = values.filter((value) => value > 0)
  const [low, high] = [least(positive), largest(positive)]
  const first = Math.floor(Math.log10(low))
  const between = [first, first + 1]
    .flatMap((exponent) => ['1', '2', '5'].map((digit) => Number(`${digit}e${exponent}`)))
    .filter((tick) => tick >= low && tick <= high)
  return between.length > 1 ? between : undefined
}

/** A number of a logarithmic axis without the letters of Plot, to which 0.2 is 200m: 0.002 is 2·10⁻³. */
export function plainTick(value: number): string {
  const exponent = exponentOf(value)
  return Math.abs(exponent) <= 2 ? number(value) : withPower(value, exponent)
}

/**
 * The labels of a linear axis whose numbers are so small or large that plain ones would be long: one power of ten, with
 * factors below 100, 5·10⁻¹⁵ and 30·10⁻¹⁵. All others are left to Plot.
 */
export function linearTicks(values: number[]): { tickFormat?: (value: number) => string } {
  const size = largest(values.map(Math.abs).filter(Number.isFinite))
  if (size <= 0 || (size >= 1e-3 && size < 1e6)) return {}
  return { tickFormat: (value) => (value === 0 ? '0' : withPower(value, exponentOf(size) - 1)) }
}

function exponentOf(value: number): number {
  return Math.floor(Math.log10(value) + 1e-9)
}

function withPower(value: number, exponent: number): string {
  const factor = number(Number((value / 10 ** exponent).toPrecision(12)))
  const power = '10' + [...String(exponent)].map((c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(c)])).join('')
  return factor === '1' ? power : `${factor}·${power}`
}
