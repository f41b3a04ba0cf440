import type { ComponentChildren } from 'preact'
import { useEffect, useRef, useState } from 'preact/hooks'
import { Button } from './button'
import type { IconName } from './icons'

/** Close a menu on Escape and on a click beside it. */
export function useOutside(open: boolean, close: () => void) {
  const menu = useRef<HTMLDivElement>(null)
  useEffect(() => {
    if (!open) return
    const onKey = (event: KeyboardEvent) => {
      if (event.key !== 'Escape') return
      close()
      menu.current?.querySelector('button')?.focus()
    }
    const onPress = (event: Event) => {
      if (!menu.current?.contains(event.target as Node)) close()
    }
    document.addEventListener('keydown', onKey)
    document.addEventListener('pointerdown', onPress)
    return () => {
      document.removeEventListener('keydown', onKey)
      document.removeEventListener('pointerdown', onPress)
    }
  }, [open, close])
  return menu
}

interface MenuProps {
  label: string
  icon: IconName
  /** Shown beside the icon; absent: the icon alone. */
  text?: string
  look?: 'plain' | 'quiet'
  /** Buttons and links; a click on one closes the menu. */
  children: ComponentChildren
}

/** Return the items of a menu that the arrow keys move along. */
function itemsOf(menu: HTMLElement | null): HTMLElement[] {
  return [...(menu?.querySelectorAll<HTMLElement>('.menu-list :is(a, button)') ?? [])]
}

/** Return the item that a key leads to from the one at `at`, -1: none; undefined: no such key. */
export function itemOf(key: string, at: number, count: number): number | undefined {
  if (key === 'ArrowDown') return (at + 1) % count
  if (key === 'ArrowUp') return (Math.max(at, 0) + count - 1) % count
  if (key === 'Home') return 0
  if (key === 'End') return count - 1
  return undefined
}

/** A button that opens a list of buttons and links. */
export function Menu({ label, icon, text, look = 'plain', children }: MenuProps) {
  const [open, setOpen] = useState(false)
  const menu = useOutside(open, () => setOpen(false))
  const byKey = useRef(false)
  useEffect(() => {
    if (open && byKey.current) itemsOf(menu.current)[0]?.focus()
  }, [open])
  const onKey = (event: KeyboardEvent) => {
    if (!open) {
      if (event.key !== 'ArrowDown') return
      byKey.current = true
      setOpen(true)
    } else {
      const items = itemsOf(menu.current)
      const at = items.indexOf(document.activeElement as HTMLElement)
      const next = itemOf(event.key, at, items.length)
      if (next === undefined) return
      items[next]?.focus()
    }
    event.preventDefault()
  }
  const onChosen = () => {
    // The element with the focus disappears with the list.
    if (menu.current?.querySelector('.menu-list')?.contains(document.activeElement))
      menu.current.querySelector('button')?.focus()
    setOpen(false)
  }
  return (
    // biome-ignore lint/a11y: its buttons and links are reached and pressed by themselves
    <div class="menu" ref={menu} onKeyDown={onKey}>
      <Button
        look={look}
        icon={icon}
        label={label}
        aria-expanded={open}
        aria-haspopup="true"
        onClick={(event) => {
          // a press of Enter or Space is a click without a pointer
          byKey.current = event.detail === 0
          setOpen(!open)
        }}
      >
        {text}
      </Button>
      {open && (
        // biome-ignore lint/a11y: its buttons and links are reached and pressed by themselves
        <div class="menu-list" onClick={onChosen}>
          {children}
        </div>
      )}
    </div>
  )
}
