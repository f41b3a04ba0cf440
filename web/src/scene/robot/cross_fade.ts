import { type Material, type Mesh, Vector2 } from 'three'

/** The level of detail that is shown, and how far it has dissolved into the other. */
export class CrossFade {
  /** Of the far level, 0 to 1; the near level has the rest. */
  share = 0
  private far = false
  private began = Number.NEGATIVE_INFINITY
  private length = 0
  private settled = false

  /** border: distance from which the far level is shown, m; it stays until `hysteresis`, a part of
   * the border, nearer. duration: time of a dissolve, s, read at each change; 0: at once. */
  constructor(
    private readonly border: number,
    private readonly hysteresis: number,
    private readonly duration: () => number,
  ) {}

  /** Return whether both levels are shown at a time, s, to an eye at a distance, m. */
  step(distance: number, now: number): boolean {
    const far = distance >= this.border * (this.far ? 1 - this.hysteresis : 1)
    if (far !== this.far) {
      const left = 1 - this.progress(now)
      this.far = far
      this.length = this.settled ? this.duration() : 0
      // one that turns back goes on from where it is
      this.began = now - left * this.length
    }
    this.settled = true
    const progress = this.progress(now)
    this.share = far ? progress : 1 - progress
    return progress < 1
  }

  /** End a dissolve at once. */
  end(): void {
    this.length = 0
    this.share = this.far ? 1 : 0
  }

  private progress(now: number): number {
    if (this.length <= 0) return 1
    return Math.min(Math.max((now - this.began) / this.length, 0), 1)
  }
}

const DECLARED = /* glsl */ `
uniform vec2 dissolve;
// Jimenez, Next Generation Post Processing in Call of Duty: Advanced Warfare, 2014
float dissolveNoise() {
  return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}
`
const APPLIED = /* glsl */ `
float dissolveAt = dissolveNoise();
if (dissolveAt < dissolve.x || dissolveAt >= dissolve.y) discard;
`
const origins = new WeakMap<Material, Material>()

/** Return the material that a dissolving one replaces; any other one itself. */
export function originOf(material: Material): Material {
  return origins.get(material) ?? material
}

interface Made {
  readonly material: Material
  version: number
}

/** Draws a part of the pixels of a mesh, by a noise on the screen: of two meshes that share [0, 1)
 * each pixel shows one. */
export class Dissolve {
  private readonly range = { value: new Vector2(0, 1) }
  private readonly made = new Map<Material, Made>()
  private own: Material | Material[] | null = null

  constructor(private readonly mesh: Mesh<Mesh['geometry'], Material | Material[]>) {}

  /** Draw the pixels whose noise is from `low` to below `high`. */
  show(low: number, high: number): void {
    this.range.value.set(low, high)
    if (this.own !== null) return
    const { material } = this.mesh
    this.own = material
    this.mesh.material = Array.isArray(material)
      ? material.map((each) => this.of(each))
      : this.of(material)
  }

  /** Draw the whole mesh, with its own material again. */
  end(): void {
    if (this.own === null) return
    this.mesh.material = this.own
    this.own = null
  }

  dispose(): void {
    this.end()
    for (const { material } of this.made.values()) material.dispose()
    this.made.clear()
  }

  private of(origin: Material): Material {
    let made = this.made.get(origin)
    if (made === undefined) {
      made = { material: dissolving(origin, this.range), version: origin.version }
      this.made.set(origin, made)
    } else if (made.version !== origin.version) {
      made.material.copy(origin)
      made.material.needsUpdate = true
      made.version = origin.version
    } else {
      // its colours may be those of another theme by now
      made.material.copy(origin)
    }
    return made.material
  }
}

function dissolving(origin: Material, range: { readonly value: Vector2 }): Material {
  const made = origin.clone()
  origins.set(made, origin)
  made.onBeforeCompile = (shader, renderer) => {
    origin.onBeforeCompile.call(origin, shader, renderer)
    shader.uniforms.dissolve = range
    shader.fragmentShader = shader.fragmentShader.replace(
      'void main() {',
      `${DECLARED}\nvoid main() {${APPLIED}`,
    )
  }
  made.customProgramCacheKey = () => `${origin.customProgramCacheKey()}|dissolve`
  return made
}
