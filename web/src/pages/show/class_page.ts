/** The page of a graded class: rows are sorted, searched and filtered; sentences put into German.
 * `mrlab_ros/core/show/class_body.py` writes what is there without a script. */

export interface ClassData {
  readonly schema: 'mrlab.class.1'
  /** Keys of the students whose motions are nearly the same as another one. */
  readonly alike: readonly string[]
}

export type Shown = '' | 'lost' | 'unchecked' | 'late' | 'alike'

/** What decides whether a row is shown. */
export interface RowFacts {
  readonly name: string
  readonly lost: boolean
  readonly checked: boolean
  readonly late: boolean
  readonly alike: boolean
}

export function isClass(document: { readonly schema: string }): document is ClassData {
  return document.schema === 'mrlab.class.1'
}

/** Return whether a row is shown for a text that is searched and a filter. */
export function isShown(row: RowFacts, text: string, filter: Shown): boolean {
  if (text !== '' && !row.name.includes(text)) return false
  if (filter === 'lost') return row.lost
  if (filter === 'unchecked') return !row.checked
  if (filter === 'late') return row.late
  return filter === '' || row.alike
}

/** Return the order of rows by the values of a column; equal ones keep theirs. */
export function order(values: readonly (string | number)[], descending: boolean): number[] {
  const collator = new Intl.Collator(undefined, { numeric: true })
  const sign = descending ? -1 : 1
  return values
    .map((_, index) => index)
    .sort((a, b) => {
      const one = values[a] ?? ''
      const other = values[b] ?? ''
      const compared =
        typeof one === 'number' && typeof other === 'number'
          ? one - other
          : collator.compare(String(one), String(other))
      return sign * compared || a - b
    })
}

/** Put the sentences of a page into German. */
export function putIntoGerman(page: HTMLElement): void {
  document.documentElement.lang = 'de'
  for (const place of page.querySelectorAll<HTMLElement>('[data-de]')) {
    place.textContent = place.dataset.de ?? place.textContent
  }
}

export function showClass(data: ClassData): void {
  const german = navigator.language.startsWith('de')
  if (german) putIntoGerman(document.body)
  const body = document.querySelector<HTMLTableSectionElement>('.students tbody')
  const search = document.querySelector<HTMLInputElement>('#search')
  const filter = document.querySelector<HTMLSelectElement>('#filter')
  const shown = document.querySelector<HTMLElement>('#shown')
  if (body === null || search === null || filter === null || shown === null) return
  const rows = [...body.rows]
  const alike = new Set(data.alike)
  const facts = rows.map((row) => factsOf(row, alike))

  const choose = (): void => {
    const text = search.value.trim().toLowerCase()
    let count = 0
    rows.forEach((row, index) => {
      const fact = facts[index]
      row.hidden = fact === undefined || !isShown(fact, text, filter.value as Shown)
      if (!row.hidden) count += 1
    })
    shown.textContent = `${count} ${german ? 'von' : 'of'} ${rows.length}`
  }
  search.addEventListener('input', choose)
  filter.addEventListener('change', choose)
  choose()

  for (const button of document.querySelectorAll<HTMLButtonElement>('[data-sort]')) {
    button.addEventListener('click', () => {
      sortBy(button, body, rows)
    })
  }
  document.addEventListener('keydown', (event) => {
    if (event.key !== '/' || event.target instanceof HTMLInputElement) return
    event.preventDefault()
    search.focus()
  })
}

function factsOf(row: HTMLTableRowElement, alike: ReadonlySet<string>): RowFacts {
  return {
    name: (row.cells[0]?.textContent ?? '').toLowerCase(),
    lost: row.querySelector('.mark:not(.passed)') !== null,
    checked: row.dataset.outcome === 'marked',
    late: 'late' in row.dataset,
    alike: alike.has(row.dataset.key ?? ''),
  }
}

/** Sort by a column: names from A, points from the most; once more turns it round. */
function sortBy(button: HTMLButtonElement, body: HTMLElement, rows: HTMLTableRowElement[]): void {
  const head = button.closest('th')
  const column = button.dataset.sort ?? 'name'
  if (head === null) return
  const before = head.getAttribute('aria-sort')
  const first = column === 'name' ? 'ascending' : 'descending'
  const second = first === 'ascending' ? 'descending' : 'ascending'
  const next = before === first ? second : first
  for (const each of head.parentElement?.children ?? []) {
    if (each.hasAttribute('aria-sort')) each.setAttribute('aria-sort', 'none')
  }
  head.setAttribute('aria-sort', next)
  const values = rows.map((row) => sortedBy(row, column))
  for (const index of order(values, next === 'descending')) {
    const row = rows[index]
    if (row !== undefined) body.append(row)
  }
}

function sortedBy(row: HTMLTableRowElement, column: string): string | number {
  if (column === 'name') return row.dataset.name ?? ''
  if (column === 'points') return Number(row.dataset.points)
  const cell = row.querySelector(`[data-${column}]`)
  return Number(cell?.getAttribute(`data-${column}`) ?? 0)
}
