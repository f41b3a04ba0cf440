import { Group, type Material, Matrix4, Mesh, type Object3D, Vector3 } from 'three'
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js'
import { mergeGeometries } from 'three/examples/jsm/utils/BufferGeometryUtils.js'
import { release } from '../../scene/robot/meshes'

// Files of our own origin, so that a headset without internet has them too.
const FILES = import.meta.glob<string>(
  [
    '/node_modules/@webxr-input-profiles/assets/dist/profiles/meta-quest-touch-{plus,plus-v2,pro}/*.glb',
    '/node_modules/@webxr-input-profiles/assets/dist/profiles/oculus-touch-{v2,v3}/*.glb',
    '/node_modules/@webxr-input-profiles/assets/dist/profiles/pico-{4,4u}/*.glb',
    '/node_modules/@webxr-input-profiles/assets/dist/profiles/generic-{hand,trigger}/*.glb',
    '/node_modules/@webxr-input-profiles/assets/dist/profiles/generic-trigger-squeeze-thumbstick/*.glb',
  ],
  { query: '?url', import: 'default', eager: true },
)
const OTHER = 'generic-trigger'
const JOINTS = 25

/** Fields that the WebXR types lack. */
interface JointPoses {
  fillPoses?(spaces: Iterable<XRSpace>, base: XRSpace, into: Float32Array): boolean
}

const matrix = new Matrix4()
const scale = new Vector3()

/** Return the file of the model of a controller or hand: of the first of its profiles that is here,
 * which a device names from the most exact to the most general; empty: there is none. */
export function modelFile(profiles: readonly string[], handedness: string): string {
  for (const profile of [...profiles, OTHER]) {
    const end = `/profiles/${profile}/${handedness}.glb`
    for (const [path, url] of Object.entries(FILES)) if (path.endsWith(end)) return url
  }
  return ''
}

/** Return the meshes of a controller as one for each material: its buttons do not move, and each mesh
 * is a draw call for each eye. What cannot be joined, or is mirrored, stays as it is. */
function joined(scene: Object3D): Object3D {
  const parts = new Map<Material | Material[], Mesh[]>()
  scene.updateMatrixWorld(true)
  scene.traverse((node) => {
    if (!(node instanceof Mesh)) return
    parts.set(node.material, [...(parts.get(node.material) ?? []), node])
  })
  const model = new Group()
  for (const [material, meshes] of parts) {
    const plain = meshes.every(({ matrixWorld }) => matrixWorld.determinant() > 0)
    const shapes = meshes.map((mesh) => mesh.geometry.clone().applyMatrix4(mesh.matrixWorld))
    const shape = plain ? mergeGeometries(shapes) : null
    for (const each of shapes) each.dispose()
    if (shape === null) {
      for (const mesh of meshes) model.attach(mesh)
      continue
    }
    for (const mesh of meshes) mesh.geometry.dispose()
    model.add(new Mesh(shape, material))
  }
  return model
}

/** The model of a controller or a hand. */
export class InputModel {
  readonly group = new Group()
  /** Of a hand: a bone a joint, in the order of XRHand; empty before it is read. */
  private bones: readonly (Object3D | undefined)[] = []
  private joints: readonly XRJointSpace[] = []
  private readonly poses = new Float32Array(16 * JOINTS)
  private gone = false

  constructor(
    private readonly source: XRInputSource,
    parent: Object3D,
  ) {
    this.group.visible = false
    this.group.matrixAutoUpdate = false
    parent.add(this.group)
    const file = modelFile(source.profiles, source.handedness)
    if (file === '') return
    new GLTFLoader().loadAsync(file).then(
      ({ scene }) => {
        if (this.gone) release(scene)
        else this.take(scene)
      },
      // Without a model the ray is still drawn.
      (error: Error) => console.warn(`${file}: ${error.message}`),
    )
  }

  /** Place a controller; undefined: its pose is unknown. */
  place(pose: XRPose | undefined): void {
    this.group.visible = pose !== undefined
    if (pose === undefined) return
    this.group.matrix.fromArray(pose.transform.matrix)
    this.group.matrixWorldNeedsUpdate = true
  }

  /** Pose the joints of a hand. */
  bend(frame: XRFrame & JointPoses, space: XRReferenceSpace): void {
    const { bones, joints, poses } = this
    const seen = bones.length > 0 && frame.fillPoses?.(joints, space, poses) === true
    this.group.visible = seen
    if (!seen) return
    for (let i = 0; i < bones.length; i++) {
      const bone = bones[i]
      if (bone === undefined) continue
      matrix.fromArray(poses, 16 * i).decompose(bone.position, bone.quaternion, scale)
    }
  }

  dispose(): void {
    this.gone = true
    this.group.removeFromParent()
    release(this.group)
  }

  private take(scene: Object3D): void {
    const { hand } = this.source
    this.group.add(hand === undefined ? joined(scene) : scene)
    if (hand === undefined) return
    // its bones are where the joints are, far from where the mesh was made
    scene.traverse((node) => {
      node.frustumCulled = false
    })
    this.joints = [...hand.values()]
    this.bones = [...hand.keys()].map((name) => scene.getObjectByName(name))
  }
}
