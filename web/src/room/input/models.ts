import { Group, Matrix4, type Object3D, Vector3 } from 'three'
import { GLTFLoader } from 'three/examples/jsm/loaders/GLTFLoader.js'
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
    this.group.add(scene)
    const { hand } = this.source
    if (hand === undefined) return
    // its bones are where the joints are, far from where the mesh was made
    scene.traverse((node) => {
      node.frustumCulled = false
    })
    this.joints = [...hand.values()]
    this.bones = [...hand.keys()].map((name) => scene.getObjectByName(name))
  }
}
