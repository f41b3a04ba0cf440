import { effect } from '@preact/signals'
import type { ComponentChildren } from 'preact'
import { words } from '../words/words'
import { printing } from './fold'
import { Hatch } from './plot/strip_plot'

interface PageProps {
  readonly chip?: ComponentChildren
  /** The verdict, or the name of the report. */
  readonly title: string
  /** Parts of the line below it; empty ones are left out. */
  readonly facts: readonly ComponentChildren[]
  readonly notes?: ComponentChildren
  /** Parts of the last line. */
  readonly foot: readonly ComponentChildren[]
  /** It is printed on one sheet. */
  readonly sheet?: boolean
  readonly children: ComponentChildren
}

/** Join the present parts with dots. */
export function dotted(parts: readonly ComponentChildren[]): ComponentChildren[] {
  return parts.filter(Boolean).flatMap((part, i) => (i > 0 ? [' · ', part] : [part]))
}

/** A report: its head, its content, its foot. */
export function Page({ chip, title, facts, notes, foot, sheet, children }: PageProps) {
  document.title = title
  return (
    <>
      <Hatch />
      <header class="report-head">
        {chip && <p class="row">{chip}</p>}
        <h1>{title}</h1>
        <p class="facts">{dotted(facts)}</p>
        {notes}
      </header>
      <main class={`report-main${sheet ? ' report-sheet' : ''}`}>{children}</main>
      <footer class="report-foot">{dotted([...foot, words.value.report.madeBy])}</footer>
    </>
  )
}

/** Print the whole page, dark on white. Return a function that ends it. */
export function followPrinting(): () => void {
  const begin = () => {
    printing.value = true
  }
  const end = () => {
    printing.value = false
  }
  addEventListener('beforeprint', begin)
  addEventListener('afterprint', end)
  const light = effect(() => {
    if (printing.value) document.documentElement.dataset.theme = 'light'
    else delete document.documentElement.dataset.theme
  })
  return () => {
    removeEventListener('beforeprint', begin)
    removeEventListener('afterprint', end)
    light()
  }
}
