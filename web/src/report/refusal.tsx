import { useEffect } from 'preact/hooks'
import { OutcomeChip } from '../design/chip'
import type { Diagnostic } from '../words/diagnostic'
import { say } from '../words/diagnostic'
import { words } from '../words/words'
import { Findings, rowsOf } from './findings'
import { type CheckMarks, Marks } from './marks'
import { Page } from './page'

/** A file in which no motion was found; `mrlab_ros/app/show/refusal.py` writes it. */
export interface RefusalDocument {
  readonly schema: 'mrlab.refusal.1'
  readonly title: string
  /** The reason first. */
  readonly findings: readonly Diagnostic[]
  readonly marks: CheckMarks
}

/** The report of what could not be shown: why, and the marks all the same. */
export function RefusalReport({ refusal }: { refusal: RefusalDocument }) {
  const { title, findings, marks } = refusal
  const cause = findings.find(({ severity }) => severity === 'error') ?? findings[0]
  useEffect(() => {
    document.documentElement.dataset.ready = 'true'
  }, [])
  return (
    <Page
      sheet
      chip={<OutcomeChip outcome="rejected" />}
      title={cause ? say(cause).message : title}
      facts={[title]}
      foot={[]}
    >
      <Findings
        title={words.value.upload.findings(findings.length)}
        findings={findings}
        where={(one) => [one.variable, one.joint, rowsOf(one)].filter(Boolean).join(' · ')}
        placed={() => false}
        onShow={() => {}}
      />
      <Marks marks={marks} />
    </Page>
  )
}
