// The bodies of a motion in space, as meshes.
import {
  BoxGeometry,
  BufferGeometry,
  CapsuleGeometry,
  Group,
  Line,
  Mesh,
  Quaternion,
  SphereGeometry,
  Vector3,
  type Material,
} from 'three'
import { present, type Cell, type Solid, type SolidMotion } from './data'

type Frames = Cell[][] | null | undefined
export const NUMBERS = 7 // of a pose: x y z, w x y z

/** The robot in one colour, and the way its first body has come. */
export class Robot {
  readonly group = new Group()
  private readonly meshes: Mesh[]
  private readonly way: Line

  constructor(
    motion: SolidMotion,
    private readonly frames: Frames,
    material: Material,
    wayMaterial: Material,
  ) {
    this.meshes = motion.bodies.map((body) => new Mesh(geometryOf(body), material))
    this.way = new Line(new BufferGeometry().setFromPoints(wayOf(frames, heightOfWay(motion))), wayMaterial)
    this.group.add(...this.meshes, this.way)
  }

  /** Puts it where it is at a frame, which may lie between two; it is not seen where a number is missing. */
  place(frame: number) {
    const part = frame - Math.floor(frame)
    const before = poses(this.frames, Math.floor(frame), this.meshes.length)
    const after = part > 0 ? poses(this.frames, Math.floor(frame) + 1, this.meshes.length) : before
    this.group.visible = before !== null && after !== null
    if (!before || !after) return
    this.meshes.forEach((mesh, i) => {
      mesh.position.lerpVectors(positionOf(before, i), positionOf(after, i), part)
      mesh.quaternion.slerpQuaternions(orientationOf(before, i), orientationOf(after, i), part)
    })
    this.way.geometry.setDrawRange(0, Math.floor(frame) + 1)
  }

  /** The position of its first body; null if unknown. */
  position(): Vector3 | null {
    return this.group.visible ? (this.meshes[0]?.position ?? null) : null
  }

  /** It casts a shadow, and its way is drawn over that of a ghost. */
  stepForward() {
    for (const mesh of this.meshes) mesh.castShadow = true
    this.way.renderOrder = 1
  }

  dispose() {
    this.group.removeFromParent()
    for (const { geometry } of [...this.meshes, this.way]) geometry.dispose()
  }
}

/** Radius around the first body in which all are, as they start. */
export function sizeOf({ bodies, frames }: SolidMotion): number {
  const start = poses(frames, 0, bodies.length)
  if (!start) return 1
  const middle = positionOf(start, 0)
  return Math.max(0.01, ...bodies.map((body, i) => positionOf(start, i).distanceTo(middle) + radiusOf(body)))
}

function geometryOf(body: Solid): BufferGeometry {
  if (body.shape === 'box') return new BoxGeometry(...body.size)
  if (body.shape === 'sphere') return new SphereGeometry(body.radius, 24, 16)
  return new CapsuleGeometry(body.radius, body.length, 8, 20).rotateX(Math.PI / 2) // three.js has it along y
}

function radiusOf(body: Solid): number {
  if (body.shape === 'box') return Math.hypot(...body.size) / 2
  return body.shape === 'sphere' ? body.radius : body.radius + body.length / 2
}

function poses(frames: Frames, at: number, bodies: number): number[] | null {
  const frame = frames?.[Math.min(at, frames.length - 1)] ?? []
  return frame.length === NUMBERS * bodies && frame.every(present) ? (frame as number[]) : null
}

function positionOf(frame: number[], body: number): Vector3 {
  return new Vector3().fromArray(frame, NUMBERS * body)
}

function orientationOf(frame: number[], body: number): Quaternion {
  const [w, x, y, z] = frame.slice(NUMBERS * body + 3)
  return new Quaternion(x, y, z, w).normalize()
}

/** Just above the floor, so that its lines do not hide the way; null, that of the body, where there is no floor. */
function heightOfWay(motion: SolidMotion): Cell {
  return present(motion.floor) ? motion.floor + 0.01 * sizeOf(motion) : null
}

/** Up to the first position that is not known. */
function wayOf(frames: Frames, height: Cell): Vector3[] {
  const points: Vector3[] = []
  for (const [x, y, z] of frames ?? []) {
    if (!present(x) || !present(y) || !present(z)) break
    points.push(new Vector3(x, y, height ?? z))
  }
  return points
}
