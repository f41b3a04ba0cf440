// A furnished room behind the emulated headset, as its cameras would show it: for pictures.
// Floor y = 0, the eyes look along -z, m. Loaded beside three's own module, in no page.
import * as THREE from './three.module.js'

const WALL_Z = -3.4
const WALL_X = 3.1
const HEIGHT = 2.7
/** Of the table: middle, half lengths, height. */
export const TABLE = { x: -1.55, z: -2.25, halfX: 0.75, halfZ: 0.42, height: 0.72 }

/** Of a low table, so far from the other that a robot stands between them. */
export const LOW_TABLE = { x: -1.0, z: -1.0, halfX: 0.36, halfZ: 0.24, height: 0.34 }

let seed = 7
function random() {
  seed = (seed * 16807) % 2147483647
  return seed / 2147483647
}

function painted(width, height, paint, repeat) {
  const canvas = document.createElement('canvas')
  canvas.width = width
  canvas.height = height
  paint(canvas.getContext('2d'), width, height)
  const texture = new THREE.CanvasTexture(canvas)
  texture.colorSpace = THREE.SRGBColorSpace
  texture.anisotropy = 8
  if (repeat) {
    texture.wrapS = texture.wrapT = THREE.RepeatWrapping
    texture.repeat.set(...repeat)
  }
  return texture
}

/** Oak boards: `rows` of them, each with its own tone and grain. */
function boards(context, width, height, rows, lightness) {
  const step = height / rows
  for (let row = 0; row < rows; row++) {
    let x = -random() * 300
    while (x < width) {
      const length = 320 + random() * 220
      const tone = lightness + random() * 9
      context.fillStyle = `hsl(${29 + random() * 5} ${30 + random() * 7}% ${tone}%)`
      context.fillRect(x, row * step, length, step)
      for (let i = 0; i < 26; i++) {
        context.fillStyle = `hsl(26 34% ${tone - 4 - random() * 7}% / ${0.1 + random() * 0.2})`
        const y = row * step + random() * step
        context.fillRect(x + random() * length * 0.5, y, length * (0.2 + random() * 0.6), 1)
      }
      context.fillStyle = 'hsl(26 30% 24% / 0.55)'
      context.fillRect(x, row * step, 1.5, step)
      context.fillRect(x, row * step, length, 1.2)
      x += length
    }
  }
}

function standard(color, roughness = 0.85, map = null) {
  return new THREE.MeshStandardMaterial({ color, roughness, map })
}

/** Draws the room; `render` draws it anew where the eyes moved. */
export class FurnishedRoom {
  canvas = document.createElement('canvas')
  scene = new THREE.Scene()
  camera = new THREE.PerspectiveCamera(60, 1, 0.05, 40)
  drawn = ''

