import { useSignal } from '@preact/signals'
import { useEffect, useRef } from 'preact/hooks'
import { type Api, trajectoryUrl } from '../api/api'
import { useLink } from '../link/use_link'
import './room.css'
import type { Rights, Session } from '../api/types'
import { Button } from '../design/button'
import { Notice } from '../design/notice'
import { outageWords } from '../lab/outages'
import type { Link } from '../link/link'
import { courseOf } from '../playback/course'
import { checkSignIn, session, useApi } from '../shell/session'
import { language, named, words } from '../words/words'
import type { MakeTab } from './board/board'
import type { Person } from './board/people_tab'
import type { Entry } from './ports'
import type { Room } from './room'
import { type Ability, abilityOf } from './session/features'
import { type Hop, hopsOf, refusalOf } from './session/hops'

/** A tab that another part of the pages adds to the room's board, and the motions that it shows. */
export interface RoomExtra {
  /** Return where the frames of a motion are; null: it is a trajectory of the lab. */
  motionUrl(id: string): string | null
  /** Return the maker of the tab; null: the person has no right to it. */
  tab(api: Api, may: Rights): Promise<MakeTab | null>
}

/** s between two checks of the link. */
const PERIOD_S = 1

function picture(url: string | null): HTMLImageElement | null {
  if (url === null) return null
  const image = new Image()
  image.src = url
  return image
}

/** Return the text of a file of the lab; rejects if it cannot be had. */
async function textOf(url: string): Promise<string> {
  const answer = await fetch(url)
  if (!answer.ok) throw new Error(`${url}: ${answer.status}`)
  return answer.text()
}

/** Return whether a hop is only a note, which covers nothing of the room. */
function isAside({ id, severity }: Hop): boolean {
  return id === 'headset' && severity === 'info'
}

/** Return the person who is signed in, with their part in the room. */
function personOf(current: Session | null): Person {
  const role = current?.user?.role
  const part = role === 'instructor' ? 2 : role === 'operator' ? 1 : 0
  return { name: current?.user?.name ?? '', part }
}

/** The lab in a person's room; without a headset, seen from the desktop. link: opened and closed
 * by the caller. */
function RoomView({ link, extra }: { link: Link; extra: RoomExtra }) {
  const api = useApi()
  const host = useRef<HTMLDivElement>(null)
  const room = useSignal<Room | null>(null)
  const ability = useSignal<Ability | null>(null)
  const entering = useSignal(false)
  const trouble = useSignal('')
  const openFor = useSignal(Number.NaN)
  const shown = language.value

  useEffect(() => {
    let here = true
    let made: Room | null = null
    const axes = words.value.room.axes
    const catalogue = api.robots().then(({ robots, end_effectors }) => ({
      robots: robots.map(
        ({ model, name, maker, joints, home, reach, urdf, thumbnail }): Entry => ({
          id: model,
          name,
          note: axes(joints.length),
          group: maker,
          body: { joints, home, reach, urdf: () => textOf(urdf) },
          picture: picture(thumbnail),
        }),
      ),
      endEffectors: end_effectors.map(
        ({ id, name, thumbnail }): Entry => ({
          id,
          name: named(id, name),
          note: '',
          group: '',
          body: null,
          picture: picture(thumbnail),
        }),
      ),
    }))
    const rights = session.value?.may
    const tab = rights === undefined ? null : extra.tab(api, rights)
    Promise.all([import('./room'), catalogue, tab])
      .then(([{ Room }, parts, tab]) => {
        if (!here || host.current === null) return
        made = new Room({
          container: host.current,
          link,
          words: words.value,
          ...parts,
          person: personOf(session.value),
          courseOf: async (id) =>
            courseOf(await api.motion(extra.motionUrl(id) ?? trajectoryUrl(id, 'motion'))),
          checks: api,
          commands: session.value?.may.commands ?? false,
          scene: session.value?.may.scene ?? false,
          tabs: tab === null ? [] : [tab],
        })
        room.value = made
        // For tests, and for the console.
        if (new URLSearchParams(location.search).has('inspect'))
          Object.assign(window, { room: made })
      })
      .catch((error: unknown) => {
        const noWebGL = error instanceof Error && error.name === 'NoWebGL'
        trouble.value = noWebGL ? words.value.lab.noWebGL : words.value.noAnswer
        if (!noWebGL) console.error(error)
      })
    abilityOf({ secure: isSecureContext, xr: navigator.xr }).then((found) => {
      ability.value = found
    })
    return () => {
      here = false
      room.value = null
      made?.dispose()
    }
  }, [link, shown, extra])

  useEffect(
    () =>
      link.onStatus(({ phase }) => {
        if (phase === 'refused') void checkSignIn(api)
      }),
    [link, api],
  )

  useEffect(() => {
    let since = Number.NaN
    const look = () => {
      const now = performance.now() / 1000
      if (link.status.phase !== 'open') since = Number.NaN
      else if (Number.isNaN(since)) since = now
      openFor.value = now - since
    }
    look()
    const timer = setInterval(look, PERIOD_S * 1000)
    return () => clearInterval(timer)
  }, [link])

  const w = words.value.room
  const { outages } = words.value.lab
  const found = room.value
  const hops = hopsOf(
    {
      ability: ability.value,
      link: found?.follower.status.value ?? link.status,
      openFor: openFor.value,
      known: found?.follower.known.value ?? false,
      outages: found?.follower.outages.value.map((each) => outageWords(each, outages)) ?? [],
      robots: found?.follower.robots.value.length ?? 0,
      troubles: found?.troubles.value ?? [],
    },
    w,
  )
  const mode = ability.value?.mode ?? null
  const enter = () => {
    if (found === null || mode === null) return
    entering.value = true
    trouble.value = ''
    found
      .enter(mode)
      .catch((error: unknown) => {
        trouble.value = refusalOf(error, w)
      })
      .finally(() => {
        entering.value = false
      })
  }
  const inside = found?.inside.value ?? false
  return (
    <section class="room" aria-label={w.title}>
      <div class="room-view" ref={host} />
      <div class="room-bar">
        {mode !== null && !inside && (
          <Button look="primary" icon="headset" disabled={found === null} onClick={enter}>
            {entering.value ? w.entering : mode === 'immersive-ar' ? w.enter : w.enterVr}
          </Button>
        )}
        {inside && <p class="room-line small">{w.inside}</p>}
        {hops.filter(isAside).map(({ id, words: text }) => (
          <p key={id} class="room-line small" data-hop={id}>
            {text}
          </p>
        ))}
      </div>
      <div class="room-hops">
        {trouble.value && (
          <Notice severity="error">
            <p>{trouble.value}</p>
          </Notice>
        )}
        {hops
          .filter((hop) => !isAside(hop))
          .map(({ id, severity, words: text }) => (
            <Notice key={id} severity={severity}>
              <p data-hop={id}>{text}</p>
            </Notice>
          ))}
      </div>
    </section>
  )
}

/** The room, or in `--mode fake` one with made-up robots. */
export function RoomPage({ extra }: { extra: RoomExtra }) {
  const link = useLink()
  return link.value && <RoomView link={link.value} extra={extra} />
}
