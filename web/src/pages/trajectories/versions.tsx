import { useEffect, useState } from 'preact/hooks'
import type { TrajectoryInfo, Version } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { showToast } from '../../design/toast'
import { useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { dateTime, number, words } from '../../words/words'
import { type Catalogue, trajectoryPage } from './catalogue'
import { mayChange } from './menu'

interface VersionsProps {
  catalogue: Catalogue
  info: TrajectoryInfo
  /** Id that it is compared with; empty: none. */
  compared: string
}

/** Every version, newest first; an older one can be compared and brought back. */
export function Versions({ catalogue, info, compared }: VersionsProps) {
  const api = useApi()
  const [versions, setVersions] = useState<readonly Version[]>([])
  const w = words.value.trajectories
  useEffect(() => {
    let here = true
    api
      .versions(info.id)
      .then((answer) => here && setVersions(answer))
      .catch((error: unknown) => showToast(sentence(error)))
    return () => {
      here = false
    }
  }, [api, info.id, info.version])
  const restore = async (version: number) => {
    try {
      await catalogue.restore(info.id, version)
      showToast(w.restored(version))
    } catch (error) {
      showToast(sentence(error))
    }
  }
  if (versions.length < 2) return null
  return (
    <section class="card stack-8" aria-labelledby="versions">
      <h2 id="versions">{w.versions}</h2>
      <ol class="versions">
        {versions.map((each) => {
          const id = `${info.id}@${each.version}`
          return (
            <li key={each.version}>
              <div class="grow">
                <strong>{w.version(each.version)}</strong>
                <p class="second small">
                  {dateTime(each.created)} · {number(each.duration, 1)} s
                </p>
              </div>
              {each.version !== info.version && (
                <>
                  {compared !== id && (
                    <ButtonLink
                      look="quiet"
                      icon="compare"
                      label={w.compareVersion(each.version)}
                      href={trajectoryPage(info.id, id)}
                    />
                  )}
                  {mayChange(info) && (
                    <Button
                      look="quiet"
                      icon="undo"
                      label={w.restore(each.version)}
                      onClick={() => void restore(each.version)}
                    />
                  )}
                </>
              )}
            </li>
          )
        })}
      </ol>
    </section>
  )
}
