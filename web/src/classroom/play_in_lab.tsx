import { useEffect, useMemo, useState } from 'preact/hooks'
import type { Submission } from '../api/types'
import { Button, ButtonLink } from '../design/button'
import { LabCatalogue } from '../lab/catalogue'
import { order } from '../lab/commands'
import { useLink } from '../link/use_link'
import { loadTrajectoryType, type Robot, robotsReader } from '../protocol/mrlab_msgs'
import { useApi } from '../shell/session'
import { sentence } from '../words/diagnostic'
import { words } from '../words/words'
import { publishedName } from './class_steps'

/** Load a submission on a robot of the lab, by the services that every upload takes. */
export function PlayInLab({ submission }: { readonly submission: Submission }) {
  const [open, setOpen] = useState(false)
  return open ? (
    <Chooser submission={submission} />
  ) : (
    <Button icon="play" onClick={() => setOpen(true)}>
      {words.value.grades.play}
    </Button>
  )
}

function Chooser({ submission }: { readonly submission: Submission }) {
  const api = useApi()
  const link = useLink().value
  const catalogue = useMemo(() => new LabCatalogue(api), [api])
  const [robots, setRobots] = useState<readonly Robot[] | null>(null)
  const [busy, setBusy] = useState(false)
  const [loaded, setLoaded] = useState('')
  const [error, setError] = useState('')
  const w = words.value.grades
  const { key, robot: model, tool } = submission
  useEffect(
    () => link?.subscribe('robots', robotsReader, (message) => setRobots(message.robots)),
    [link],
  )
  const load = async (robot: string) => {
    if (link === null) return
    setBusy(true)
    setError('')
    try {
      const id = await catalogue.take(await api.classFile(key), model, publishedName(key), tool)
      const lab = { link, say: setError }
      if (await order(lab, `${robot}/load`, loadTrajectoryType, { id })) setLoaded(robot)
    } catch (problem) {
      setError(sentence(problem))
    } finally {
      setBusy(false)
    }
  }
  const fit = (robots ?? []).filter((robot) => robot.model === model)
  return (
    <fieldset class="stack-8">
      <legend class="spoken">{w.play}</legend>
      {robots === null && <p class="second small">{words.value.loading}</p>}
      {robots !== null && fit.length === 0 && <p class="small">{w.noRobot(model)}</p>}
      {fit.length > 0 && (
        <div class="row">
          <span class="small">{w.onRobot}</span>
          {fit.map(({ name }) => (
            <Button key={name} icon="robot" disabled={busy} onClick={() => void load(name)}>
              {name}
            </Button>
          ))}
        </div>
      )}
      {loaded && (
        <p class="row small" role="status">
          {w.loaded(loaded)}
          <ButtonLink href="/lab">{w.toLab}</ButtonLink>
        </p>
      )}
      {error && <p class="field-error">{error}</p>}
    </fieldset>
  )
}
