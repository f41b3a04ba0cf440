import { mayAdmit, session } from '../../shell/session'
import { words } from '../../words/words'
import { Devices } from './devices'
import { PeopleList } from './people_list'
import './people.css'

/** The people of the lab, and their devices. */
export function PeoplePage() {
  const current = session.value
  return (
    <div class="people stack">
      <h1>{mayAdmit(current) ? words.value.people.title : words.value.people.devices}</h1>
      {mayAdmit(current) && <PeopleList />}
      <Devices />
    </div>
  )
}
