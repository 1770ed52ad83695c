// The ticks of axes, and their labels.
import { largest, least } from './extent'
import { grouped, withPower } from './format'

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

const DIGITS = 12

/** A number of an axis that is neither small nor large, with all its digits but those that a sum like 0.1 + 0.2 adds. */
export function tick(value: number): string {
  return grouped(Number(value.toPrecision(DIGITS)))
}

/** A number of a logarithmic axis: 0.002 is 2·10⁻³, 1000 is 10³. */
export function logTick(value: number): string {
  const plain = value >= 0.01 * (1 - 1e-9) && value < 1000 * (1 - 1e-9)
  return plain ? tick(value) : withPower(value, DIGITS)
}

/** The labels of a linear axis to these numbers; all have powers of ten where plain ones would be long. */
export function linearTick(values: number[]): (value: number) => string {
  const size = sizeOf(values)
  if (size <= 0 || (size >= 1e-3 && size < 1e6)) return tick
  return (value) => (value === 0 ? '0' : withPower(value, DIGITS))
}

/** The room for the labels of a linear axis to these numbers, in px. */
export function tickRoom(values: number[]): number {
  const size = sizeOf(values)
  return size >= 1e4 || (size > 0 && size < 1e-3) ? 72 : 56
}

function sizeOf(values: number[]): number {
  return largest(values.map(Math.abs).filter(Number.isFinite))
}
