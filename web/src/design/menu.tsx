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

/** A button that opens a list of buttons and links. */
export function Menu({ label, icon, text, look = 'plain', children }: MenuProps) {
  const [open, setOpen] = useState(false)
  const menu = useOutside(open, () => setOpen(false))
  return (
    <div class="menu" ref={menu}>
      <Button
        look={look}
        icon={icon}
        label={label}
        aria-expanded={open}
        aria-haspopup="true"
        onClick={() => setOpen(!open)}
      >
        {text}
      </Button>
      {open && (
        // biome-ignore lint/a11y: its buttons and links are reached and pressed by themselves
        <div class="menu-list" onClick={() => setOpen(false)}>
          {children}
        </div>
      )}
    </div>
  )
}
