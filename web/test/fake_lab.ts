import type { Link } from '../src/link/link'
import {
  PlaybackState,
  playbackStateReader,
  robotSystemsReader,
  robotsReader,
  sceneObjectsReader,
  triggerType,
} from '../src/protocol/mrlab_msgs'
import { jointStateReader } from '../src/protocol/sensor_msgs'
import { stringReader } from '../src/protocol/std_msgs'
import { FakeLink } from './fake_link'

const ROBOTS = [
  { name: 'ur5e_1', model: 'ur5e', x: 0, home: [0, -1.57, 1.57, -1.57, -1.57, 0] },
  { name: 'kr6_1', model: 'kuka_kr6_r900_sixx', x: 1.3, home: [2.6, -1.2, 1.5, 0, 0.8, 0] },
]
const JOINTS = {
  ur5e: ['shoulder_pan', 'shoulder_lift', 'elbow', 'wrist_1', 'wrist_2', 'wrist_3'].map(
    (name) => `${name}_joint`,
  ),
  kuka_kr6_r900_sixx: [1, 2, 3, 4, 5, 6].map((n) => `joint_${n}`),
} as const
const PERIOD_MS = 20
const upright = { x: 0, y: 0, z: 0, w: 1 }

/** Return a lab of two robots that wave, without any lab: for the pages in `--mode fake`. */
export async function fakeLab(): Promise<Link> {
  const link = new FakeLink()
  const began = link.labTime()
  const standing = new Set<string>()
  link.setOffer({
    topics: { tf: 'tf2_msgs/msg/TFMessage', robots: 'mrlab_msgs/msg/Robots' },
  })
  const robots = ROBOTS.map(({ name, model, x }) => ({
    name,
    model,
    end_effector: '',
    pose: { position: { x, y: 0, z: 0 }, orientation: upright },
    joint_names: [...JOINTS[model as keyof typeof JOINTS]],
  }))
  link.deliver('robots', robotsReader, { robots }, { latched: true })
  for (const { name, model } of ROBOTS) {
    const urdf = await (await fetch(`/assets/mrlab_ros/robots/${model}/robot.urdf`)).text()
    link.deliver(`${name}/robot_description`, stringReader, { data: urdf }, { latched: true })
    const stamp = { sec: Math.floor(began), nanosec: 0 }
    const say = (state: number, rate: number) =>
      link.deliver(
        `${name}/playback_state`,
        playbackStateReader,
        {
          state,
          trajectory_id: 'wave',
          clock: { stamp, position: 0, rate },
          duration: 600,
          frame_count: 60000,
          frame_rate: 100,
          rate: 1,
        },
        { latched: true },
      )
    say(PlaybackState.PLAYING, 1)
    link.answer(`${name}/pause`, triggerType, () => {
      say(PlaybackState.PAUSED, 0)
      standing.add(name)
      return { success: true, message: 'paused' }
    })
  }
  link.deliver('systems', robotSystemsReader, { systems: [] }, { latched: true })
  const cube = { x: 0.05, y: 0.05, z: 0.05 }
  const objects = sceneObjectsReader.create().objects
  objects.push({
    name: 'cube_1',
    type: 'cube',
    pose: { position: { x: 0.6, y: -0.3, z: 0.025 }, orientation: upright },
    twist: { linear: { x: 0, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } },
    size: cube,
    mass: 0.1,
    color: { r: 0.85, g: 0.2, b: 0.15, a: 1 },
    mesh: '',
    primitive: { type: 1, dimensions: Float64Array.of(0.05, 0.05, 0.05), polygon: { points: [] } },
    held_by: '',
    in_tool: { position: { x: 0, y: 0, z: 0 }, orientation: upright },
  })
  setInterval(() => {
    const time = link.labTime() - began
    for (const { name, model, home } of ROBOTS) {
      if (standing.has(name)) continue
      link.deliver(`${name}/joint_states`, jointStateReader, {
        name: [...JOINTS[model as keyof typeof JOINTS]],
        position: Float64Array.from(home, (q, j) => q + 0.4 * Math.sin(time * 0.8 + j)),
      })
    }
    if (standing.size < ROBOTS.length) link.deliver('objects', sceneObjectsReader, { objects })
  }, PERIOD_MS)
  return link
}
