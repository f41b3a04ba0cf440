import type { WebGLRenderer } from 'three'
import { EXTRA, type Feature, type Mode, missingOf, REQUIRED, WANTED } from './features'

const FRAME_RATE = 72

/** A session that runs: what it got, and how it ends. */
export interface RoomSession {
  readonly session: XRSession
  readonly mode: Mode
  readonly missing: readonly Feature[]
}

/** Enter. Must be called by a person's tap. Rejects as `navigator.xr.requestSession` does. */
export async function enter(
  renderer: WebGLRenderer,
  mode: Mode,
  onEnd: () => void,
): Promise<RoomSession> {
  const { xr } = navigator
  if (xr === undefined) throw new DOMException('this browser has no WebXR', 'NotSupportedError')
  const session = await xr.requestSession(mode, {
    requiredFeatures: [...REQUIRED],
    optionalFeatures: [...WANTED, ...EXTRA],
  })
  session.addEventListener('end', onEnd, { once: true })
  await renderer.xr.setSession(session)
  await settle(session)
  return { session, mode, missing: missingOf(session.enabledFeatures) }
}

/** Run at 72 Hz where the device offers that: each picture then has 13.9 ms. */
async function settle(session: XRSession): Promise<void> {
  const { supportedFrameRates } = session
  if (supportedFrameRates === undefined || ![...supportedFrameRates].includes(FRAME_RATE)) return
  try {
    await session.updateTargetFrameRate(FRAME_RATE)
  } catch {
    // the device keeps its own
  }
}
