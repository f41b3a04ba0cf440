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

type ButtonProps = Dress & Omit<JSX.IntrinsicElements['button'], 'label' | 'icon' | 'class'>

export function Button({ look = 'plain', icon, label, children, ...rest }: ButtonProps) {
  const iconOnly = children === undefined
  return (
    <button
      type="button"
      {...rest}
      class={className(look, iconOnly, '')}
      aria-label={label}
      title={iconOnly ? label : undefined}
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
      aria-label={label}
      title={iconOnly ? label : undefined}
    >
      {icon && <Icon name={icon} />}
      {children}
    </a>
  )
}
