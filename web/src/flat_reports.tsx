import type { ComponentChild } from 'preact'
import type { ClassDocument } from './classroom/class_document'
import { ClassReport } from './classroom/report/report'
import type { Picture } from './report/findings'
import type { ShownData } from './report/packed_data'
import { type RefusalDocument, RefusalReport } from './report/refusal'

/** Draws the data of a page; the pictures stood in the page before the script ran. */
type Report = (data: ShownData, pictures: readonly Picture[]) => ComponentChild

/** The report of each schema of a document. `mrlab_ros/app/show/` and `mrlab_ros/classroom/page.py`
 * write the documents. */
export type Reports = Readonly<Record<string, Report>>

/** Those without a 3D view, whose code is a third of the others'. */
export const FLAT_REPORTS: Reports = {
  'mrlab.refusal.1': ({ document }) => <RefusalReport refusal={document as RefusalDocument} />,
  'mrlab.class.1': ({ document }) => <ClassReport graded={document as ClassDocument} />,
}