  constructor(device) {
    this.device = device
    this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, antialias: true })
    this.renderer.shadowMap.enabled = true
    this.renderer.shadowMap.type = THREE.PCFShadowMap
    this.renderer.toneMapping = THREE.AgXToneMapping
    this.renderer.toneMappingExposure = 1.25
    Object.assign(this.canvas.style, { position: 'fixed', inset: '0', filter: 'saturate(0.92)' })
    this.build()
    this.scene.traverse((each) => {
      if (!each.isMesh) return
      each.castShadow = each.userData.casts !== false
      each.receiveShadow = true
    })
    this.renderer.shadowMap.autoUpdate = false
    this.renderer.shadowMap.needsUpdate = true
  }

  render() {
    const { position: p, quaternion: q, fovy } = this.device
    const { innerWidth: width, innerHeight: height } = window
    const key = [p.x, p.y, p.z, q.x, q.y, q.z, q.w, fovy, width, height].join()
    if (key === this.drawn) return
    this.drawn = key
    this.renderer.setSize(width, height)
    this.camera.fov = (fovy * 180) / Math.PI
    this.camera.aspect = width / height
    this.camera.updateProjectionMatrix()
    this.camera.position.set(p.x, p.y, p.z)
    this.camera.quaternion.set(q.x, q.y, q.z, q.w)
    this.renderer.render(this.scene, this.camera)
  }

  box(w, h, d, x, y, z, material, turn = 0) {
    const mesh = new THREE.Mesh(new THREE.BoxGeometry(w, h, d), material)
    mesh.position.set(x, y, z)
    mesh.rotation.y = turn
    this.scene.add(mesh)
    return mesh
  }

  /** A box with soft edges: cushions. */
  soft(w, h, d, x, y, z, material) {
    const r = Math.min(w, h, d) * 0.28
    const shape = new THREE.Shape()
    const [a, b] = [w / 2 - r, h / 2 - r]
    shape.absarc(a, b, r, 0, Math.PI / 2)
    shape.absarc(-a, b, r, Math.PI / 2, Math.PI)
    shape.absarc(-a, -b, r, Math.PI, 1.5 * Math.PI)
    shape.absarc(a, -b, r, 1.5 * Math.PI, 2 * Math.PI)
    const bevel = Math.min(0.03, d / 4)
    const geometry = new THREE.ExtrudeGeometry(shape, {
      depth: d - 2 * bevel,
      bevelSize: bevel * 0.8,
      bevelThickness: bevel,
      bevelSegments: 4,
      curveSegments: 8,
    })
    geometry.translate(0, 0, -(d - 2 * bevel) / 2)
    const mesh = new THREE.Mesh(geometry, material)
    mesh.position.set(x, y, z)
    this.scene.add(mesh)
    return mesh
  }

  turned(profile, x, y, z, material) {
    const points = profile.map(([radius, height]) => new THREE.Vector2(radius, height))
    const mesh = new THREE.Mesh(new THREE.LatheGeometry(points, 40), material)
    mesh.position.set(x, y, z)
    this.scene.add(mesh)
    return mesh
  }

  /** A soft dark patch where something stands. */
  patch(width, depth, x, z, strength = 0.5, y = 0.004) {
    const map = painted(128, 128, (context) => {
      const shade = context.createRadialGradient(64, 64, 8, 64, 64, 64)
      shade.addColorStop(0, `rgb(20 14 8 / ${strength})`)
      shade.addColorStop(0.6, `rgb(20 14 8 / ${strength * 0.45})`)
      shade.addColorStop(1, 'rgb(20 14 8 / 0)')
      context.fillStyle = shade
      context.fillRect(0, 0, 128, 128)
    })
    const look = { map, transparent: true, depthWrite: false }
    const mesh = new THREE.Mesh(
      new THREE.PlaneGeometry(width, depth),
      new THREE.MeshBasicMaterial(look),
    )
    mesh.rotation.x = -Math.PI / 2
    mesh.position.set(x, y, z)
    mesh.userData.casts = false
    this.scene.add(mesh)
  }

  build() {
    this.shell()
    this.window()
    this.table()
    this.sofa()
    this.shelf()
    this.small()
    const sky = new THREE.HemisphereLight(0xfff6ea, 0xb59a7c, 1.75)
    const sun = new THREE.DirectionalLight(0xfff0dc, 2.6)
    sun.position.set(-4.2, 4.4, 1.2)
    sun.target.position.set(0.3, 0, -1.7)
    sun.castShadow = true
    sun.shadow.mapSize.set(2048, 2048)
    Object.assign(sun.shadow.camera, { left: -4, right: 4, top: 4, bottom: -4, near: 0.5, far: 14 })
    sun.shadow.camera.updateProjectionMatrix()
    sun.shadow.radius = 6
    sun.shadow.normalBias = 0.02
    const fill = new THREE.DirectionalLight(0xdfe9ff, 0.55)
    fill.position.set(2, 2.5, 3)
    this.scene.add(sky, sun, sun.target, fill)
    this.scene.background = new THREE.Color(0xe6e0d6)
  }

  shell() {
    const floor = painted(2048, 2048, (context, w, h) => boards(context, w, h, 22, 54))
    const plane = (w, h, x, y, z, rx, ry, material) => {
      const mesh = new THREE.Mesh(new THREE.PlaneGeometry(w, h), material)
      mesh.position.set(x, y, z)
      mesh.rotation.set(rx, ry, 0)
      mesh.userData.casts = false
      this.scene.add(mesh)
    }
    const depth = 8
    const middle = WALL_Z + depth / 2
    plane(2 * WALL_X, depth, 0, 0, middle, -Math.PI / 2, 0, standard(0xffffff, 0.62, floor))
    plane(2 * WALL_X, HEIGHT, 0, HEIGHT / 2, WALL_Z, 0, 0, standard(0xc9d3cb, 0.95))
    const side = standard(0xf1ece4, 0.95)
    plane(depth, HEIGHT, -WALL_X, HEIGHT / 2, middle, 0, Math.PI / 2, side)
    plane(depth, HEIGHT, WALL_X, HEIGHT / 2, middle, 0, -Math.PI / 2, side)
    const ceiling = new THREE.MeshBasicMaterial({ color: 0xf0ede7, toneMapped: false })
    plane(2 * WALL_X, depth, 0, HEIGHT, middle, Math.PI / 2, 0, ceiling)
    const skirting = standard(0xfaf8f4, 0.6)
    this.box(2 * WALL_X, 0.09, 0.02, 0, 0.045, WALL_Z + 0.01, skirting)
    for (const x of [-WALL_X + 0.01, WALL_X - 0.01]) this.box(0.02, 0.09, depth, x, 0.045, middle, skirting)
    const rug = painted(512, 512, (context) => {
      context.fillStyle = '#6d8196'
      context.fillRect(0, 0, 512, 512)
      for (let i = 0; i < 9000; i++) {
        context.fillStyle = `hsl(210 ${12 + random() * 12}% ${42 + random() * 18}% / 0.5)`
        context.fillRect(random() * 512, random() * 512, 2, 3)
      }
      context.strokeStyle = '#d9dee3'
      context.lineWidth = 7
      for (const inset of [26, 44]) context.strokeRect(inset, inset, 512 - 2 * inset, 512 - 2 * inset)
    })
    this.box(2.7, 0.008, 1.9, 0.35, 0.004, -1.55, standard(0xffffff, 1, rug)).userData.casts = false
  }

  window() {
    const view = painted(512, 512, (context) => {
      const sky = context.createLinearGradient(0, 0, 0, 512)
      sky.addColorStop(0, '#bcd9f5')
      sky.addColorStop(0.62, '#eef6fc')
      sky.addColorStop(0.63, '#9db88d')
      sky.addColorStop(1, '#6f9163')
      context.fillStyle = sky
      context.fillRect(0, 0, 512, 512)
      for (let i = 0; i < 40; i++) {
        context.fillStyle = `hsl(${95 + random() * 30} 28% ${38 + random() * 18}% / 0.8)`
        context.beginPath()
        context.arc(random() * 512, 330 + random() * 60, 18 + random() * 34, 0, 7)
        context.fill()
      }
    })
    const bright = new THREE.MeshBasicMaterial({ map: view, color: 0xffffff, toneMapped: false })
    const pane = this.box(0.02, 1.35, 1.7, -WALL_X + 0.01, 1.55, -1.5, bright)
    pane.userData.casts = false
    const frame = standard(0xffffff, 0.5)
    for (const [h, d, y, z] of [
      [0.07, 1.84, 2.26, -1.5],
      [0.07, 1.84, 0.84, -1.5],
      [1.42, 0.07, 1.55, -2.39],
      [1.42, 0.07, 1.55, -0.61],
      [1.42, 0.05, 1.55, -1.5],
    ])
      this.box(0.08, h, d, -WALL_X + 0.04, y, z, frame)
    const cloth = standard(0xe9dfd0, 1)
    for (const z of [-2.62, -0.38]) {
      for (let i = 0; i < 5; i++) {
        const fold = new THREE.CylinderGeometry(0.045, 0.055, 2.3, 14)
        const mesh = new THREE.Mesh(fold, cloth)
        mesh.position.set(-WALL_X + 0.1 + (i % 2) * 0.03, 1.25, z - 0.16 + i * 0.08)
        this.scene.add(mesh)
      }
    }
  }

  table() {
    const { x, z, halfX, halfZ, height } = TABLE
    const grain = painted(1024, 512, (context, w, h) => boards(context, w, h, 5, 63))
    const wood = standard(0xffffff, 0.5, grain)
    this.box(2 * halfX, 0.035, 2 * halfZ, x, height - 0.0175, z, wood)
    const leg = standard(0xf4f1ea, 0.5)
    for (const side of [-1, 1])
      for (const end of [-1, 1])
        this.box(0.05, height - 0.03, 0.05, x + side * (halfX - 0.06), (height - 0.03) / 2, z + end * (halfZ - 0.06), leg)
    this.box(2 * halfX - 0.12, 0.07, 0.02, x, height - 0.075, z + halfZ - 0.06, leg)
    this.patch(2 * halfX + 0.3, 2 * halfZ + 0.3, x, z, 0.4)
    const low = LOW_TABLE
    this.box(2 * low.halfX, 0.03, 2 * low.halfZ, low.x, low.height - 0.015, low.z, wood)
    for (const side of [-1, 1])
      for (const end of [-1, 1])
        this.box(0.04, low.height - 0.03, 0.04, low.x + side * (low.halfX - 0.05), (low.height - 0.03) / 2, low.z + end * (low.halfZ - 0.05), leg)
    this.patch(2 * low.halfX + 0.2, 2 * low.halfZ + 0.2, low.x, low.z, 0.45)
    // a computer, a mug, some sheets
    const dark = standard(0x30363d, 0.4)
    const screen = painted(512, 300, (context) => {
      context.fillStyle = '#12161c'
      context.fillRect(0, 0, 512, 300)
      for (const [i, colour] of ['#6cb6ff', '#43b892', '#f1ce0c', '#ca3b1d'].entries()) {
        context.strokeStyle = colour
        context.lineWidth = 4
        context.beginPath()
        for (let k = 0; k <= 100; k++)
          context.lineTo(40 + k * 4.3, 150 + (70 - i * 12) * Math.sin(k / (9 + 4 * i) + i))
        context.stroke()
      }
    })
    const lid = this.box(0.34, 0.22, 0.012, x - 0.42, height + 0.12, z - 0.2, dark)
    lid.rotation.x = -0.22
    const lit = new THREE.Mesh(
      new THREE.PlaneGeometry(0.32, 0.2),
      new THREE.MeshBasicMaterial({ map: screen, toneMapped: false }),
    )
    lit.position.z = 0.007
    lid.add(lit)
    this.box(0.34, 0.015, 0.23, x - 0.42, height + 0.008, z - 0.06, dark)
    const mug = standard(0xd9694a, 0.35)
    this.turned([[0.001, 0], [0.038, 0], [0.042, 0.09], [0.036, 0.09], [0.033, 0.01]], x - 0.12, height, z - 0.24, mug)
    this.box(0.21, 0.004, 0.297, x + 0.5, height + 0.002, z + 0.15, standard(0xfdfdfb, 0.9), 0.3)
  }

  sofa() {
    const cloth = standard(0x8d8377, 1)
    const x = 2.15
    const z = -2.15
    const s = (w, h, d, dx, y, dz) => {
      const mesh = this.soft(w, h, d, x, y, z, cloth)
      mesh.position.x += dx
      mesh.position.z += dz
      return mesh
    }
    s(0.86, 0.24, 1.95, 0.1, 0.27, 0)
    s(0.24, 0.5, 1.95, 0.5, 0.55, 0)
    for (const side of [-1, 1]) {
      s(0.9, 0.36, 0.2, 0.1, 0.43, side * 1.02)
      s(0.62, 0.15, 0.9, -0.03, 0.44, side * 0.46)
      s(0.17, 0.38, 0.84, 0.34, 0.66, side * 0.46).rotation.z = -0.16
    }
    const cushion = this.soft(0.14, 0.38, 0.4, x + 0.16, 0.7, z - 0.62, standard(0xc9854f, 1))
    cushion.rotation.set(0.1, 0.35, -0.28)
    for (const a of [-0.3, 0.42]) for (const b of [-0.9, 0.9])
      this.box(0.05, 0.16, 0.05, x + a, 0.08, z + b, standard(0x6b4a2f, 0.5))
    this.patch(1.5, 2.7, x + 0.05, z, 0.55)
  }

  shelf() {
    const wood = standard(0xb98d5f, 0.6)
    const x = 0.42
    const z = WALL_Z + 0.15
    const colours = [0xa43f2f, 0x2f5d7c, 0xd9a441, 0x466b4f, 0x7a5c8e, 0xe7e0d2, 0x3a3f47]
    for (const [i, y] of [1.42, 1.83].entries()) {
      this.box(1.5, 0.03, 0.26, x, y, z, wood)
      let at = x - 0.68 + i * 0.25
      for (let k = 0; k < 13 - 3 * i; k++) {
        const [w, h] = [0.025 + random() * 0.03, 0.19 + random() * 0.09]
        const tint = colours[Math.floor(random() * colours.length)]
        const book = this.box(w, h, 0.17, at + w / 2, y + 0.015 + h / 2, z, standard(tint, 0.8))
        if (k === 12 - 3 * i) book.rotation.z = -0.18
        at += w + 0.003
      }
    }
    this.turned([[0.001, 0], [0.05, 0], [0.075, 0.07], [0.05, 0.15], [0.03, 0.2], [0.036, 0.22]], x + 0.5, 1.435, z, standard(0x3f6f73, 0.3))
    this.turned([[0.001, 0], [0.045, 0], [0.055, 0.09], [0.05, 0.09]], x - 0.55, 1.845, z, standard(0xe8e3da, 0.6))
    this.leaves(x - 0.55, 1.93, z, 9, 0.16)
  }

  leaves(x, y, z, count, size) {
    const shape = new THREE.Shape()
    shape.moveTo(0, 0)
    shape.quadraticCurveTo(0.22, 0.4, 0, 1)
    shape.quadraticCurveTo(-0.22, 0.4, 0, 0)
    const geometry = new THREE.ShapeGeometry(shape, 8)
    const places = geometry.getAttribute('position')
    for (let i = 0; i < places.count; i++) {
      const [a, b] = [places.getX(i), places.getY(i)]
      places.setZ(i, -0.45 * b * b + 0.9 * a * a)
    }
    geometry.computeVertexNormals()
    for (let i = 0; i < count; i++) {
      const look = { color: new THREE.Color().setHSL(0.33 + random() * 0.05, 0.36, 0.25 + random() * 0.12) }
      const leaf = new THREE.Mesh(
        geometry,
        new THREE.MeshStandardMaterial({ ...look, side: THREE.DoubleSide, roughness: 0.7 }),
      )
      const s = size * (0.7 + random() * 0.7)
      leaf.scale.set(s, s, s)
      leaf.position.set(x, y, z)
      leaf.rotation.order = 'YXZ'
      leaf.rotation.set(0.15 + random() * 0.75, (i / count) * 6.283 + random() * 0.5, 0)
      this.scene.add(leaf)
    }
  }

  small() {
    // a plant, pictures, a lamp
    const pot = [[0.001, 0], [0.13, 0], [0.17, 0.32], [0.15, 0.32], [0.14, 0.28], [0.001, 0.28]]
    this.turned(pot, -2.72, 0, -3.02, standard(0xc4785a, 0.8))
    this.leaves(-2.72, 0.3, -3.02, 22, 0.75)
    this.patch(0.7, 0.7, -2.72, -3.02, 0.5)
    for (const [x, y, w, h, a, b] of [
      [-1.55, 1.68, 0.62, 0.82, '#e9c46a', '#264653'],
      [-0.95, 1.82, 0.4, 0.5, '#e76f51', '#f4ede2'],
    ]) {
      const art = painted(256, 330, (context) => {
        context.fillStyle = '#f6f2ea'
        context.fillRect(0, 0, 256, 330)
        context.fillStyle = a
        context.beginPath()
        context.arc(128, 140, 72, 0, 7)
        context.fill()
        context.fillStyle = b
        context.beginPath()
        context.moveTo(30, 280)
        context.lineTo(120, 150)
        context.lineTo(226, 280)
        context.fill()
      })
      this.box(w, h, 0.025, x, y, WALL_Z + 0.015, standard(0x3a332c, 0.5))
      this.box(w - 0.05, h - 0.05, 0.01, x, y, WALL_Z + 0.025, standard(0xffffff, 0.9, art))
    }
    const metal = standard(0x2c2c2e, 0.4)
    this.turned([[0.001, 0], [0.15, 0], [0.15, 0.02], [0.012, 0.03], [0.012, 1.45]], 1.5, 0, -3.1, metal)
    const shade = new THREE.MeshStandardMaterial({
      color: 0xfff3dd,
      emissive: 0xffd9a0,
      emissiveIntensity: 0.35,
      side: THREE.DoubleSide,
    })
    this.turned([[0.2, 1.42], [0.13, 1.72]], 1.5, 0, -3.1, shade)
    this.patch(0.5, 0.5, 1.5, -3.1, 0.4)
  }
}

/** Furnish the emulated headset's room: what it sees, and the planes that Space Setup would know. */
export function furnish({ device, planes, plane }) {
  const room = new FurnishedRoom(device)
  device.sem.environmentCanvas = room.canvas
  device.sem.render = () => room.render()
  planes.clear()
  planes.add(plane(WALL_X, 4, 'floor', { x: 0, y: 0, z: WALL_Z + 4 }))
  for (const { x, z, halfX, halfZ, height } of [TABLE, LOW_TABLE])
    planes.add(plane(halfX, halfZ, 'table', { x, y: height, z }))
  return room
}
