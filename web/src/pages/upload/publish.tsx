import { useEffect, useRef, useState } from 'preact/hooks'
import type { TrajectoryInfo } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Check, Field } from '../../design/field'
import { Icon } from '../../design/icons'
import { session } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { words } from '../../words/words'
import { LinkWithCode } from '../motion/lazy'
import { trajectoryPage } from '../trajectories/catalogue'
import type { UploadFlow } from './flow'

interface PublishProps {
  flow: UploadFlow
  /** As the converter would name it. */
  trajectory: TrajectoryInfo
}

/** Give the motion a name and put it where the lab and the headset find it. */
export function Publish({ flow, trajectory }: PublishProps) {
  const [name, setName] = useState(trajectory.id.split('/').at(-1) ?? '')
  const [shared, setShared] = useState(false)
  const [error, setError] = useState('')
  const [busy, setBusy] = useState(false)
  const w = words.value.upload
  const done = flow.published.value
  const heading = useRef<HTMLHeadingElement>(null)
  // the button that was pressed is gone
  useEffect(() => heading.current?.focus(), [done])
  if (done)
    return (
      <section class="card stack publish-done">
        <h2 class="row" ref={heading} tabIndex={-1}>
          <Icon name="complete" />
          {w.publishedAs(done.id, done.version)}
        </h2>
        <LinkWithCode path={trajectoryPage(done.id)} />
        <div class="row">
          <ButtonLink look="primary" href="/lab" icon="robot">
            {w.toLab}
          </ButtonLink>
          <ButtonLink href={trajectoryPage(done.id)}>{w.toTrajectory}</ButtonLink>
        </div>
      </section>
    )
  const publish = async (event: Event) => {
    event.preventDefault()
    setBusy(true)
    setError('')
    try {
      await flow.publish(name.trim(), shared)
    } catch (problem) {
      setError(sentence(problem))
    } finally {
      setBusy(false)
    }
  }
  return (
    <form class="card stack publish" onSubmit={(event) => void publish(event)}>
      <h2>{w.publishTitle}</h2>
      <Field label={w.name} value={name} onInput={setName} error={error} required />
      {(session.value?.ways.password || session.value?.ways.oidc) && (
        <Check checked={shared} onChange={setShared}>
          {w.shareWithClass}
        </Check>
      )}
      <Button look="primary" type="submit" disabled={busy || name.trim() === ''}>
        {w.publish}
      </Button>
    </form>
  )
}
