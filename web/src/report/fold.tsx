import { signal } from '@preact/signals'
import type { ComponentChildren } from 'preact'
import { useState } from 'preact/hooks'

/** On while the page is printed: nothing is folded on paper. */
export const printing = signal(false)

interface FoldProps {
  readonly title: string
  readonly facts?: ComponentChildren
  readonly open?: boolean
  readonly children: ComponentChildren
}

/** A part of the report that can be folded; its content is made when it is first opened. */
export function Fold({ title, facts, open = false, children }: FoldProps) {
  const [opened, setOpened] = useState(open)
  const shown = opened || printing.value
  return (
    <details
      class="card report-fold"
      open={shown}
      onToggle={(event) => {
        if (!printing.value) setOpened(event.currentTarget.open)
      }}
    >
      <summary>
        <h2>{title}</h2> {facts && <span class="second small">{facts}</span>}
      </summary>
      {shown && children}
    </details>
  )
}
