import { expect, test, vi } from 'vitest'
import { commandsOf } from '../../src/lab/commands'
import { LabFollower } from '../../src/lab/follower'
import { Course } from '../../src/playback/course'
import { diagnosticArrayReader } from '../../src/protocol/diagnostic_msgs'
import {
  collisionReader,
  contactsReader,
  createContact,
  createLabProcess,
  createRobot,
  createRobotSystem,
  Grasp,
  graspReader,
  LabProcess,
  labProcessesReader,
  PlaybackState,
  playbackStateReader,
  recorderStateReader,
  robotSystemsReader,
  robotsReader,
  seekType,
  triggerType,
} from '../../src/protocol/mrlab_msgs'
import { jointStateReader } from '../../src/protocol/sensor_msgs'
import { stringReader } from '../../src/protocol/std_msgs'
import type { LabScene } from '../../src/scene/lab/lab_scene'
import { FakeLink } from '../fake_link'

function lab() {
  const link = new FakeLink()
  link.time = 1000
  const joints = { setJoint: vi.fn(() => true), setPositions: vi.fn() }
  const scene = {
    setRobots: vi.fn(),
    setState: vi.fn(),
    setCollision: vi.fn(),
    setObjects: vi.fn(),
    setContacts: vi.fn(),
    setSurfaces: vi.fn(),
    setTargets: vi.fn(),
    frame: vi.fn(),
    robot: vi.fn(() => joints),
  }
  const stir = vi.fn()
  const courseOf = vi.fn(() => Promise.resolve(new Course(10, 2, Float64Array.of(0, 0, 1, 2))))
  const follower = new LabFollower(link, {
    commands: (name) => commandsOf({ link, say: () => undefined }, name),
    word: (state) => state.toLowerCase(),
    colour: () => '#123456',
    stir,
    courseOf,
  })
  follower.attach(scene as unknown as LabScene)
  const robot = { ...createRobot(), name: 'ur5e_1', model: 'ur5e' }
  return { link, scene, joints, stir, follower, robot, courseOf }
}

test('a robot is drawn with its URDF, whichever comes first', () => {
  const { link, scene, follower, robot } = lab()
  expect(follower.known.value).toBe(false)
  link.deliver('ur5e_1/robot_description', stringReader, { data: '<robot/>' })
  link.deliver('robots', robotsReader, { robots: [robot] })
  expect(follower.known.value).toBe(true)
  expect(scene.setRobots.mock.lastCall?.[0]).toMatchObject([{ name: 'ur5e_1', urdf: '<robot/>' }])
  link.deliver('robots', robotsReader, { robots: [] })
  expect(scene.setRobots.mock.lastCall?.[0]).toEqual([])
  expect(follower.robots.value).toEqual([])
})

test('a robot that was removed is forgotten, and one of its name begins anew', () => {
  const { link, scene, follower, robot } = lab()
  link.deliver('robots', robotsReader, { robots: [robot] })
  link.deliver('ur5e_1/robot_description', stringReader, { data: '<robot/>' })
  expect([...follower.activity.keys()]).toContain('ur5e_1/robot_description')
  link.deliver('robots', robotsReader, { robots: [] })
  expect([...follower.activity.keys()]).not.toContain('ur5e_1/robot_description')
  link.deliver('robots', robotsReader, { robots: [robot] })
  expect(scene.setRobots.mock.lastCall?.[0]).toMatchObject([{ name: 'ur5e_1', urdf: '' }])
})

test('a state moves the timeline and the word above the robot', () => {
  const { link, scene, follower, robot } = lab()
  link.deliver('robots', robotsReader, { robots: [robot] })
  link.deliver('ur5e_1/playback_state', playbackStateReader, {
    state: PlaybackState.PLAYING,
    clock: { stamp: { sec: 998, nanosec: 500_000_000 }, position: 1, rate: 2 },
    duration: 10,
    rate: 2,
  })
  const [view] = follower.robots.value
  expect(view?.state).toBe('PLAYING')
  expect(view?.player.position()).toBeCloseTo(4)
  expect(scene.setState).toHaveBeenLastCalledWith('ur5e_1', 'playing', '#123456', false)
})

