import type { ClassStudent } from '../class_document'

/** Filters of the rows of a class. */
export const FILTERS = ['', 'lost', 'unchecked', 'late', 'alike'] as const
export type Filter = (typeof FILTERS)[number]
/** Sort key of rows: the name, all points, or the points of a test by its place. */
export type Column = 'name' | 'points' | number

/** Return whether a row is shown for a text that is searched and a filter. */
export function isShown(
  row: ClassStudent,
  text: string,
  filter: Filter,
  alike: ReadonlySet<string>,
): boolean {
  const searched = `${row.name} ${row.identifier} ${row.file}`.toLowerCase()
  if (!searched.includes(text.trim().toLowerCase())) return false
  if (filter === 'lost') return row.marks.some(({ passed }) => !passed)
  if (filter === 'unchecked') return !row.marked
  if (filter === 'late') return row.late
  return filter === '' || alike.has(row.key)
}

/** Return rows in order of a column; equal ones keep theirs. */
export function sorted(
  rows: readonly ClassStudent[],
  column: Column,
  descending: boolean,
): ClassStudent[] {
  const collator = new Intl.Collator(undefined, { numeric: true })
  const pointsOf = (row: ClassStudent) =>
    column === 'points' ? row.points : (row.marks[column as number]?.points ?? 0)
  const sign = descending ? -1 : 1
  return [...rows].sort((a, b) =>
    column === 'name'
      ? sign * collator.compare(a.name, b.name)
      : sign * (pointsOf(a) - pointsOf(b)),
  )
}
