import { batch, signal } from '@preact/signals'

/** The path of the page that is shown, without search and hash. */
export const path = signal(location.pathname)
/** The query of the address, such as ?with=quintic; empty: none. */
export const search = signal(location.search)

function read(): void {
  batch(() => {
    path.value = location.pathname
    search.value = location.search
  })
}

export function navigate(to: string, how: 'push' | 'replace' = 'push'): void {
  if (to === location.pathname + location.search) return
  if (how === 'push') history.pushState(null, '', to)
  else history.replaceState(null, '', to)
  read()
  scrollTo(0, 0)
}

/** Follow links to our own pages without a reload; return a function that ends it. */
export function followLinks(): () => void {
  const onClick = (event: MouseEvent) => {
    if (event.defaultPrevented || event.button !== 0) return
    if (event.metaKey || event.ctrlKey || event.shiftKey || event.altKey) return
    const link = (event.target as Element).closest?.('a')
    if (!link || link.origin !== location.origin || link.target || link.hasAttribute('download'))
      return
    // A place on this page, and files that the gateway serves.
    if (link.hash || /^\/(api|assets|ca)(\/|$)/.test(link.pathname)) return
    event.preventDefault()
    navigate(link.pathname + link.search)
  }
  addEventListener('popstate', read)
  document.addEventListener('click', onClick)
  return () => {
    removeEventListener('popstate', read)
    document.removeEventListener('click', onClick)
  }
}
