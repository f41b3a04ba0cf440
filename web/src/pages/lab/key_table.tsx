import { useEffect, useState } from 'preact/hooks'
import { Button } from '../../design/button'
import { showToast } from '../../design/toast'
import type { LabFollower } from '../../lab/follower'
import { fixed, words } from '../../words/words'

const EVERY_MS = 1000

interface Row {
  readonly key: string
  readonly type: string
  /** Hz, NaN: not received here */
  readonly rate: number
  /** s, NaN: not received here */
  readonly age: number
}

/** The keys of the lab with type, rate and age, and the ros2 line that shows each. */
export function KeyTable({ follower }: { follower: LabFollower }) {
  const [rows, setRows] = useState<readonly Row[]>([])
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
  const copy = (key: string) => {
    const line = `ros2 topic echo /${key}`
    navigator.clipboard?.writeText(line).then(
      () => showToast(`${words.value.copied}: ${line}`),
      () => showToast(line),
    )
  }
  return (
    <div class="lab-keys">
      <table class="table">
        <thead>
          <tr>
            <th>{w.key}</th>
            <th>{w.type}</th>
            <th class="lab-number">{w.rate}</th>
            <th class="lab-number">{w.age}</th>
            <th />
          </tr>
        </thead>
        <tbody>
          {rows.map(({ key, type, rate, age }) => (
            <tr key={key}>
              <td>
                <code>{key}</code>
              </td>
              <td class="second small">{type.replace('/msg/', '/')}</td>
              <td class="lab-number">
                {Number.isNaN(rate) ? '' : `${fixed(rate, rate < 10 ? 1 : 0)} Hz`}
              </td>
              <td class="lab-number">{Number.isNaN(age) ? '' : `${fixed(age, 1)} s`}</td>
              <td>
                <Button look="quiet" icon="copy" label={w.copyLine} onClick={() => copy(key)} />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  )
}
