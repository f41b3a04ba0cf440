/** Features that a session requires, and features that it requests. */
export const REQUIRED = ['local-floor'] as const
export const WANTED = ['hand-tracking', 'anchors', 'plane-detection', 'mesh-detection'] as const

/** Optional features that improve the picture. */
export const EXTRA = ['light-estimation'] as const
/** Requested in passthrough if robots are to be hidden behind real things. */
export const DEPTH = 'depth-sensing'

export type Feature = (typeof WANTED)[number] | typeof DEPTH
export type Mode = 'immersive-ar' | 'immersive-vr'

/** The reason for which this browser cannot enter the room; empty: it can. */
type Hindrance = '' | 'no_https' | 'no_webxr' | 'no_device' | 'blocked'

/** The parts of a browser that tell its abilities. */
interface XrPlatform {
  readonly secure: boolean
  readonly xr: { isSessionSupported(mode: Mode): Promise<boolean> } | undefined
}

export interface Ability {
  readonly mode: Mode | null
  readonly hindrance: Hindrance
}

/** Return the way into the room: passthrough if possible, else a virtual room. */
export async function abilityOf({ secure, xr }: XrPlatform): Promise<Ability> {
  if (!secure) return { mode: null, hindrance: 'no_https' }
  if (xr === undefined) return { mode: null, hindrance: 'no_webxr' }
  try {
    for (const mode of ['immersive-ar', 'immersive-vr'] as const) {
      if (await xr.isSessionSupported(mode)) return { mode, hindrance: '' }
    }
  } catch {
    // A permissions policy or the person refused.
    return { mode: null, hindrance: 'blocked' }
  }
  return { mode: null, hindrance: 'no_device' }
}

/** Return the wanted features that a session lacks; a session that lists none has all. depth:
 * depth was requested, too. */
export function missingOf(granted: readonly string[] | undefined, depth = false): Feature[] {
  if (granted === undefined) return []
  const wanted: readonly Feature[] = depth ? [...WANTED, DEPTH] : WANTED
  return wanted.filter((feature) => !granted.includes(feature))
}
