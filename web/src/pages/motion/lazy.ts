import { lazy } from '../../shell/lazy'

/** Plots and 3D are fetched when there is a motion to show. */
export const MotionView = lazy(async () => (await import('./motion_view')).MotionView)

export const LinkWithCode = lazy(async () => (await import('./link_with_code')).LinkWithCode)

export const QrCode = lazy(async () => (await import('./link_with_code')).QrCode)
