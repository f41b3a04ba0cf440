import type { ComponentChildren } from 'preact'
import { useEffect, useRef, useState } from 'preact/hooks'

interface VirtualListProps<Item> {
  items: readonly Item[]
  keyOf: (item: Item) => string
  /** px; every row is as high. */
  rowHeight: number
  label: string
  render: (item: Item) => ComponentChildren
}

// Rows above and below the window that are drawn in advance.
const MARGIN_ROWS = 8

/** Return the first and the one after the last row to render, given where the list is, px. */
export function visibleRows(
  top: number,
  height: number,
  rowHeight: number,
  count: number,
): [number, number] {
  const first = Math.max(Math.floor(top / rowHeight) - MARGIN_ROWS, 0)
  const end = Math.min(Math.ceil((top + height) / rowHeight) + MARGIN_ROWS, count)
  return [Math.min(first, count), Math.max(end, 0)]
}

/** A list of which only the rows near the window exist; it scrolls with the page. */
export function VirtualList<Item>(props: VirtualListProps<Item>) {
  const { items, keyOf, rowHeight, label, render } = props
  const list = useRef<HTMLUListElement>(null)
  const [[first, end], setRows] = useState<[number, number]>([0, 40])
  useEffect(() => {
    const measure = () => {
      const top = -(list.current?.getBoundingClientRect().top ?? 0)
      const next = visibleRows(top, innerHeight, rowHeight, items.length)
      setRows((now) => (now[0] === next[0] && now[1] === next[1] ? now : next))
    }
    measure()
    addEventListener('scroll', measure, { passive: true })
    addEventListener('resize', measure)
    return () => {
      removeEventListener('scroll', measure)
      removeEventListener('resize', measure)
    }
  }, [items, rowHeight])
  return (
    <ul
      ref={list}
      class="virtual-list"
      aria-label={label}
      style={{
        paddingTop: `${first * rowHeight}px`,
        paddingBottom: `${Math.max(items.length - end, 0) * rowHeight}px`,
      }}
    >
      {items.slice(first, end).map((item, index) => (
        <li
          key={keyOf(item)}
          style={{ height: `${rowHeight}px` }}
          aria-setsize={items.length}
          aria-posinset={first + index + 1}
        >
          {render(item)}
        </li>
      ))}
    </ul>
  )
}
