import type { MotionDocument, PackedArray } from '../src/playback/motion'
import type { Diagnostic } from '../src/words/diagnostic'

function packed(values: Float32Array, shape: readonly number[]): PackedArray {
  let text = ''
  for (const byte of new Uint8Array(values.buffer)) text += String.fromCharCode(byte)
  return { dtype: 'float32', shape, data: btoa(text) }
}

const NAMES = ['shoulder_pan', 'shoulder_lift', 'elbow', 'wrist_1', 'wrist_2', 'wrist_3']
const FROM = [0, -1.57, 1.57, -1.57, -1.57, 0]
const TO = [1.2, -1.0, 1.1, -2.2, -1.2, 0.9]

export interface FakeMotion {
  readonly verdict: MotionDocument['verdict']
  readonly message: string
  readonly findings?: readonly Diagnostic[]
  /** Added to the elbow in the middle, rad. */
  readonly bump?: number
  readonly frames?: number
}

/** Return a fifth-order motion of a UR5e there and back. */
export function fakeMotion({
  verdict,
  message,
  findings = [],
  bump = 0,
  frames = 801,
}: FakeMotion): MotionDocument {
  const joints = NAMES.length
  const q = new Float32Array(frames * joints)
  const dq = new Float32Array(frames * joints)
  const tau = new Float32Array(frames * joints)
  const half = (frames - 1) / 2
  for (let i = 0; i < frames; i++) {
    const back = i > half
    const s = back ? (frames - 1 - i) / half : i / half
    const way = s ** 3 * (10 - 15 * s + 6 * s * s)
    const rate = ((30 * s * s * (1 - s) ** 2) / (half / 100)) * (back ? -1 : 1)
    for (let j = 0; j < joints; j++) {
      const span = (TO[j] ?? 0) - (FROM[j] ?? 0)
      const extra = j === 2 ? bump * Math.exp(-(((s - 0.8) / 0.08) ** 2)) : 0
      q[i * joints + j] = (FROM[j] ?? 0) + span * way + extra
      dq[i * joints + j] = span * rate
      tau[i * joints + j] = span * rate * 0.4 + Math.sin(q[i * joints + j] ?? 0) * (4 - j / 2)
    }
  }
  return {
    schema: 'mrlab.motion.1',
    title: 'quintic_ur5e.mat',
    verdict,
    message,
    robot: {
      model: 'ur5e',
      product: 'UR5e',
      end_effector: '',
      urdf: '<robot name="ur5e"/>',
      joints: NAMES.map((name, j) => ({
        name,
        kind: 'revolute',
        lower: j === 2 ? -Math.PI : -2 * Math.PI,
        upper: j === 2 ? Math.PI : 2 * Math.PI,
        velocity: Math.PI,
      })),
    },
    frame_rate: 100,
    times: null,
    rows: null,
    positions: packed(q, [frames, joints]),
    gripper: null,
    velocities: packed(dq, [frames, joints]),
    effort_proxies: packed(tau, [frames, joints]),
    findings,
    source: { file: 'quintic_ur5e.mat', variable: 'q', sha256: '0'.repeat(64) },
  }
}