test('joint states go to the picture by name, and ask for a new one', () => {
  const { link, joints, stir } = lab()
  link.deliver('ur5e_1/joint_states', jointStateReader, {
    name: ['a', 'b'],
    position: Float64Array.of(1, 2),
  })
  expect(joints.setJoint.mock.calls).toEqual([
    ['a', 1],
    ['b', 2],
  ])
  expect(stir).toHaveBeenCalled()
})

test('what is held and what is touched is said', () => {
  const { link, scene, follower, robot } = lab()
  link.deliver('robots', robotsReader, { robots: [robot] })
  link.deliver('ur5e_1/grasp', graspReader, { state: Grasp.HOLDING, object: 'rod_1' })
  const collision = collisionReader.create({ colliding: true })
  collision.contact.link = 'forearm_link'
  collision.contact.other = 'table'
  link.deliver('ur5e_1/collision', collisionReader, collision)
  expect(follower.robots.value[0]).toMatchObject({
    holding: 'rod_1',
    touching: 'forearm_link ↔ table',
  })
  expect(scene.setCollision).toHaveBeenLastCalledWith('ur5e_1', 'forearm_link')
  link.deliver('ur5e_1/grasp', graspReader, { state: Grasp.OPEN, object: '' })
  link.deliver('ur5e_1/collision', collisionReader, { colliding: false })
  expect(follower.robots.value[0]).toMatchObject({ holding: '', touching: '' })
  expect(scene.setCollision).toHaveBeenLastCalledWith('ur5e_1', '')
})

test('a timeline commands its robot', async () => {
  const { link, follower, robot } = lab()
  link.answer('ur5e_1/pause', triggerType, () => ({ success: true, message: '' }))
  link.deliver('robots', robotsReader, { robots: [robot] })
  follower.robots.value[0]?.player.pause()
  await vi.waitFor(() => expect(link.calls.map((call) => call.service)).toEqual(['ur5e_1/pause']))
})

test('a replay goes on between the recorder’s messages and stands when it is paused', () => {
  const { link, follower } = lab()
  const header = { stamp: { sec: 999, nanosec: 0 }, frame_id: '' }
  const state = { header, bag: 'class.bag', position: 3, duration: 20, rate: 2 }
  link.deliver('recorder/state', recorderStateReader, { ...state, state: 2 })
  expect(follower.replay.position()).toBeCloseTo(5)
  link.deliver('recorder/state', recorderStateReader, { ...state, state: 3 })
  expect(follower.replay.position()).toBeCloseTo(3)
})

test('the thumb of a timeline asks for the place where it is, not for all that it passed', async () => {
  const { link, follower } = lab()
  link.answer('recorder/seek', seekType, () => ({ success: true, message: '' }))
  const header = { stamp: { sec: 1000, nanosec: 0 }, frame_id: '' }
  link.deliver('recorder/state', recorderStateReader, { header, state: 3, duration: 20, rate: 1 })
  for (const place of [1, 2, 3, 4]) follower.replay.seek(place)
  const places = () => link.calls.map(({ request }) => (request as { position: number }).position)
  await vi.waitFor(() => expect(places()).toEqual([1, 4]))
})

test('the stops of a session that is replayed are known with their instants', () => {
  const { link, follower } = lab()
  const hit = { severity: 'error', code: 'run_hit', message: 'forearm_link touched table_1' }
  link.deliver('recorder/stops', diagnosticArrayReader, {
    status: [
      {
        level: 2,
        name: 'tour_stop',
        message: 'Stop 1 of 1: forearm_link touched table_1',
        hardware_id: 'mrlab',
        values: [
          { key: 'session_time', value: '1.500' },
          { key: 'events', value: JSON.stringify([hit]) },
        ],
      },
      { level: 0, name: 'newer', message: 'Something newer', hardware_id: '', values: [] },
    ],
  })
  expect(follower.stops.value).toMatchObject([
    { time: 1.5, severity: 'error', events: [{ code: 'run_hit' }] },
    { time: 0, severity: 'info', events: [{ code: 'newer', message: 'Something newer' }] },
  ])
})

test('a system keeps its timeline from message to message', () => {
  const { link, follower } = lab()
  const system = { ...createRobotSystem(), name: 'cell', duration: 8, rate: 1 }
  link.deliver('systems', robotSystemsReader, { systems: [system] })
  const player = follower.systems.value[0]?.player
  link.deliver('systems', robotSystemsReader, { systems: [system] })
  expect(follower.systems.value[0]?.player).toBe(player)
  expect(player?.duration).toBe(8)
})

