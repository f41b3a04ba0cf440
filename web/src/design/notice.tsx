import type { ComponentChildren } from 'preact'
import { Icon } from './icons'

interface NoticeProps {
  severity: 'info' | 'warning' | 'error'
  children: ComponentChildren
}

export function Notice({ severity, children }: NoticeProps) {
  return (
    <div
      class={`notice notice-${severity}`}
      role={severity === 'error' ? 'alert' : undefined}
      data-severity={severity}
    >
      <Icon name={severity} />
      <div class="grow">{children}</div>
    </div>
  )
}
