// The robot in space, drawn by three.js: the trial, and as a ghost the model's prediction.
import {
  BufferGeometry,
  Color,
  DirectionalLight,
  Fog,
  HemisphereLight,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshStandardMaterial,
  PCFSoftShadowMap,
  PlaneGeometry,
  Scene,
  ShadowMaterial,
  Vector3,
  WebGLRenderer,
} from 'three'
import { PREDICTED, REAL } from './colours'
import { isSolid, present, type SolidMotion } from './data'
import { h } from './dom'
import { Orbit, type Move } from './orbit'
import { Robot, sizeOf } from './solids'
import type { Stage } from './stage'

const SUN = new Vector3(-0.5, -0.8, 2)
const CELLS = 40 // of the grid, along each side

export function stage3d(motions: SolidMotion[]): Stage {
  const canvas = h('canvas', {
    tabindex: 0,
    role: 'application',
    'aria-label': 'The robot at the time of the slider. Arrow keys turn the view, + and − zoom, Home goes back.',
  })
  // Without its buffer the picture is missing on paper.
  const context = canvas.getContext('webgl2', { alpha: true, antialias: true, preserveDrawingBuffer: true })
  if (!context) return withoutWebGl()
  const view = new View(motions, canvas, context)
  return { element: view.element, show: (motion, frame) => isSolid(motion) && view.show(motion, frame) }
}

function withoutWebGl(): Stage {
  const text =
    'The robot moves in space, which this browser cannot draw: WebGL 2 is switched off or missing. ' +
    'The states are shown all the same.'
  return { element: h('p', { class: 'stage' }, text), show: () => {} }
}

class View {
  readonly element: HTMLElement
  private readonly scene = new Scene()
  private readonly renderer: WebGLRenderer
  private readonly orbit: Orbit
  private readonly sun = new DirectionalLight(0xffffff, 2)
  private readonly ground: Ground
  private readonly fog = new Fog(0)
  private readonly look = {
    real: new MeshStandardMaterial({ roughness: 0.7 }),
    predicted: new MeshStandardMaterial({ roughness: 0.7, transparent: true, opacity: 0.35, depthWrite: false }),
    realWay: new LineBasicMaterial({ transparent: true }),
    predictedWay: new LineBasicMaterial({ transparent: true, opacity: 0.5, depthWrite: false }),
  }
  private motion: SolidMotion | null = null
  private robots: { real: Robot; predicted: Robot } | null = null
  private readonly size: number

