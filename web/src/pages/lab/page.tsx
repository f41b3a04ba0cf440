import { effect, useSignal } from '@preact/signals'
import { useEffect, useMemo, useRef } from 'preact/hooks'
import { trajectoryUrl } from '../../api/api'
import type { Rights } from '../../api/types'
import { useLink } from '../../link/use_link'
import './lab.css'
import { Button } from '../../design/button'
import { StateChip } from '../../design/chip'
import { theme } from '../../design/theme'
import { showToast } from '../../design/toast'
import type { StateName } from '../../design/tokens'
import { LabCatalogue } from '../../lab/catalogue'
import { commandsOf, trigger } from '../../lab/commands'
import { LabFollower } from '../../lab/follower'
import { outageWords } from '../../lab/outages'
import type { Present } from '../../lab/people/people'
import type { Link } from '../../link/link'
import { courseOf } from '../../playback/course'
import { trajectoryCatalogueReader } from '../../protocol/mrlab_msgs'
import { checkSignIn, session, useApi } from '../../shell/session'
import { spoken } from '../../words/diagnostic'
import { fixed, named, words } from '../../words/words'
import { AddRobot } from './add_robot'
import { LabProvider } from './context'
import { Join } from './join'
import { PeopleCard } from './people_card'
import { ReplayCard } from './replay_card'
import { RobotCard } from './robot_card'
import { SystemCard } from './system_card'
import { Topics } from './topics'
import type { LabView } from './view'

/** s, of a round trip that is worth words. */
const SLOW_S = 0.1
const NOTHING: Rights = {
  commands: false,
  scene: false,
  replay: false,
  grades: false,
  hands_in: false,
}

const say = (text: string) => showToast(text)

