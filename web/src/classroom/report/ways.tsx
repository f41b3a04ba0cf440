import { createContext } from 'preact'
import { useContext } from 'preact/hooks'
import { type Scale, scaleOf, Thumbnail } from '../../report/plot/thumbnail'
import type { Way } from '../../report/plot/way'
import { words } from '../../words/words'
import type { ClassResult } from '../class_document'

/** The ways of the class by key, their scale, and the solution's. */
export const Drawn = createContext<{
  readonly ways: ReadonlyMap<string, Way>
  readonly scale: Scale
  readonly reference: Way
}>({ ways: new Map(), scale: scaleOf([]), reference: [] })

/** What leads to a page where there is one. */
export function Linked({
  to,
  children,
}: {
  to: string | null
  children: preact.ComponentChildren
}) {
  return to === null ? <span>{children}</span> : <a href={to}>{children}</a>
}

/** The way of a result beside that of another, of the solution where none is named. */
export function Picture({
  result,
  spots = true,
  beside,
}: {
  result: ClassResult
  spots?: boolean
  /** Key of the other. */
  beside?: string | undefined
}) {
  const { ways, scale, reference } = useContext(Drawn)
  const { key, marks, duration, page } = result
  const way = ways.get(key) ?? []
  if (way.length === 0) return null
  const lost = marks.flatMap(({ time, passed }) =>
    spots && time !== null && !passed && duration ? [time / duration] : [],
  )
  return (
    <Linked to={page}>
      <Thumbnail
        way={way}
        reference={(beside !== undefined && ways.get(beside)) || reference}
        scale={scale}
        lost={lost}
      />
      <span class="spoken">{words.value.report.class.motion}</span>
    </Linked>
  )
}