test('each key is counted, and nothing is heard after the end', () => {
  const { link, follower, robot } = lab()
  link.deliver('robots', robotsReader, { robots: [robot] })
  link.deliver('robots', robotsReader, { robots: [robot] })
  expect(follower.activity.get('robots')).toMatchObject({
    type: 'mrlab_msgs/msg/Robots',
    count: 2,
    newest: 1000,
  })
  follower.dispose()
  link.deliver('robots', robotsReader, { robots: [] })
  expect(follower.robots.value).toHaveLength(1)
})

test('a playing robot is drawn by its clock until joint states contradict it', async () => {
  const { link, joints, follower, robot, courseOf } = lab()
  link.deliver('robots', robotsReader, { robots: [{ ...robot, joint_names: ['a', 'b'] }] })
  const clock = { stamp: { sec: 1000, nanosec: 0 }, position: 0, rate: 1 }
  const playing = {
    state: PlaybackState.PLAYING,
    trajectory_id: 'wave',
    trajectory_version: 3,
    clock,
    duration: 0.1,
    rate: 1,
  }
  link.deliver('ur5e_1/playback_state', playbackStateReader, playing)
  expect(courseOf).toHaveBeenCalledExactlyOnceWith('wave@3')
  await vi.waitFor(() => expect(courseOf.mock.results).toHaveLength(1))
  await courseOf.mock.results[0]?.value
  const states = (nanosec: number, a: number) =>
    link.deliver('ur5e_1/joint_states', jointStateReader, {
      header: { stamp: { sec: 1000, nanosec }, frame_id: '' },
      name: ['a', 'b'],
      position: Float64Array.of(a, 2 * a),
    })
  link.time = 1000.05
  states(20_000_000, 0.2)
  expect(follower.pose()).toBe(true)
  const drawn = joints.setPositions.mock.lastCall as unknown as [Float64Array]
  expect([...drawn[0]]).toEqual([expect.closeTo(0.5), expect.closeTo(1)])
  expect(follower.source('ur5e_1')).toBe('course')
  // Its pose contradicts the clock: the joint states are right.
  for (let i = 1; i < 6; i++) states(20_000_000 + i * 1_000_000, 0.9)
  link.time = 1000.2
  expect(follower.pose()).toBe(true)
  link.time = 1000.4
  expect(follower.pose()).toBe(false)
  expect(follower.source('ur5e_1')).toBe('states')
  const corrected = joints.setPositions.mock.lastCall as unknown as [Float64Array]
  expect([...corrected[0]]).toEqual([expect.closeTo(0.9), expect.closeTo(1.8)])
})

test('where a trajectory cannot be had, the joint states pose the robot', async () => {
  const { link, joints, follower, robot, courseOf } = lab()
  courseOf.mockRejectedValue(new Error('404'))
  link.deliver('robots', robotsReader, { robots: [{ ...robot, joint_names: ['a'] }] })
  link.deliver('ur5e_1/playback_state', playbackStateReader, {
    state: PlaybackState.PLAYING,
    trajectory_id: 'secret',
    clock: { stamp: { sec: 999, nanosec: 0 }, position: 0, rate: 1 },
    duration: 10,
  })
  await courseOf.mock.results[0]?.value.catch(() => undefined)
  link.deliver('ur5e_1/joint_states', jointStateReader, {
    name: ['a', 'finger'],
    position: Float64Array.of(1, 2),
  })
  expect(joints.setJoint.mock.calls).toEqual([['finger', 2]])
  expect(follower.pose()).toBe(true)
  expect(follower.pose()).toBe(false)
  const drawn = joints.setPositions.mock.lastCall as unknown as [Float64Array]
  expect([...drawn[0]]).toEqual([1])
})

