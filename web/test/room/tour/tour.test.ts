import { describe, expect, it, vi } from 'vitest'
import { type Seen, STEPS, Tour } from '../../../src/room/tour/tour'
import { words as de } from '../../../src/words/de'
import { en } from '../../../src/words/en'

const NOTHING: Seen = { robots: 0, loaded: false, playing: false, scrubs: 0, halted: false }

describe('the first steps', () => {
  it('go on when each is done, and end', () => {
    const done = vi.fn()
    const tour = new Tour(false, done)
    const steps: [Partial<Seen>, string | null][] = [
      [{}, 'place'],
      [{ robots: 1 }, 'load'],
      [{ robots: 1, loaded: true }, 'play'],
      [{ robots: 1, loaded: true, playing: true }, 'scrub'],
      [{ robots: 1, scrubs: 0 }, 'scrub'],
      [{ robots: 1, scrubs: 1 }, 'halt'],
      [{ robots: 1, halted: true }, 'halt'],
    ]
    for (const [seen, step] of steps) {
      tour.see({ ...NOTHING, ...seen })
      expect(tour.step).toBe(step)
    }
    expect(done).not.toHaveBeenCalled()
    expect(tour.see({ ...NOTHING, robots: 1 })).toBe(true)
    expect([tour.step, done.mock.calls.length]).toEqual([null, 1])
  })

  it('are not done by what was so before', () => {
    const tour = new Tour(false, () => undefined)
    tour.see({ ...NOTHING, robots: 3 })
    expect(tour.step).toBe('place')
    tour.see({ ...NOTHING, robots: 4 })
    expect(tour.step).toBe('load')
  })

  it('can be skipped one by one or as a whole, and begun again', () => {
    const done = vi.fn()
    const tour = new Tour(true, done)
    expect(tour.step).toBeNull()
    tour.skip()
    expect(done).not.toHaveBeenCalled()
    tour.begin()
    tour.next()
    expect([tour.step, tour.number]).toEqual(['load', 2])
    tour.skip()
    expect([tour.step, done.mock.calls.length]).toEqual([null, 1])
  })

  it.each([en, de])('have words for each step and each kind of hand', ({ room: { tour } }) => {
    for (const step of STEPS) {
      for (const words of [
        tour.steps[step],
        tour.gestures.hand[step],
        tour.gestures.controller[step],
      ])
        expect(words).not.toBe('')
    }
  })
})
