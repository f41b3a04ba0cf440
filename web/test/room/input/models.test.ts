import { describe, expect, it } from 'vitest'
import { modelFile } from '../../../src/room/input/models'

const KNOWN = [
  'meta-quest-touch-plus',
  'meta-quest-touch-plus-v2',
  'meta-quest-touch-pro',
  'oculus-touch-v2',
  'oculus-touch-v3',
  'pico-4',
  'pico-4u',
  'generic-trigger',
  'generic-trigger-squeeze-thumbstick',
  'generic-hand',
]

describe('the model of a controller', () => {
  it.each(KNOWN)('%s is served by the page itself, for each hand', (profile) => {
    for (const hand of ['left', 'right']) {
      const file = modelFile([profile, 'generic-trigger'], hand)
      expect(file).toMatch(new RegExp(`^/[^/].*/${profile}/${hand}\\.glb`))
    }
  })

  it('is that of the most exact profile that is known', () => {
    const exact = modelFile(['meta-quest-touch-plus'], 'left')
    expect(modelFile(['somebody-else', 'meta-quest-touch-plus', 'generic-trigger'], 'left')).toBe(
      exact,
    )
    expect(modelFile(['somebody-else'], 'left')).toBe(modelFile(['generic-trigger'], 'left'))
  })
})