test('without the link a robot stands where it was last known', () => {
  const { link, follower, robot, stir } = lab()
  link.deliver('robots', robotsReader, { robots: [robot] })
  link.deliver('ur5e_1/playback_state', playbackStateReader, {
    state: PlaybackState.PLAYING,
    clock: { stamp: { sec: 1000, nanosec: 0 }, position: 0, rate: 1 },
    duration: 10,
    rate: 1,
  })
  const player = follower.robots.value[0]?.player
  link.time = 1002
  stir.mockClear()
  link.setStatus('lost', 'gone')
  link.time = 1005
  expect([player?.position(), player?.playing]).toEqual([2, false])
  expect(stir).toHaveBeenCalled()
  link.setStatus('open')
  expect([player?.position(), player?.playing]).toEqual([5, true])
})

test('what touched is shown no longer than it touches: the lab says nothing of what no longer does', () => {
  const { link, scene, follower } = lab()
  const contacts = contactsReader.create({ contacts: [createContact()] })
  link.deliver('contacts', contactsReader, contacts)
  expect(scene.setContacts.mock.lastCall?.[0]).toHaveLength(1)
  link.time = 1000.2
  follower.pose()
  expect(scene.setContacts).toHaveBeenCalledTimes(1)
  link.time = 1000.4
  follower.pose()
  expect(scene.setContacts.mock.lastCall?.[0]).toEqual([])
  follower.pose()
  expect(scene.setContacts).toHaveBeenCalledTimes(2)
})

test('robots keep the order of the lab, whichever was heard of first', () => {
  const { link, follower } = lab()
  link.deliver('b/playback_state', playbackStateReader, {})
  const robots = ['a', 'b'].map((name) => ({ ...createRobot(), name }))
  link.deliver('robots', robotsReader, { robots })
  expect(follower.robots.value.map((each) => each.robot.name)).toEqual(['a', 'b'])
})

test('the frames of a trajectory are fetched once for all robots that play it', async () => {
  const { link, follower, robot, courseOf } = lab()
  const robots = ['a', 'b'].map((name) => ({ ...robot, name, joint_names: ['p', 'q'] }))
  link.deliver('robots', robotsReader, { robots })
  const loaded = { state: PlaybackState.READY, trajectory_id: 'wave', trajectory_version: 1 }
  for (const name of ['a', 'b'])
    link.deliver(`${name}/playback_state`, playbackStateReader, { ...loaded, duration: 0.1 })
  await vi.waitFor(() => expect(follower.course('b')).not.toBeNull())
  expect(follower.course('b')).toBe(follower.course('a'))
  expect(courseOf).toHaveBeenCalledTimes(1)
})

test('the robots of a process that dies stand at that instant, until their playback is back', () => {
  const { link, follower, robot } = lab()
  const playing = {
    state: PlaybackState.PLAYING,
    clock: { stamp: { sec: 998, nanosec: 0 }, position: 1, rate: 2 },
    duration: 10,
    rate: 2,
    host: '/playback_host/lab_7',
  }
  const process = { ...createLabProcess(), name: 'playback', nodes: ['playback_host'] }
  const deliver = (change: Partial<LabProcess>) =>
    link.deliver('processes', labProcessesReader, { processes: [{ ...process, ...change }] })
  link.deliver('robots', robotsReader, { robots: [robot] })
  link.deliver('ur5e_1/playback_state', playbackStateReader, playing)
  deliver({ state: LabProcess.RUNNING })
  expect(follower.outages.value).toEqual([])
  const down = { sec: 999, nanosec: 500_000_000 }
  deliver({ state: LabProcess.WAITING, down, last_exit: 'SIGKILL', exit_code: -9 })
  expect(follower.outages.value.map(({ kind }) => kind)).toEqual(['died'])
  expect(follower.robots.value[0]).toMatchObject({ down: true })
  expect(follower.robots.value[0]?.player.position()).toBeCloseTo(4)
  deliver({ state: LabProcess.RUNNING, down, since: { sec: 999, nanosec: 900_000_000 } })
  expect(follower.outages.value.map(({ kind }) => kind)).toEqual(['back'])
  link.deliver('ur5e_1/playback_state', playbackStateReader, {
    ...playing,
    state: PlaybackState.PAUSED,
    clock: { stamp: { sec: 1000, nanosec: 0 }, position: 3.9, rate: 0 },
  })
  expect(follower.robots.value[0]).toMatchObject({ down: false })
  expect(follower.robots.value[0]?.player.position()).toBeCloseTo(3.9)
  follower.dispose()
})
