import type { TrajectoryInfo } from '../../api/types'
import { showToast } from '../../design/toast'
import { sentence } from '../../words/diagnostic'
import { words } from '../../words/words'
import { type Catalogue, shortName } from './catalogue'

/** Delete at once and offer to undo it. */
export async function removeWithUndo(
  catalogue: Catalogue,
  id: string,
  onRestored: () => void = () => {},
): Promise<boolean> {
  const w = words.value
  try {
    await catalogue.remove(id)
  } catch (error) {
    showToast(sentence(error))
    return false
  }
  showToast(w.trajectories.deleted(shortName(id)), {
    label: w.undo,
    run: () => {
      catalogue
        .restore(id, 0)
        .then(onRestored)
        .catch((error: unknown) => showToast(sentence(error)))
    },
  })
  return true
}

/** Share it with everybody, or with nobody. */
export async function setShared(
  catalogue: Catalogue,
  info: TrajectoryInfo,
  shared: boolean,
): Promise<void> {
  const { id } = info
  const w = words.value.trajectories
  try {
    await catalogue.share(id, shared)
    const whose = info.owner === catalogue.user ? w.private : w.privateOf(info.owner)
    showToast(shared ? w.nowShared(shortName(id)) : w.nowPrivate(shortName(id), whose))
  } catch (error) {
    showToast(sentence(error))
  }
}