/** The running lab: its scene, its robots and systems. link: opened and closed by the caller. */
export function Lab({ link }: { link: Link }) {
  const api = useApi()
  const host = useRef<HTMLDivElement>(null)
  const view = useRef<LabView | null>(null)
  const projected = useSignal(false)
  const keys = useSignal(false)
  const adding = useSignal(false)
  const joining = useSignal(false)
  const trouble = useSignal('')
  const present = useSignal<readonly Present[]>([])
  const seen = useSignal('')
  const pointing = useSignal(false)
  const follower = useMemo(
    () =>
      new LabFollower(link, {
        commands: (name) => commandsOf({ link, say }, name),
        word: (state: StateName) => words.value.states[state],
        colour: (state: StateName) => theme.value.states[state],
        stir: () => view.current?.stir(),
        courseOf: async (id) => courseOf(await api.motion(trajectoryUrl(id, 'motion'))),
      }),
    [link, api],
  )
  const given = session.value?.may ?? NOTHING
  const { replays } = follower
  const may = useMemo(
    () => (replays ? { ...given, commands: false, scene: false } : given),
    [given, replays],
  )
  const lab = useMemo(() => ({ link, may, replays, say }), [link, may, replays])
  const catalogue = useMemo(() => new LabCatalogue(api), [api])
  useEffect(() => {
    void catalogue.load()
    // others publish while this page is open
    return link.subscribe('trajectories', trajectoryCatalogueReader, () => void catalogue.load())
  }, [link, catalogue])
  useEffect(() => {
    let here = true
    let unfollow = () => {}
    import('./view')
      .then(({ LabView }) => {
        if (!here || host.current === null) return
        view.current = new LabView(
          host.current,
          link,
          {
            trouble: (text) => {
              trouble.value = text
            },
            people: (all, eyes) => {
              if (seen.value !== '' && eyes === '') leave(seen.value, all)
              present.value = all
              seen.value = eyes
            },
          },
          () => follower.pose(),
        )
        follower.attach(view.current.scene)
        unfollow = effect(() => view.current?.stand(follower.recorder.value))
      })
      .catch((error: unknown) => {
        const noWebGL = error instanceof Error && error.name === 'NoWebGL'
        trouble.value = noWebGL ? words.value.lab.noWebGL : words.value.noAnswer
        if (!noWebGL) console.error(error)
      })
    return () => {
      here = false
      unfollow()
      follower.dispose()
      view.current?.dispose()
      view.current = null
    }
  }, [follower])

  const leave = (id: string, all: readonly Present[]) => {
    const gone = present.value.find((each) => each.id === id)
    if (gone !== undefined && all.every((each) => each.id !== id))
      say(words.value.lab.hasLeft(named(gone.name)))
  }
  const point = (event: MouseEvent) => {
    if (!pointing.value) return
    pointing.value = false
    view.current?.point(event.clientX, event.clientY)
  }
  const undoable = follower.undoing.act.value
  const eyes = present.value.find(({ id }) => id === seen.value)

  const w = words.value.lab
  const robots = follower.robots.value
  const { phase, reason, roundTrip } = follower.status.value
  const lost = phase === 'lost' || phase === 'refused'
  useEffect(() => {
    if (phase === 'refused') void checkSignIn(api)
  }, [phase, api])
  const moving = robots.filter((one) => one.state === 'PLAYING' || one.state === 'ADJUSTING')
  const pauseAll = () => {
    const names = new Set(moving.map((one) => one.playback?.system || one.robot.name))
    for (const name of names) trigger(lab, `${name}/pause`)
  }
  const project = () => {
    projected.value = !projected.value
    view.current?.setProjected(projected.value)
  }
  const toggle = (what: typeof keys) => () => {
    what.value = !what.value
  }
  const open = phase === 'open'
  const status = open ? w.connected : `${w.phases[phase]}${reason ? `: ${reason}` : ''}`
  const measured =
    open && !Number.isNaN(roundTrip)
      ? w.roundTrip(fixed(roundTrip * 1000, roundTrip < 0.01 ? 1 : 0))
      : ''
  // a dot says it until it is slow
  const wordless = open && !(roundTrip > SLOW_S)
  return (
    <LabProvider value={lab}>
      <div class={`lab${projected.value ? ' lab-projected' : ''}`}>
        <h1 class="spoken">{words.value.nav.lab}</h1>
        <section class="lab-scene" aria-label={w.scene}>
          <div class="lab-bar">
            {may.commands && (
              <Button
                look={moving.length > 0 ? 'primary' : 'quiet'}
                icon="pause"
                disabled={lost || moving.length === 0}
                onClick={pauseAll}
              >
                <span class="lab-bar-word">{w.pauseAll}</span>
              </Button>
            )}
            <Button
              look="quiet"
              icon="fit"
              label={w.showAll}
              onClick={() => view.current?.scene.frame(true)}
            />
            {may.scene && (
              <Button
                look="quiet"
                icon="target"
                label={words.value.room.lookHere}
                aria-pressed={pointing.value}
                onClick={toggle(pointing)}
              />
            )}
            <Button
              look="quiet"
              icon="projector"
              label={w.project}
              aria-pressed={projected.value}
              onClick={project}
            />
            <Button look="quiet" icon="headset" label={w.join} onClick={toggle(joining)} />
            <Button
              look="quiet"
              icon="topics"
              label={w.keys}
              aria-pressed={keys.value}
              onClick={toggle(keys)}
            />
            <span class={`lab-link lab-link-${phase} small`} title={measured || status}>
              {wordless && <i class="lab-link-dot" />}
              <span class={open ? 'spoken' : ''} role="status">
                {status}
              </span>
              {/* not live: it changes all the time */}
              {measured && <span class={wordless ? 'spoken' : ''}>{measured}</span>}
            </span>
          </div>
          <div class="lab-stage">
            {/* biome-ignore lint/a11y: the picture has keys of its own; a point needs a pointer */}
            <div
              class={`lab-view${pointing.value ? ' lab-points' : ''}`}
              ref={host}
              onClick={point}
            />
            <div class="lab-over">
              {(eyes || pointing.value) && (
                <p class="lab-eyes" role="status">
                  {pointing.value ? w.lookHereHow : eyes && w.seesWith(named(eyes.name))}
                  {!pointing.value && (
                    <Button look="quiet" onClick={() => view.current?.seeWith('')}>
                      {w.ownView}
                    </Button>
                  )}
                </p>
              )}
              {undoable && (
                <p class="lab-eyes lab-undo" role="status">
                  {spoken(undoable)}
                  {may.scene && (
                    <Button look="quiet" onClick={() => void follower.undoing.undo(lab)}>
                      {words.value.room.undo}
                    </Button>
                  )}
                </p>
              )}
            </div>
            {trouble.value && (
              <p class="lab-note small" role="status">
                {trouble.value}
              </p>
            )}
            {phase === 'refused' && (
              <div class="lab-empty stack-8" role="alert">
                <p>{reason}</p>
                <Button look="primary" onClick={() => location.reload()}>
                  {words.value.crashed.reload}
                </Button>
              </div>
            )}
            {!lost && follower.known.value && robots.length === 0 && (
              <div class="lab-empty stack-8">
                {may.scene ? (
                  <>
                    <p>{w.empty}</p>
                    <Button look="primary" icon="robot" onClick={toggle(adding)}>
                      {w.addRobot}
                    </Button>
                  </>
                ) : (
                  <p>{w.emptyForOthers}</p>
                )}
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
          </div>
          {keys.value && <Topics follower={follower} onClose={toggle(keys)} />}
        </section>
        {!projected.value && (
          <aside class="lab-panel" aria-label={w.panel}>
            {!may.commands && session.value?.user && (
              <p class="lab-only-watch small">
                {replays
                  ? w.replaying(follower.recorder.value?.bag.split('/').at(-1) ?? '')
                  : w.onlyWatch(words.value.roles[session.value.user.role])}
              </p>
            )}
            {lost && follower.known.value && (
              <p class="lab-last-known small" role="status">
                {w.lastKnown}
              </p>
            )}
            {follower.outages.value.map((each) => (
              <p key={each.process.name} class="lab-outage small" role="status">
                {outageWords(each, w.outages)}
              </p>
            ))}
            {/* what is disabled here disables all controls in it */}
            <fieldset class="lab-cards" disabled={lost}>
              {follower.systems.value.map((each) => (
                <SystemCard key={each.system.name} view={each} />
              ))}
              {robots.map((each) => (
                <RobotCard
                  key={each.robot.name}
                  view={each}
                  catalogue={catalogue}
                  system={follower.systems.value.find(
                    ({ system }) => system.name === each.playback?.system,
                  )}
                  idle={moving.length === 0}
                />
              ))}
              {may.scene && robots.length > 0 && (
                <Button icon="robot" onClick={toggle(adding)}>
                  {w.addRobot}
                </Button>
              )}
              <PeopleCard
                place={follower.place.value}
                present={present.value}
                seen={seen.value}
                onSee={(id) => {
                  view.current?.seeWith(id)
                  // On a narrow page the picture is above the cards.
                  if (id !== '') host.current?.scrollIntoView({ block: 'nearest' })
                }}
              />
              <ReplayCard follower={follower} />
            </fieldset>
          </aside>
        )}
        {adding.value && (
          <AddRobot
            onClose={() => {
              adding.value = false
            }}
          />
        )}
        {joining.value && (
          <Join
            onClose={() => {
              joining.value = false
            }}
          />
        )}
      </div>
    </LabProvider>
  )
}

/** The lab that this gateway serves, or in `--mode fake` a made-up one. */
export function LabPage() {
  const link = useLink()
  return link.value && <Lab link={link.value} />
}
