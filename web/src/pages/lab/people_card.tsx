import { useState } from 'preact/hooks'
import { Button } from '../../design/button'
import { order } from '../../lab/commands'
import { PART_ICONS } from '../../lab/people/parts'
import type { Present } from '../../lab/people/people'
import { type Place, setPlaceType } from '../../protocol/mrlab_msgs'
import { named, words } from '../../words/words'
import { useLab } from './context'

interface PeopleCardProps {
  readonly place: Place | null
  readonly present: readonly Present[]
  /** The display that the picture is seen with; empty: none. */
  readonly seen: string
  readonly onSee: (id: string) => void
}

/** The place in which the robots stand, and who is in it with a headset. */
export function PeopleCard({ place, present, seen, onSee }: PeopleCardProps) {
  const lab = useLab()
  const [name, setName] = useState<string | null>(null)
  const w = words.value.lab
  const save = async (event: Event, id: string) => {
    event.preventDefault()
    const request = { id, name: (name ?? '').trim() }
    if ((await order(lab, 'lab/set_place', setPlaceType, request)) !== null) setName(null)
  }
  if (present.length === 0 && !place?.name && !lab.may.scene) return null
  return (
    <article class="lab-card lab-people" aria-label={w.inRoom}>
      <header class="lab-card-head">
        <h2>
          {w.inRoom}
          {place?.name && <span class="second"> · {place.name}</span>}
        </h2>
        {lab.may.scene && place !== null && name === null && (
          <Button look="quiet" onClick={() => setName(place.name)}>
            {w.namePlace}
          </Button>
        )}
      </header>
      {name !== null && place !== null && (
        <form class="stack-8" onSubmit={(event) => void save(event, place.id)}>
          <input
            class="input"
            aria-label={w.placeName}
            value={name}
            maxLength={64}
            required
            onInput={(event) => setName(event.currentTarget.value)}
          />
          <div class="row">
            <Button look="primary" type="submit" disabled={name.trim() === ''}>
              {w.namePlace}
            </Button>
            <Button disabled={name.trim() === ''} onClick={(event) => void save(event, '')}>
              {w.newPlace}
            </Button>
            <Button look="quiet" onClick={() => setName(null)}>
              {words.value.cancel}
            </Button>
          </div>
        </form>
      )}
      {present.length === 0 && <p class="second small">{words.value.room.alone}</p>}
      <ul class="lab-people-list">
        {present.map(({ id, name: who, part, aligned }) => (
          <li key={id}>
            <span class="grow">
              {PART_ICONS[part]} {named(who)}
              <span class="second tiny">
                {' '}
                {words.value.room.parts[part]}
                {!aligned && ` · ${words.value.room.notAligned}`}
              </span>
            </span>
            <Button
              look="quiet"
              icon="eye"
              label={w.seeWith(named(who))}
              aria-pressed={id === seen}
              onClick={() => onSee(id === seen ? '' : id)}
            />
          </li>
        ))}
      </ul>
    </article>
  )
}
