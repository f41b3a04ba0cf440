import { type FileFormat, fileUrl } from '../../api/api'
import type { TrajectoryInfo } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Menu } from '../../design/menu'
import { session } from '../../shell/session'
import { words } from '../../words/words'
import { removeWithUndo, setShared } from './actions'
import { type Catalogue, shortName } from './catalogue'

const FORMATS = [
  ['mat', 'MATLAB (.mat)'],
  ['csv', 'CSV'],
  ['json', 'JSON'],
] as const satisfies readonly (readonly [FileFormat, string])[]

/** Return whether the person may change it: one's own; an instructor all. */
export function mayChange(info: TrajectoryInfo): boolean {
  const user = session.value?.user
  if (!user || user.role === 'display') return false
  return info.owner === user.id || user.role === 'instructor'
}

export function Downloads({ id }: { id: string }) {
  return (
    <>
      {FORMATS.map(([format, text]) => (
        <ButtonLink key={format} look="quiet" icon="download" href={fileUrl(id, format)} download>
          {text}
        </ButtonLink>
      ))}
    </>
  )
}

interface MenuProps {
  catalogue: Catalogue
  info: TrajectoryInfo
  onRemoved?: () => void
}

/** The actions on a trajectory. */
export function TrajectoryMenu({ catalogue, info, onRemoved }: MenuProps) {
  const w = words.value.trajectories
  return (
    <Menu label={w.actions(shortName(info.id))} icon="more" look="quiet">
      <Downloads id={info.id} />
      {mayChange(info) && info.owner !== '' && (
        <Button
          look="quiet"
          icon={info.shared ? 'person' : 'people'}
          onClick={() => void setShared(catalogue, info, !info.shared)}
        >
          {info.shared ? w.unshare : w.share}
        </Button>
      )}
      {mayChange(info) && (
        <Button
          look="quiet"
          icon="trash"
          onClick={() => {
            void removeWithUndo(catalogue, info.id).then((removed) => {
              if (removed) onRemoved?.()
            })
          }}
        >
          {w.delete}
        </Button>
      )}
    </Menu>
  )
}
