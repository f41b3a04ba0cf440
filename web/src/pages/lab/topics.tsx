import { useEffect, useState } from 'preact/hooks'
import { Button } from '../../design/button'
import { showToast } from '../../design/toast'
import type { LabFollower } from '../../lab/follower'
import { fixed, words } from '../../words/words'
import { TopicMessage } from './topic_message'

const EVERY_MS = 1000
/** Rows that are shown without a search: of a large lab all would hold a press for long. */
const MOST = 60

interface Row {
  readonly key: string
  readonly type: string
  /** Hz, NaN: not received here */
  readonly rate: number
  /** s, NaN: not received here */
  readonly age: number
}

function copy(key: string): void {
  const line = `ros2 topic echo /${key}`
  navigator.clipboard?.writeText(line).then(
    () => showToast(`${words.value.copied}: ${line}`),
    () => showToast(line),
  )
}

/** The topics of the lab with type, rate and age; one that is opened shows its newest message. */
export function Topics({ follower, onClose }: { follower: LabFollower; onClose: () => void }) {
  const [rows, setRows] = useState<readonly Row[]>([])
  const [text, setText] = useState('')
  const [open, setOpen] = useState('')
  const w = words.value.lab
  useEffect(() => {
    let before = new Map<string, number>()
    let then = performance.now()
    const look = () => {
      const now = performance.now()
      const since = (now - then) / 1000
      const counts = new Map<string, number>()
      const offered = follower.link.offer.topics
      const keys = new Set([...Object.keys(offered), ...follower.activity.keys()])
      const found: Row[] = []
      for (const key of [...keys].sort()) {
        const seen = follower.activity.get(key)
        if (seen) counts.set(key, seen.count)
        found.push({
          key,
          type: seen?.type ?? offered[key] ?? '',
          rate: seen ? (seen.count - (before.get(key) ?? seen.count)) / since : Number.NaN,
          age: seen ? Math.max(follower.link.labTime() - seen.newest, 0) : Number.NaN,
        })
      }
      before = counts
      then = now
      setRows(found)
    }
    look()
    const timer = setInterval(look, EVERY_MS)
    return () => clearInterval(timer)
  }, [follower])
  const wanted = text.trim().toLowerCase()
  const shown = rows.filter(({ key, type }) => `${key} ${type}`.toLowerCase().includes(wanted))
  return (
    <section class="lab-topics" aria-label={w.keys}>
      <div class="lab-topics-head">
        <input
          class="input"
          type="search"
          aria-label={w.searchTopics}
          placeholder={w.searchTopics}
          value={text}
          onInput={(event) => setText(event.currentTarget.value)}
        />
        <Button look="quiet" icon="close" label={words.value.close} onClick={onClose} />
      </div>
      <ul>
        {shown.slice(0, MOST).map(({ key, type, rate, age }) => (
          <li key={key}>
            <div class="lab-topic">
              <button
                type="button"
                aria-expanded={open === key}
                onClick={() => setOpen(open === key ? '' : key)}
              >
                <code>{key}</code>
                <span class="second tiny">{type.replace('/msg/', '/')}</span>
              </button>
              <span class="lab-number">
                {Number.isNaN(rate) ? '' : `${fixed(rate, rate < 10 ? 1 : 0)} Hz`}
              </span>
              <span class="lab-number second">
                {Number.isNaN(age) ? '' : `${fixed(age, 1)} s`}
              </span>
              <Button
                look="quiet"
                icon="copy"
                label={`${w.copyLine}: ${key}`}
                onClick={() => copy(key)}
              />
            </div>
            {open === key && <TopicMessage link={follower.link} topic={key} type={type} />}
          </li>
        ))}
      </ul>
      {shown.length > MOST && (
        <p class="lab-topics-more second tiny">{w.moreToFind(shown.length - MOST)}</p>
      )}
    </section>
  )
}
