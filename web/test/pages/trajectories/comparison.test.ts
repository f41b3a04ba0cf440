// @vitest-environment jsdom
import { expect, test } from 'vitest'
import { inWords } from '../../../src/pages/trajectories/comparison'
import { words } from '../../../src/words/words'
import { fakeMotion } from '../../fake_motion'

const motion = (bump: number) => fakeMotion({ verdict: 'accepted', message: '', bump })

test('what would read as 0.00° is the same', () => {
  const { same } = words.value.trajectories
  expect(inWords(motion(0), motion(0))).toBe(same)
  expect(inWords(motion(0), motion(5e-5))).toBe(same)
  expect(inWords(motion(0), motion(5e-3))).toContain('0.29°')
})
