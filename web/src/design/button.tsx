import type { ComponentChildren, JSX } from 'preact'
import { Icon, type IconName } from './icons'

type Look = 'plain' | 'primary' | 'quiet' | 'danger'

interface Dress {
  look?: Look
  icon?: IconName
  /** Name for screen readers of a button with only an icon; also its tooltip. */
  label?: string
  children?: ComponentChildren
}

function className(look: Look, iconOnly: boolean, more: string): string {
  const icon = iconOnly ? ' button-icon' : ''
  return `button${look === 'plain' ? '' : ` button-${look}`}${icon}${more && ` ${more}`}`
}

/** A tooltip is a name too; both would be read one after the other. */
function named(iconOnly: boolean, label: string | undefined) {
  return iconOnly ? { title: label } : { 'aria-label': label }
}

type ButtonProps = Dress & Omit<JSX.IntrinsicElements['button'], 'label' | 'icon' | 'class'>

export function Button({ look = 'plain', icon, label, children, ...rest }: ButtonProps) {
  const iconOnly = children === undefined
  return (
    <button
      type="button"
      {...rest}
      class={className(look, iconOnly, '')}
      {...named(iconOnly, label)}
    >
      {icon && <Icon name={icon} />}
      {children}
    </button>
  )
}

type LinkProps = Dress & { href: string; download?: boolean | string }

export function ButtonLink({ look = 'plain', icon, label, children, href, download }: LinkProps) {
  const iconOnly = children === undefined
  return (
    <a
      href={href}
      download={download}
      class={className(look, iconOnly, '')}
      {...named(iconOnly, label)}
    >
      {icon && <Icon name={icon} />}
      {children}
    </a>
  )
}
