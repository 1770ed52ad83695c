// A camera that goes round a point, by mouse, finger and keyboard.
import { PerspectiveCamera, Vector3 } from 'three'

const HOME = { azimuth: -1.05, elevation: 0.4, zoom: 1 }
const TURN = Math.PI / 18 // a key press
const STEEPEST = Math.PI / 2 - 0.01
const NEARER = 1.2

export type Move = 'left' | 'right' | 'up' | 'down' | 'nearer' | 'farther' | 'home'

const KEYS: Record<string, Move> = {
  ArrowLeft: 'left',
  ArrowRight: 'right',
  ArrowUp: 'up',
  ArrowDown: 'down',
  '+': 'nearer',
  '=': 'nearer',
  '-': 'farther',
  Home: 'home',
}

export class Orbit {
  readonly camera: PerspectiveCamera
  readonly target = new Vector3()
  private view = { ...HOME }

  /** size: radius of what is to be seen. changed: the camera moved. */
  constructor(
    private readonly element: HTMLElement,
    private readonly size: number,
    private readonly changed: () => void,
  ) {
    this.camera = new PerspectiveCamera(30, 1, size / 20, size * 100)
    this.camera.up.set(0, 0, 1)
    element.addEventListener('pointerdown', (event) => element.setPointerCapture(event.pointerId))
    element.addEventListener('pointermove', (event) => this.drag(event))
    element.addEventListener('keydown', (event) => this.press(event))
    element.addEventListener('wheel', (event) => this.wheel(event), { passive: false })
  }

  /** The distance of the camera from its target. */
  distance(): number {
    const angle = (this.camera.fov / 2) * (Math.PI / 180)
    return (1.1 * this.size) / Math.sin(angle) / Math.min(1, this.camera.aspect) / this.view.zoom
  }

  /** Looks at the target. */
  aim() {
    const { azimuth, elevation } = this.view
    const across = Math.cos(elevation)
    const away = new Vector3(across * Math.cos(azimuth), across * Math.sin(azimuth), Math.sin(elevation))
    this.camera.position.copy(this.target).addScaledVector(away, this.distance())
    this.camera.lookAt(this.target)
  }

  move(way: Move) {
    if (way === 'home') this.view = { ...HOME }
    else if (way === 'nearer') this.zoom(NEARER)
    else if (way === 'farther') this.zoom(1 / NEARER)
    else if (way === 'left') this.turn(-TURN, 0)
    else if (way === 'right') this.turn(TURN, 0)
    else this.turn(0, way === 'up' ? TURN : -TURN)
    this.changed()
  }

  private turn(azimuth: number, elevation: number) {
    this.view.azimuth += azimuth
    this.view.elevation = Math.min(STEEPEST, Math.max(-STEEPEST, this.view.elevation + elevation))
  }

  private zoom(factor: number) {
    this.view.zoom = Math.min(8, Math.max(0.1, this.view.zoom * factor))
  }

  private drag(event: PointerEvent) {
    if (!this.element.hasPointerCapture(event.pointerId)) return
    this.turn(-event.movementX / 150, event.movementY / 150)
    this.changed()
  }

  private press(event: KeyboardEvent) {
    const way = KEYS[event.key]
    if (!way || event.ctrlKey || event.metaKey || event.altKey) return
    event.preventDefault() // else the page scrolls
    this.move(way)
  }

  /** The wheel scrolls the page unless the reader has turned to the picture. */
  private wheel(event: WheelEvent) {
    if (document.activeElement !== this.element) return
    event.preventDefault()
    this.zoom(Math.exp(-event.deltaY / 500))
    this.changed()
  }
}
