import { describe, expect, it } from 'vitest'
import { hopsOf, refusalOf, type Way } from '../../../src/room/session/hops'
import { words as de } from '../../../src/words/de'
import { en } from '../../../src/words/en'

const GOOD: Way = {
  ability: { mode: 'immersive-ar', hindrance: '' },
  link: { phase: 'open', reason: '', roundTrip: 0.01 },
  openFor: 20,
  known: true,
  outages: [],
  robots: 1,
  troubles: [],
}
const link = (phase: Way['link']['phase'], reason = '') => ({
  link: { phase, reason, roundTrip: Number.NaN },
})

describe.each([en, de])('what stands between lab and eyes', ({ room }) => {
  it.each([
    ['nothing', {}, []],
    ['no HTTPS', { ability: { mode: null, hindrance: 'no_https' } }, ['headset']],
    ['no WebXR', { ability: { mode: null, hindrance: 'no_webxr' } }, ['headset']],
    ['a desktop', { ability: { mode: null, hindrance: 'no_device' } }, ['headset']],
    ['a refusal', { ability: { mode: null, hindrance: 'blocked' } }, ['headset']],
    ['the socket', { ...link('lost', 'the gateway is gone'), known: false }, ['gateway']],
    ['a wrong version', { ...link('refused', 'version 2'), known: false }, ['gateway']],
    ['a lab that is silent', { known: false }, ['lab']],
    ['a lab that just answers', { known: false, openFor: 1 }, []],
    ['no robots', { robots: 0 }, ['robots']],
    ['a dead process', { outages: ['playback died at 12:03:04'] }, ['process']],
    ['a mesh', { troubles: ['base.glb'] }, ['meshes']],
  ] as const)('%s', (_, change, expected) => {
    const hops = hopsOf({ ...GOOD, ...change } as Way, room)
    expect(hops.map(({ id }) => id)).toEqual(expected)
    for (const { words } of hops) expect(words.length).toBeGreaterThan(10)
  })

  it('says how a headset is let in, and why a link is lost', () => {
    const way = { ...GOOD, ability: { mode: null, hindrance: 'no_https' as const } }
    expect(hopsOf(way, room)[0]?.words).toContain('mrlab up --keys')
    expect(hopsOf({ ...GOOD, ...link('lost', 'cable') }, room)[0]?.words).toContain('cable')
  })

  it('says what to do where the headset did not let somebody in', () => {
    const denied = new DOMException('', 'NotAllowedError')
    expect(refusalOf(denied, room)).toContain(room.permission)
    expect(refusalOf(new DOMException('', 'InvalidStateError'), room)).toContain(room.busy)
    expect(refusalOf(new DOMException('', 'NotSupportedError'), room)).toContain(room.noFloor)
    expect(refusalOf(new Error('no luck'), room)).toContain('no luck')
  })
})
