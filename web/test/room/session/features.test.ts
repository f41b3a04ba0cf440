import { describe, expect, it } from 'vitest'
import { abilityOf, type Mode, missingOf, WANTED } from '../../../src/room/session/features'

const device = (...modes: Mode[]) => ({
  isSessionSupported: async (mode: Mode) => modes.includes(mode),
})

describe('the way into the room', () => {
  it.each([
    ['passthrough first', true, device('immersive-ar', 'immersive-vr'), 'immersive-ar', ''],
    ['else without', true, device('immersive-vr'), 'immersive-vr', ''],
    ['none without HTTPS', false, device('immersive-ar'), null, 'no_https'],
    ['none in an old browser', true, undefined, null, 'no_webxr'],
    ['none on a desktop', true, device(), null, 'no_device'],
  ] as const)('%s', async (_, secure, xr, mode, hindrance) => {
    expect(await abilityOf({ secure, xr })).toEqual({ mode, hindrance })
  })

  it('is blocked where the browser refuses the question', async () => {
    const xr = {
      isSessionSupported: () => Promise.reject(new DOMException('no', 'SecurityError')),
    }
    expect(await abilityOf({ secure: true, xr })).toEqual({ mode: null, hindrance: 'blocked' })
  })
})

it('what a session did not grant is known; one that does not tell is believed', () => {
  expect(missingOf(['local-floor', 'anchors'])).toEqual([
    'hand-tracking',
    'plane-detection',
    'mesh-detection',
  ])
  expect(missingOf([...WANTED])).toEqual([])
  expect(missingOf(undefined)).toEqual([])
  expect(missingOf([...WANTED], true)).toEqual(['depth-sensing'])
  expect(missingOf([...WANTED, 'depth-sensing'], true)).toEqual([])
})