  constructor(
    motions: SolidMotion[],
    private readonly canvas: HTMLCanvasElement,
    context: WebGL2RenderingContext,
  ) {
    this.size = Math.max(...motions.map(sizeOf))
    this.renderer = new WebGLRenderer({ canvas, context, alpha: true })
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2))
    this.renderer.shadowMap.enabled = true
    this.renderer.shadowMap.type = PCFSoftShadowMap
    this.orbit = new Orbit(canvas, this.size, () => this.render())
    this.ground = new Ground(this.size)
    this.scene.fog = this.fog
    this.scene.add(new HemisphereLight(0xffffff, 0x8f8f8f, 2), this.sun, this.sun.target, ...this.ground.parts())
    this.castShadows()
    const scale = h('span', { class: 'scale' }, `squares of ${this.ground.cell} ${motions[0]?.unit ?? 'm'}`)
    this.element = h('div', { class: 'stage solid' }, canvas, scale, this.buttons())
    new ResizeObserver(() => this.resize()).observe(canvas)
    const paint = () => this.paint()
    new MutationObserver(paint).observe(document.documentElement, { attributeFilter: ['data-theme'] })
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', paint)
  }

  show(motion: SolidMotion, frame: number) {
    if (motion !== this.motion) this.load(motion)
    this.robots?.real.place(frame)
    this.robots?.predicted.place(frame)
    this.orbit.target.copy(this.robots?.real.position() ?? this.orbit.target)
    this.render()
  }

  private load(motion: SolidMotion) {
    this.robots?.real.dispose()
    this.robots?.predicted.dispose()
    this.motion = motion
    this.robots = {
      real: new Robot(motion, motion.frames, this.look.real, this.look.realWay),
      predicted: new Robot(motion, motion.predicted, this.look.predicted, this.look.predictedWay),
    }
    this.robots.real.stepForward()
    this.scene.add(this.robots.real.group, this.robots.predicted.group)
  }

  private castShadows() {
    const { camera, mapSize } = this.sun.shadow
    const reach = 2 * this.size
    Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach, far: 20 * this.size })
    mapSize.set(1024, 1024)
    this.sun.castShadow = true
  }

  private buttons(): HTMLElement {
    const button = (label: string, sign: string, way: Move) =>
      h('button', { type: 'button', 'aria-label': label, onclick: () => this.orbit.move(way) }, sign)
    return h(
      'div',
      { class: 'view', role: 'group', 'aria-label': 'View' },
      button('Nearer', '+', 'nearer'),
      button('Farther', '−', 'farther'),
      button('View as at first', '⟲', 'home'),
    )
  }

  private resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas
    if (width === 0 || height === 0) return
    this.renderer.setSize(width, height, false)
    this.orbit.camera.aspect = width / height
    this.orbit.camera.updateProjectionMatrix()
    this.paint()
  }

  /** Takes the colours of the page, light or dark. */
  private paint() {
    const { real, predicted, realWay, predictedWay } = this.look
    for (const material of [real, realWay]) this.takeColour(REAL, material.color)
    for (const material of [predicted, predictedWay]) this.takeColour(PREDICTED, material.color)
    this.takeColour('var(--muted)', this.ground.colour)
    this.takeColour('var(--surface)', this.fog.color)
    this.render()
  }

  private takeColour(css: string, colour: Color) {
    this.canvas.style.color = css
    colour.set(getComputedStyle(this.canvas).color)
  }

  private render() {
    const { target, camera } = this.orbit
    this.orbit.aim()
    this.fog.near = this.orbit.distance() + 2 * this.size
    this.fog.far = this.fog.near + 6 * this.size
    this.sun.target.position.copy(target)
    this.sun.position.copy(target).addScaledVector(SUN, 4 * this.size)
    this.ground.follow(target, this.motion?.floor ?? null)
    this.renderer.render(this.scene, camera)
  }
}

/** The floor near the robot: lines that stand still in the world, and its shadow. */
class Ground {
  readonly cell: number
  readonly colour: Color
  private readonly grid: LineSegments
  private readonly shade: Mesh

  constructor(size: number) {
    this.cell = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10].find((length) => length > 0.3 * size) ?? 20
    const lines = new LineBasicMaterial({ transparent: true, opacity: 0.35 })
    this.colour = lines.color
    this.grid = new LineSegments(new BufferGeometry().setFromPoints(gridOf(this.cell)), lines)
    const shade = new ShadowMaterial({ opacity: 0.25, depthWrite: false })
    this.shade = new Mesh(new PlaneGeometry(CELLS * this.cell, CELLS * this.cell), shade)
    this.shade.receiveShadow = true
  }

  parts() {
    return [this.grid, this.shade]
  }

  follow({ x, y }: Vector3, floor: number | null) {
    const snap = (value: number) => this.cell * Math.round(value / this.cell)
    for (const part of this.parts()) {
      part.visible = present(floor)
      part.position.set(snap(x), snap(y), floor ?? 0)
    }
  }
}

/** One segment an edge: software renderers drop long lines that pass behind the camera. */
function gridOf(cell: number): Vector3[] {
  const half = CELLS / 2
  const points: Vector3[] = []
  const edge = (...ends: [number, number][]) => points.push(...ends.map(([x, y]) => new Vector3(x * cell, y * cell)))
  for (let i = -half; i <= half; ++i)
    for (let j = -half; j < half; ++j) {
      edge([i, j], [i, j + 1])
      edge([j, i], [j + 1, i])
    }
  return points
}
