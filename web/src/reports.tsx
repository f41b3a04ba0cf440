import type { ComponentChild } from 'preact'
import type { ClassDocument } from './classroom/class_document'
import { ClassReport } from './classroom/report/report'
import { type CheckDocument, CheckReport } from './report/check'
import type { Picture } from './report/findings'
import { type MarkedMotion, MotionReport } from './report/motion'
import type { ShownData } from './report/packed_data'
import { type RefusalDocument, RefusalReport } from './report/refusal'
import { type RecordedSession, SessionReport } from './report/session'

/** Draws the data of a page; the pictures stood in the page before the script ran. */
export type Report = (data: ShownData, pictures: readonly Picture[]) => ComponentChild

/** The report of each schema of a document. `mrlab_ros/app/show/` and `mrlab_ros/classroom/page.py`
 * write the documents. */
export const REPORTS: Readonly<Record<string, Report>> = {
  'mrlab.motion.1': ({ document, meshes }, pictures) => (
    <MotionReport motion={document as MarkedMotion} meshes={meshes} pictures={pictures} />
  ),
  'mrlab.session.1': ({ document, meshes }) => (
    <SessionReport session={document as RecordedSession} meshes={meshes} />
  ),
  'mrlab.check.1': ({ document, meshes }, pictures) => (
    <CheckReport session={document as CheckDocument} meshes={meshes} pictures={pictures} />
  ),
  'mrlab.refusal.1': ({ document }) => <RefusalReport refusal={document as RefusalDocument} />,
  'mrlab.class.1': ({ document }) => <ClassReport graded={document as ClassDocument} />,
}
