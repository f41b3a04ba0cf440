import { FLAT_REPORTS, type Reports } from './flat_reports'
import { type CheckDocument, CheckReport } from './report/check'
import { type MarkedMotion, MotionReport } from './report/motion'
import { type RecordedSession, SessionReport } from './report/session'

/** All reports. */
export const REPORTS: Reports = {
  ...FLAT_REPORTS,
  'mrlab.motion.1': ({ document, meshes }, pictures) => (
    <MotionReport motion={document as MarkedMotion} meshes={meshes} pictures={pictures} />
  ),
  'mrlab.session.1': ({ document, meshes }) => (
    <SessionReport session={document as RecordedSession} meshes={meshes} />
  ),
  'mrlab.check.1': ({ document, meshes }, pictures) => (
    <CheckReport session={document as CheckDocument} meshes={meshes} pictures={pictures} />
  ),
}
