import {
  CircleGeometry,
  Color,
  Group,
  Mesh,
  PlaneGeometry,
  ShaderMaterial,
  ShadowMaterial,
} from 'three'
import type { SceneTheme } from './theme'

const RADIUS = 9 // m; the lines have faded before
const USUAL = 0.17 // m, width of a small robot's foot
const SOFT = 0.25 // m, how much wider a patch is

const VERTEX = `
varying vec2 place;
void main() {
  place = position.xy;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`

// Lines every 0.1 m and every 1 m, one pixel wide at any distance, which fade outwards.
const FRAGMENT = `
varying vec2 place;
uniform vec3 ink;
uniform float strength;
uniform float reach;
float lines(vec2 p, float step) {
  vec2 cell = p / step;
  vec2 width = fwidth(cell);
  vec2 near = abs(fract(cell - 0.5) - 0.5) / max(width, vec2(1e-6));
  vec2 seen = (1.0 - min(near, 1.0)) * clamp(1.0 - width * 2.5, 0.0, 1.0);
  return max(seen.x, seen.y);
}
void main() {
  float fade = smoothstep(1.0, 0.15, length(place) / reach);
  float shown = max(0.30 * lines(place, 0.1), 0.85 * lines(place, 1.0));
  gl_FragColor = vec4(ink, shown * fade * fade * strength);
}`

const BLOB = `
varying vec2 place;
uniform float strength;
uniform float dark;
void main() {
  float near = 1.0 - smoothstep(dark, 1.0, length(place) * 2.0);
  gl_FragColor = vec4(0.0, 0.0, 0.0, near * near * strength);
}`

/** The floor at z = 0 of the world: a grid in metres that catches the shadow. */
export class Floor {
  readonly group = new Group()
  private readonly grid: ShaderMaterial
  private readonly shadow = new ShadowMaterial({ color: 0x0a1420, opacity: 0.2 })
  private readonly disc = new CircleGeometry(RADIUS, 64)

  constructor() {
    this.grid = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      uniforms: { ink: { value: new Color() }, strength: { value: 0.3 }, reach: { value: 4.5 } },
      transparent: true,
      depthWrite: false,
      toneMapped: false,
    })
    const shadow = new Mesh(this.disc, this.shadow)
    shadow.receiveShadow = true
    shadow.position.z = -0.0015
    const grid = new Mesh(this.disc, this.grid)
    grid.position.z = -0.001
    grid.renderOrder = -1
    this.group.add(shadow, grid)
  }

  setTheme(theme: SceneTheme): void {
    const ink = this.grid.uniforms.ink
    const strength = this.grid.uniforms.strength
    // drawn without a colour space conversion: the number is the screen's
    if (ink) (ink.value as Color).set(theme.ink).convertLinearToSRGB()
    if (strength) strength.value = theme.name === 'dark' ? 0.28 : 0.3
    this.shadow.opacity = theme.name === 'dark' ? 0.5 : 0.2
  }

  /** Set the reach of the lines, m. */
  setReach(reach: number): void {
    const uniform = this.grid.uniforms.reach
    if (uniform) uniform.value = Math.min(Math.max(reach, 2), RADIUS)
  }

  dispose(): void {
    this.disc.dispose()
    this.grid.dispose()
    this.shadow.dispose()
  }
}

/** A soft dark patch below a robot, which joins it to the floor. */
export class ContactPatch extends Mesh<PlaneGeometry, ShaderMaterial> {
  constructor() {
    const material = new ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: BLOB,
      uniforms: { strength: { value: 0.45 }, dark: { value: 0 } },
      transparent: true,
      depthWrite: false,
      toneMapped: false,
    })
    super(new PlaneGeometry(1, 1), material)
    this.position.z = 0.0005
    this.fit(USUAL)
  }

  /** Fit it to a robot's foot. width: of the foot, m. */
  fit(width: number): void {
    const diameter = width + SOFT
    this.scale.set(diameter, diameter, 1)
    const dark = this.material.uniforms.dark
    // from within the foot on, so that its edge lies in the shade
    if (dark) dark.value = Math.max(0, width - SOFT / 2) / diameter
  }

  /** Free it, and take it out of the picture. */
  release(): void {
    this.removeFromParent()
    this.geometry.dispose()
    this.material.dispose()
  }
}
