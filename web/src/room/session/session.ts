import type { WebGLRenderer } from 'three'
import { DEPTH, EXTRA, type Feature, type Mode, missingOf, REQUIRED, WANTED } from './features'

const FRAME_RATE = 72

/** A running session, and the features that it lacks. */
export interface RoomSession {
  readonly session: XRSession
  readonly mode: Mode
  readonly missing: readonly Feature[]
}

/** Enter. Must be called by a person's tap. Rejects as `navigator.xr.requestSession` does. depth:
 * request the depth of the visible room. */
export async function enter(
  renderer: WebGLRenderer,
  mode: Mode,
  depth: boolean,
  onEnd: () => void,
): Promise<RoomSession> {
  const { xr } = navigator
  if (xr === undefined) throw new DOMException('this browser has no WebXR', 'NotSupportedError')
  const asked = depth && mode === 'immersive-ar'
  const wanted: XRSessionInit = {
    requiredFeatures: [...REQUIRED],
    optionalFeatures: [...WANTED, ...EXTRA],
  }
  if (asked) {
    wanted.optionalFeatures?.push(DEPTH)
    // The device chooses the format: each is read as a number.
    wanted.depthSensing = { usagePreference: ['gpu-optimized'], dataFormatPreference: [] }
  }
  const session = await xr.requestSession(mode, wanted)
  session.addEventListener('end', onEnd, { once: true })
  muteLightProbe(session)
  await renderer.xr.setSession(session)
  await settle(session)
  return { session, mode, missing: missingOf(session.enabledFeatures, asked) }
}

/** The part of a session that estimates light; TypeScript's types of WebXR lack it. */
type LightSession = Partial<XRSession> & {
  requestLightProbe?: (options?: object) => Promise<object>
}

/** Leave a refused light probe unanswered: many headsets estimate no light, and three.js does not
 * handle the rejection. */
export function muteLightProbe(session: LightSession): void {
  if (session.requestLightProbe === undefined) return
  const request = session.requestLightProbe.bind(session)
  session.requestLightProbe = (options) =>
    new Promise((resolve) => {
      request(options).then(resolve, () => undefined)
    })
}

/** Run at 72 Hz if the device offers it: each picture then has 13.9 ms. */
async function settle(session: XRSession): Promise<void> {
  const { supportedFrameRates } = session
  if (supportedFrameRates === undefined || ![...supportedFrameRates].includes(FRAME_RATE)) return
  try {
    await session.updateTargetFrameRate(FRAME_RATE)
  } catch {
    // The device keeps its own rate.
  }
}
