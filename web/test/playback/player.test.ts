import { expect, test, vi } from 'vitest'
import { MotionPlayer, RemotePlayer } from '../../src/playback/player'

function player() {
  const clock = { now: 100 }
  return { clock, player: new MotionPlayer(8, () => clock.now) }
}

test('it stands until it plays, and stops at the end', () => {
  const { clock, player: motion } = player()
  clock.now = 105
  expect(motion.position()).toBe(0)
  motion.play()
  clock.now = 107
  expect(motion.position()).toBe(2)
  clock.now = 120
  expect(motion.position()).toBe(8)
  expect(motion.playing).toBe(false)
})

test('played again at the end it starts over', () => {
  const { clock, player: motion } = player()
  motion.seek(8)
  motion.play()
  clock.now = 101
  expect(motion.position()).toBe(1)
})

test('backwards it ends at the start, and begins at the end', () => {
  const { clock, player: motion } = player()
  motion.setRate(-2)
  motion.play()
  expect(motion.position()).toBe(8)
  clock.now = 103
  expect(motion.position()).toBe(2)
  expect(motion.playing).toBe(true)
  motion.setRate(1)
  clock.now = 104
  expect(motion.position()).toBe(3)
  motion.setRate(-1)
  clock.now = 110
  expect(motion.position()).toBe(0)
  expect(motion.playing).toBe(false)
})

test('a new rate holds from where it is', () => {
  const { clock, player: motion } = player()
  motion.play()
  clock.now = 102
  motion.setRate(0.5)
  clock.now = 106
  expect(motion.position()).toBe(4)
  motion.pause()
  clock.now = 200
  expect(motion.position()).toBe(4)
  expect(motion.rate).toBe(0.5)
})

test('a seek keeps playing, and stays within the timeline', () => {
  const { clock, player: motion } = player()
  motion.play()
  motion.seek(20)
  expect(motion.position()).toBe(8)
  motion.seek(-3)
  expect(motion.position()).toBe(0)
  motion.play()
  motion.seek(2)
  clock.now = 101
  expect(motion.position()).toBe(3)
})

test('each change is announced until nobody listens', () => {
  const { player: motion } = player()
  const heard = vi.fn()
  const stop = motion.onChange(heard)
  motion.play()
  motion.seek(1)
  stop()
  motion.pause()
  expect(heard).toHaveBeenCalledTimes(2)
})

test('a remote player follows a clock that runs backwards', () => {
  const clock = { now: 50 }
  const commands = { play: vi.fn(), pause: vi.fn(), seek: vi.fn(), setRate: vi.fn() }
  const remote = new RemotePlayer('live', () => clock.now, commands)
  remote.follow({ stamp: 50, position: 10, rate: -4 }, 10, -4)
  expect(remote.playing).toBe(true)
  clock.now = 51
  expect(remote.position()).toBe(6)
  clock.now = 60
  expect(remote.position()).toBe(0)
  expect(remote.playing).toBe(false)
})

test('a remote player asks and follows', () => {
  const clock = { now: 50 }
  const commands = { play: vi.fn(), pause: vi.fn(), seek: vi.fn(), setRate: vi.fn() }
  const remote = new RemotePlayer('live', () => clock.now, commands)
  const heard = vi.fn()
  remote.onChange(heard)
  remote.play()
  expect(commands.play).toHaveBeenCalledOnce()
  expect(remote.playing).toBe(false)
  remote.follow({ stamp: 50, position: 1, rate: 2 }, 10, 2)
  remote.follow({ stamp: 50, position: 1, rate: 2 }, 10, 2)
  expect(heard).toHaveBeenCalledOnce()
  clock.now = 52
  expect(remote.position()).toBe(5)
  expect(remote.playing).toBe(true)
  remote.seek(99)
  expect(commands.seek).toHaveBeenCalledWith(10)
})

test('a remote player that is held stands still, and goes on by its clock', () => {
  const clock = { now: 50 }
  const commands = { play: vi.fn(), pause: vi.fn(), seek: vi.fn(), setRate: vi.fn() }
  const remote = new RemotePlayer('live', () => clock.now, commands)
  remote.follow({ stamp: 50, position: 0, rate: 1 }, 10, 1)
  clock.now = 52
  const heard = vi.fn()
  remote.onChange(heard)
  remote.hold(true)
  clock.now = 55
  remote.hold(true)
  expect([remote.position(), remote.playing]).toEqual([2, false])
  remote.hold(false)
  expect([remote.position(), remote.playing]).toEqual([5, true])
  expect(heard).toHaveBeenCalledTimes(2)
})
