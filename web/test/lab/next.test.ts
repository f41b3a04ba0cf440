// @vitest-environment jsdom
import { expect, test } from 'vitest'
import { clockOf, type RobotView } from '../../src/lab/followed_robot'
import { nextOf } from '../../src/lab/next'
import { RemotePlayer } from '../../src/playback/player'
import {
  createGraspTarget,
  createPlaybackState,
  createRobot,
  createSystemMember,
} from '../../src/protocol/mrlab_msgs'
import { en } from '../../src/words/en'

const w = en.lab.next
const none = { play() {}, pause() {}, seek() {}, setRate() {} }

function view(state: RobotView['state'], rate = 1, loop = false): RobotView {
  const playback = { ...createPlaybackState(), frame_count: 401, duration: 4, rate, loop }
  const player = new RemotePlayer('live', () => 0, none)
  player.follow(clockOf(playback), playback.duration, rate)
  const targets = [
    { ...createGraspTarget(), time: 1, close: true },
    { ...createGraspTarget(), time: 3, close: false },
  ]
  return {
    robot: createRobot(),
    state,
    playback: { ...playback, trajectory_id: 'pick' },
    holding: '',
    touching: '',
    overlaps: [],
    targets,
    down: false,
    player,
  }
}

test('a robot that plays goes on to its next grasp, and then to its end', () => {
  const robot = view('PLAYING')
  expect(nextOf(robot, 0.5, null, w)).toBe(w.closes('1.00'))
  expect(nextOf(robot, 1, null, w)).toBe(w.opens('3.00'))
  expect(nextOf(robot, 3.5, null, w)).toBe(w.ends('4.00'))
  expect(nextOf(view('PLAYING', 1, true), 3.5, null, w)).toBe(w.again)
})

test('played backwards, it opens where it closed', () => {
  const robot = view('PLAYING', -1)
  expect(nextOf(robot, 3.5, null, w)).toBe(w.closes('3.00'))
  expect(nextOf(robot, 2, null, w)).toBe(w.opens('1.00'))
  expect(nextOf(robot, 0.5, null, w)).toBe(w.ends('0.00'))
})

test('one that stands says what brings it on', () => {
  expect(nextOf(view('PAUSED'), 2, null, w)).toBe(w.goesOn('2.00'))
  expect(nextOf(view('COLLISION_HALT'), 2, null, w)).toBe(w.free('2.00'))
  expect(nextOf(view('READY', 2), 0, null, w)).toBe(w.plays('pick', '2.00'))
  expect(nextOf({ ...view('IDLE'), playback: null }, 0, null, w)).toBe(w.load)
  expect(nextOf({ ...view('PLAYING'), down: true }, 0, null, w)).toBe(w.down)
})

test('a member of a system waits for its turn, or for another', () => {
  const member = { ...createSystemMember(), start: 5 }
  expect(nextOf(view('READY'), 0, { member, position: 2 }, w)).toBe(w.turn('3.00'))
  const held = { ...member, waiting_for: 'ur5e_2' }
  expect(nextOf(view('PAUSED'), 0, { member: held, position: 2 }, w)).toBe(w.waits('ur5e_2'))
})
