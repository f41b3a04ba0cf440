import { useSignal } from '@preact/signals'
import { useEffect, useMemo, useRef } from 'preact/hooks'
import './lab.css'
import { Button } from '../../design/button'
import { StateChip } from '../../design/chip'
import { theme } from '../../design/theme'
import type { StateName } from '../../design/tokens'
import type { Link } from '../../link/link'
import { words } from '../../words/words'
import { commandsOf, trigger } from './commands'
import { LabFollower } from './follow'
import { KeyTable } from './key_table'
import { ReplayCard } from './replay_card'
import { RobotCard } from './robot_card'
import { SystemCard } from './system_card'
import type { LabView } from './view'

/** The running lab: its scene, its robots and systems. link: opened by who shows the page. */
export function Lab({ link }: { link: Link }) {
  const host = useRef<HTMLDivElement>(null)
  const view = useRef<LabView | null>(null)
  const projected = useSignal(false)
  const keys = useSignal(false)
  const trouble = useSignal('')
  const follower = useMemo(
    () =>
      new LabFollower(
        link,
        (name) => commandsOf(link, name),
        (state: StateName) => words.value.states[state],
        (state: StateName) => theme.value.states[state],
        () => view.current?.stir(),
      ),
    [link],
  )
  useEffect(() => {
    let here = true
    import('./view')
      .then(({ LabView }) => {
        if (!here || host.current === null) return
        view.current = new LabView(host.current, words.value.lab.picture, (text) => {
          trouble.value = text
        })
        follower.attach(view.current.scene)
      })
      .catch((error: unknown) => {
        trouble.value =
          error instanceof Error && error.name === 'NoWebGL'
            ? words.value.lab.noWebGL
            : String(error)
      })
    return () => {
      here = false
      follower.dispose()
      view.current?.dispose()
      view.current = null
    }
  }, [follower])

  const w = words.value.lab
  const robots = follower.robots.value
  const { phase, reason, roundTrip } = follower.status.value
  const moving = robots.filter((one) => one.state === 'PLAYING' || one.state === 'ADJUSTING')
  const pauseAll = () => {
    const names = new Set(moving.map((one) => one.playback?.system || one.robot.name))
    for (const name of names) trigger(link, `${name}/pause`)
  }
  const project = () => {
    projected.value = !projected.value
    view.current?.setProjected(projected.value)
  }
  return (
    <div class={`lab${projected.value ? ' lab-projected' : ''}`}>
      <section class="lab-scene" aria-label={w.scene}>
        <div class="lab-view" ref={host} />
        <div class="lab-bar">
          <Button look="primary" icon="pause" disabled={moving.length === 0} onClick={pauseAll}>
            {w.pauseAll}
          </Button>
          <Button onClick={() => view.current?.scene.frame(true)}>{w.showAll}</Button>
          <Button aria-pressed={projected.value} onClick={project}>
            {w.project}
          </Button>
          <Button
            aria-pressed={keys.value}
            onClick={() => {
              keys.value = !keys.value
            }}
          >
            {w.keys}
          </Button>
          <span class="lab-link small" role="status">
            {phase === 'open'
              ? Number.isNaN(roundTrip)
                ? w.connected
                : w.roundTrip((roundTrip * 1000).toFixed(roundTrip < 0.01 ? 1 : 0))
              : `${w.phases[phase]}${reason ? `: ${reason}` : ''}`}
          </span>
        </div>
        {trouble.value && (
          <p class="lab-note small" role="status">
            {trouble.value}
          </p>
        )}
        {follower.known.value && robots.length === 0 && (
          <div class="lab-empty">
            <p>{w.empty}</p>
            <code>
              ros2 service call /lab/spawn_robot mrlab_msgs/srv/SpawnRobot "&#123;model:
              ur5e&#125;"
            </code>
          </div>
        )}
        {projected.value && (
          <ul class="lab-names">
            {robots.map((one) => (
              <li key={one.robot.name}>
                <b>{one.robot.name}</b> <StateChip state={one.state} />
              </li>
            ))}
          </ul>
        )}
        {keys.value && <KeyTable follower={follower} />}
      </section>
      {!projected.value && (
        <aside class="lab-panel" aria-label={w.panel}>
          {follower.systems.value.map((each) => (
            <SystemCard key={each.system.name} view={each} />
          ))}
          {robots.map((each) => (
            <RobotCard key={each.robot.name} view={each} link={link} />
          ))}
          <ReplayCard follower={follower} />
        </aside>
      )}
    </div>
  )
}

/** The lab that this gateway serves, or in `--mode fake` a made-up one. */
export function LabPage() {
  const link = useSignal<Link | null>(null)
  useEffect(() => {
    let open: Link | null = null
    let here = true
    const opening =
      import.meta.env.MODE === 'fake'
        ? import('../../../test/fake_lab').then(({ fakeLab }) => fakeLab())
        : import('../../link/socket').then(({ openLink }) => openLink())
    opening.then((found) => {
      open = found
      if (here) link.value = found
      else found.close()
    })
    return () => {
      here = false
      open?.close()
    }
  }, [])
  return link.value && <Lab link={link.value} />
}
