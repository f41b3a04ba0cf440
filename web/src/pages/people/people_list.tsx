import { useEffect, useState } from 'preact/hooks'
import type { Fate, InvitationLink, Person, Role } from '../../api/types'
import { Button } from '../../design/button'
import { Dialog } from '../../design/dialog'
import { Field, Select } from '../../design/field'
import { Menu } from '../../design/menu'
import { Notice } from '../../design/notice'
import { showToast } from '../../design/toast'
import { session, useApi } from '../../shell/session'
import { sentence } from '../../words/diagnostic'
import { number, words } from '../../words/words'
import { rolesUpTo } from '../account/approve'
import { LinkWithCode } from '../motion/lazy'

const DAY_S = 86_400

function LinkDialog({ link, onClose }: { link: InvitationLink; onClose: () => void }) {
  const w = words.value.people
  return (
    <Dialog title={w.linkFor(link.name)} onClose={onClose}>
      <div class="stack">
        <p>{w.linkExplanation(number(link.expires_in / DAY_S, 0))}</p>
        <LinkWithCode path={new URL(link.url).pathname} origin={new URL(link.url).origin} />
      </div>
    </Dialog>
  )
}

function AddDialog(props: { onClose: () => void; onAdded: (link: InvitationLink) => void }) {
  const api = useApi()
  const [name, setName] = useState('')
  const [role, setRole] = useState<Role>('student')
  const [error, setError] = useState('')
  const w = words.value.people
  const own = session.value?.user?.role ?? 'student'
  const add = async (event: Event) => {
    event.preventDefault()
    setError('')
    try {
      props.onAdded(await api.invite({ name: name.trim(), role }))
    } catch (problem) {
      setError(sentence(problem))
    }
  }
  return (
    <Dialog title={w.add} onClose={props.onClose}>
      <form class="stack" onSubmit={(event) => void add(event)}>
        <Field label={w.name} value={name} onInput={setName} error={error} autocomplete="off" />
        <Select
          label={w.role}
          value={role}
          onChange={(value) => setRole(value as Role)}
          options={rolesUpTo(own).map((each) => [each, words.value.roles[each]] as const)}
        />
        <p class="second small">{w.roleNotes[role]}</p>
        <div class="dialog-actions">
          <Button onClick={props.onClose}>{words.value.cancel}</Button>
          <Button look="primary" type="submit" disabled={name.trim() === ''}>
            {w.makeLink}
          </Button>
        </div>
      </form>
    </Dialog>
  )
}

interface RemoveProps {
  name: string
  others: readonly string[]
  onClose: () => void
  onRemove: (fate: Fate) => void
}

function RemoveDialog({ name, others, onClose, onRemove }: RemoveProps) {
  const [data, setData] = useState<Fate['data']>('keep')
  const [to, setTo] = useState(others[0] ?? '')
  const w = words.value.people
  const fates = (['keep', 'hand_over', 'erase'] as const).filter(
    (each) => each !== 'hand_over' || others.length > 0,
  )
  return (
    <Dialog title={w.removeTitle(name)} onClose={onClose}>
      <div class="stack">
        <p>{w.removeExplanation}</p>
        <Select
          label={w.fate}
          value={data}
          onChange={(value) => setData(value as Fate['data'])}
          options={fates.map((each) => [each, w.fates[each]] as const)}
        />
        {data === 'hand_over' && (
          <Select
            label={w.heir}
            value={to}
            onChange={setTo}
            options={others.map((each) => [each, each] as const)}
          />
        )}
        <div class="dialog-actions">
          <Button onClick={onClose}>{words.value.cancel}</Button>
          <Button
            look="danger"
            icon="trash"
            onClick={() => onRemove(data === 'hand_over' ? { data, to } : { data })}
          >
            {w.remove}
          </Button>
        </div>
      </div>
    </Dialog>
  )
}

type Shown =
  | { readonly kind: 'add' }
  | { readonly kind: 'link'; readonly link: InvitationLink }
  | { readonly kind: 'remove'; readonly name: string }

/** The people of the lab; a new person joins by a link that works once. */
export function PeopleList() {
  const api = useApi()
  const [people, setPeople] = useState<readonly Person[] | null>(null)
  const [error, setError] = useState('')
  const [shown, setShown] = useState<Shown | null>(null)
  const w = words.value.people
  const load = () => {
    api
      .people()
      .then(setPeople)
      .catch((problem: unknown) => setError(sentence(problem)))
  }
  useEffect(load, [api])
  const showLink = (link: InvitationLink) => {
    setShown({ kind: 'link', link })
    load()
  }
  const remove = async (name: string, fate: Fate) => {
    setShown(null)
    try {
      await api.removePerson(name, fate)
      showToast(w.removed(name))
    } catch (problem) {
      showToast(sentence(problem))
    }
    load()
  }
  const inviteAgain = async (name: string) => {
    try {
      showLink(await api.inviteAgain(name))
    } catch (problem) {
      showToast(sentence(problem))
    }
  }
  const close = () => setShown(null)
  const local = session.value?.ways.password === false
  return (
    <section class="card stack" aria-labelledby="people">
      <div class="row">
        <h2 id="people" class="grow">
          {w.list}
        </h2>
        {!local && (
          <Button look="primary" icon="person" onClick={() => setShown({ kind: 'add' })}>
            {w.add}
          </Button>
        )}
      </div>
      {error && (
        <Notice severity="error">
          <p>{error}</p>
        </Notice>
      )}
      {local && (
        <Notice severity="info">
          <p>{w.local}</p>
        </Notice>
      )}
      {people !== null && people.length > 0 && (
        <table class="table">
          <thead>
            <tr>
              <th>{w.name}</th>
              <th>{w.role}</th>
              <th class="people-state">{w.state}</th>
              <th>
                <span class="spoken">{w.actions}</span>
              </th>
            </tr>
          </thead>
          <tbody>
            {people.map((person) => (
              <tr key={person.name}>
                <td>
                  <strong>{person.name}</strong>
                </td>
                <td>{words.value.roles[person.role]}</td>
                <td class="people-state second small">
                  {person.signs_in === '' ? w.invited : w.member}
                </td>
                <td class="people-menu">
                  <Menu label={w.actionsFor(person.name)} icon="more" look="quiet">
                    <Button look="quiet" icon="link" onClick={() => void inviteAgain(person.name)}>
                      {w.newLink}
                    </Button>
                    {person.name !== session.value?.user?.name && (
                      <Button
                        look="quiet"
                        icon="trash"
                        onClick={() => setShown({ kind: 'remove', name: person.name })}
                      >
                        {w.remove}
                      </Button>
                    )}
                  </Menu>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {shown?.kind === 'add' && <AddDialog onClose={close} onAdded={showLink} />}
      {shown?.kind === 'link' && (
        <LinkDialog key={shown.link.url} link={shown.link} onClose={close} />
      )}
      {shown?.kind === 'remove' && (
        <RemoveDialog
          name={shown.name}
          others={(people ?? []).map(({ name }) => name).filter((name) => name !== shown.name)}
          onClose={close}
          onRemove={(fate) => void remove(shown.name, fate)}
        />
      )}
    </section>
  )
}
