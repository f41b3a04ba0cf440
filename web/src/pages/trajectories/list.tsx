import type { TrajectoryInfo } from '../../api/types'
import { Button, ButtonLink } from '../../design/button'
import { Segments } from '../../design/field'
import { Icon } from '../../design/icons'
import { Notice } from '../../design/notice'
import { VirtualList } from '../../design/virtual_list'
import { navigate } from '../../shell/router'
import { dateTime, number, words } from '../../words/words'
import { type Catalogue, type Scope, shortName, trajectoryPage } from './catalogue'
import { TrajectoryMenu } from './menu'
import { Sketch } from './sketch'

const ROW_HEIGHT = 84

interface ListProps {
  catalogue: Catalogue
  user: string
}

export function ownerName(info: TrajectoryInfo, user: string): string {
  const w = words.value.trajectories
  if (info.owner === '') return w.theLab
  return info.owner === user ? w.you : info.owner
}

/** Return the people who may see it, in words. */
export function audience(info: TrajectoryInfo, user: string): string {
  const w = words.value.trajectories
  if (info.owner === '') return w.ofLab
  if (info.shared) return w.shared
  return info.owner === user ? w.private : w.privateOf(info.owner)
}

function Row({ catalogue, info, user }: ListProps & { info: TrajectoryInfo }) {
  const w = words.value.trajectories
  const robot = catalogue.robots.value.find(({ model }) => model === info.robot_model)
  return (
    <div class="trajectory">
      <label
        class="check trajectory-choose"
        title={catalogue.comparable(info) ? w.chooseToCompare : w.otherRobot}
      >
        <input
          type="checkbox"
          checked={catalogue.chosen.value.includes(info.id)}
          disabled={!catalogue.comparable(info)}
          onChange={() => catalogue.toggle(info.id)}
        />
        <span class="spoken">{w.compareWith(info.id)}</span>
      </label>
      <Sketch id={`${info.id}@${info.version}`} instead={robot?.thumbnail ?? null} />
      <a class="trajectory-link" href={trajectoryPage(info.id)}>
        <span class="trajectory-name">
          <strong>{shortName(info.id)}</strong>
          {info.version > 1 && <span class="second tiny">{w.version(info.version)}</span>}
        </span>
        <span class="trajectory-note second small">
          {robot?.name ?? info.robot_model}
          {info.end_effector && ` + ${info.end_effector}`} · {number(info.duration, 1)} s
          {info.warnings.length > 0 && ` · ${w.warnings(info.warnings.length)}`}
        </span>
        {/* on a phone, where the columns beside it have no room */}
        <span class="trajectory-whose second tiny">
          {info.shared ? ownerName(info, user) : audience(info, user)} · {dateTime(info.created)}
        </span>
      </a>
      <span class="trajectory-owner small">
        <Icon name={info.shared ? 'people' : 'person'} />
        <span>
          {ownerName(info, user)}
          <span class="second tiny trajectory-shared">{audience(info, user)}</span>
        </span>
      </span>
      <span class="trajectory-created second small">{dateTime(info.created)}</span>
      <TrajectoryMenu catalogue={catalogue} info={info} />
    </div>
  )
}

function CompareBar({ catalogue }: { catalogue: Catalogue }) {
  const w = words.value.trajectories
  const [first, second] = catalogue.chosen.value
  if (first === undefined) return null
  return (
    <div class="compare-bar" role="status">
      <Icon name="compare" />
      <span class="grow">
        {second === undefined
          ? w.chooseAnother(shortName(first))
          : w.and(shortName(first), shortName(second))}
      </span>
      {second !== undefined && (
        <Button look="primary" onClick={() => navigate(trajectoryPage(first, second))}>
          {w.compare}
        </Button>
      )}
      <Button
        look="quiet"
        icon="close"
        label={words.value.cancel}
        onClick={() => {
          catalogue.chosen.value = []
        }}
      />
    </div>
  )
}

export function TrajectoryList({ catalogue, user }: ListProps) {
  const w = words.value.trajectories
  const all = catalogue.all.value
  const shown = catalogue.found.value
  return (
    <section class="trajectories stack">
      <div class="row">
        <h1 class="grow">{w.title}</h1>
        <ButtonLink look="primary" href="/" icon="upload">
          {words.value.nav.upload}
        </ButtonLink>
      </div>
      {catalogue.error.value && (
        <Notice severity="error">
          <p>{catalogue.error.value}</p>
          <Button onClick={() => void catalogue.load()}>{words.value.retry}</Button>
        </Notice>
      )}
      <div class="row trajectory-filter">
        <label class="trajectory-search grow">
          <span class="spoken">{w.search}</span>
          <Icon name="search" />
          <input
            class="input"
            type="search"
            placeholder={w.search}
            value={catalogue.text.value}
            onInput={(event) => {
              catalogue.text.value = event.currentTarget.value
            }}
          />
        </label>
        <Segments<Scope>
          label={w.whose}
          value={catalogue.scope.value}
          onChange={(scope) => {
            catalogue.scope.value = scope
          }}
          options={[
            ['all', w.scopes.all],
            ['mine', w.scopes.mine],
            ['shared', w.scopes.shared],
          ]}
        />
      </div>
      {all !== null && all.length > 0 && (
        <p class="second small" role="status">
          {w.count(shown.length)}
        </p>
      )}
      {all === null && !catalogue.error.value && <p class="second">{words.value.loading}</p>}
      {all !== null && shown.length === 0 && (
        <div class="card empty stack">
          <Icon name="motion" />
          <p>{all.length === 0 ? w.empty : w.noneFound}</p>
          {all.length === 0 ? (
            <ButtonLink look="primary" href="/">
              {w.emptyAction}
            </ButtonLink>
          ) : (
            <Button
              onClick={() => {
                catalogue.text.value = ''
                catalogue.scope.value = 'all'
              }}
            >
              {w.showAll}
            </Button>
          )}
        </div>
      )}
      {shown.length > 0 && (
        <div class="card trajectory-card">
          <VirtualList
            items={shown}
            keyOf={(info) => info.id}
            rowHeight={ROW_HEIGHT}
            label={w.title}
            render={(info) => <Row catalogue={catalogue} info={info} user={user} />}
          />
        </div>
      )}
      <CompareBar catalogue={catalogue} />
    </section>
  )
}
