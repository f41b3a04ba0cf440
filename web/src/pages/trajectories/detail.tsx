import { useSignal } from '@preact/signals'
import { useEffect, useState } from 'preact/hooks'
import { trajectoryUrl } from '../../api/api'
import type { TrajectoryInfo } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Icon } from '../../design/icons'
import { Menu } from '../../design/menu'
import { Notice } from '../../design/notice'
import type { MotionDocument } from '../../playback/motion'
import { navigate, search } from '../../shell/router'
import { session, useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { dateTime, named, number, words } from '../../words/words'
import { Findings } from '../motion/findings'
import { LinkWithCode, MotionView } from '../motion/lazy'
import { type Catalogue, shortName, trajectoryPage } from './catalogue'
import { Comparison } from './comparison'
import { audience, ownerName } from './list'
import { Downloads, mayChange, TrajectoryMenu } from './menu'
import { Versions } from './versions'
import '../motion/verdict.css'

interface DetailProps {
  catalogue: Catalogue
  id: string
}

/** Load the motion of a trajectory; null: none is requested, or it is not yet loaded. */
function useMotion(id: string): [MotionDocument | null, string] {
  const api = useApi()
  const [motion, setMotion] = useState<MotionDocument | null>(null)
  const [error, setError] = useState('')
  useEffect(() => {
    setMotion(null)
    setError('')
    if (id === '') return
    const loading = new AbortController()
    api
      .motion(trajectoryUrl(id, 'motion'), loading.signal)
      .then((loaded) => !loading.signal.aborted && setMotion(loaded))
      .catch((problem: unknown) => !loading.signal.aborted && setError(sentence(problem)))
    return () => loading.abort()
  }, [id, api])
  return [motion, error]
}

function Facts({ info, catalogue }: { info: TrajectoryInfo; catalogue: Catalogue }) {
  const w = words.value.trajectories
  const { robot_model, end_effector } = info
  const robot = catalogue.robots.value.find(({ model }) => model === robot_model)
  const rows = [
    [
      w.robot,
      [robot?.name ?? robot_model, end_effector && named(end_effector)]
        .filter(Boolean)
        .join(' + '),
    ],
    [w.length, w.lengthOf(number(info.duration, 2), info.frame_count, number(info.frame_rate, 2))],
    [w.source, [info.source_file, info.source_variable].filter(Boolean).join(', ')],
    [w.created, dateTime(info.created)],
  ] as const
  return (
    <dl class="facts">
      {rows.map(([name, value]) => (
        <div key={name}>
          <dt class="second small">{name}</dt>
          <dd>{value}</dd>
        </div>
      ))}
    </dl>
  )
}

export function TrajectoryDetail({ catalogue, id }: DetailProps) {
  const w = words.value.trajectories
  const selected = useSignal(0)
  const other = new URLSearchParams(search.value).get('with') ?? ''
  const [motion, error] = useMotion(id)
  const [otherMotion, otherError] = useMotion(other)
  const all = catalogue.all.value
  const info = all?.find((each) => each.id === id)
  if (all !== null && !info)
    return (
      <section class="stack">
        <Notice severity="error">
          <p>{w.gone(id)}</p>
          <ButtonLink href="/trajectories">{w.toAll}</ButtonLink>
        </Notice>
      </section>
    )
  const user = session.value?.user?.id ?? ''
  return (
    <article class="verdict">
      <header class="verdict-head">
        <div class="grow stack-8">
          <a class="crumb small" href="/trajectories">
            <Icon name="back" />
            {w.title}
          </a>
          <h1 class="verdict-message">{shortName(id)}</h1>
          {info && (
            <p class="row small second">
              <span class="chip chip-plain">
                <Icon name={info.shared ? 'people' : 'person'} />
                {ownerName(info, user)}, {audience(info, user)}
              </span>
              <span class="chip chip-plain">{w.version(info.version)}</span>
            </p>
          )}
        </div>
        {info && (
          <div class="row verdict-actions">
            <Menu label={w.download} icon="download" text={w.download}>
              <Downloads id={id} />
            </Menu>
            <TrajectoryMenu
              catalogue={catalogue}
              info={info}
              onRemoved={() => navigate('/trajectories')}
            />
          </div>
        )}
      </header>
      {(error || otherError || catalogue.error.value) && (
        <Notice severity="error">
          <p>{error || otherError || catalogue.error.value}</p>
        </Notice>
      )}
      <div class="verdict-columns">
        <div class="verdict-side stack">
          {motion && other && otherMotion && (
            <Comparison
              id={id}
              other={other}
              motion={motion}
              otherMotion={otherMotion}
              onClose={() => navigate(trajectoryPage(id))}
            />
          )}
          {info && (
            <section class="card stack">
              <Facts info={info} catalogue={catalogue} />
              {info.owner !== '' && !info.shared && mayChange(info) && (
                <Button
                  icon="people"
                  onClick={() => void catalogue.share(id, true).catch(() => catalogue.load())}
                >
                  {w.share}
                </Button>
              )}
            </section>
          )}
          {info && info.warnings.length > 0 && (
            <Findings
              findings={info.warnings}
              joints={motion?.robot.joints}
              selected={selected.value}
              onSelect={(number) => {
                selected.value = number
              }}
            />
          )}
          {info && <Versions catalogue={catalogue} info={info} compared={other} />}
          <details class="card trajectory-code">
            <summary>{w.link}</summary>
            <LinkWithCode path={trajectoryPage(id)} />
          </details>
        </div>
        {motion && (other === '' || otherMotion || otherError) ? (
          <MotionView
            key={`${id} ${other} ${info?.version}`}
            motion={motion}
            compared={otherMotion}
            selected={selected}
          />
        ) : (
          <div class="motion-view motion-waiting second">{!error && words.value.loading}</div>
        )}
      </div>
    </article>
  )
}
