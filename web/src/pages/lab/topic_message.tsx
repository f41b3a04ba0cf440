import { useEffect, useMemo, useState } from 'preact/hooks'
import { Button } from '../../design/button'
import { Sparkline } from '../../design/plot/sparkline'
import type { Link } from '../../link/link'
import type { MessageReader } from '../../protocol/message_type'
import { significant, words } from '../../words/words'

/** The pages' readers of messages by type, fetched when one is opened. */
async function readers(): Promise<ReadonlyMap<string, MessageReader<object>>> {
  const modules = await Promise.all([
    import('../../protocol/mrlab_msgs'),
    import('../../protocol/sensor_msgs'),
    import('../../protocol/std_msgs'),
    import('../../protocol/diagnostic_msgs'),
  ])
  const found = modules.flatMap((module): unknown[] => Object.values(module)).filter(isReader)
  return new Map(found.map((reader) => [reader.name, reader]))
}

function isReader(value: unknown): value is MessageReader<object> {
  return typeof value === 'object' && value !== null && 'decode' in value && 'name' in value
}

const EVERY_MS = 200
const MOST_SAMPLES = 300
const MOST_ITEMS = 64

/** A field of a message, such as position.2. */
function fieldOf(message: unknown, path: string): unknown {
  return path
    .split('.')
    .reduce((value, part) => (value as Record<string, unknown> | undefined)?.[part], message)
}

interface TreeProps {
  readonly name: string
  readonly value: unknown
  readonly path: string
  readonly plotted: readonly string[]
  readonly onPlot: (path: string) => void
}

/** A field with those below it; a number can be plotted. */
function Tree({ name, value, path, plotted, onPlot }: TreeProps) {
  if (typeof value === 'object' && value !== null) {
    const entries = Object.entries(ArrayBuffer.isView(value) ? Array.from(value as never) : value)
    const of = Array.isArray(value) || ArrayBuffer.isView(value) ? `[${entries.length}]` : ''
    return (
      <details open={entries.length <= 12}>
        <summary>
          <code>{name}</code> <span class="second tiny">{of}</span>
        </summary>
        {entries.slice(0, MOST_ITEMS).map(([key, inner]) => (
          <Tree
            key={key}
            name={key}
            value={inner}
            path={`${path}.${key}`}
            plotted={plotted}
            onPlot={onPlot}
          />
        ))}
      </details>
    )
  }
  if (typeof value !== 'number')
    return (
      <p class="lab-field">
        <code>{name}</code> <span>{String(value)}</span>
      </p>
    )
  return (
    <label class="lab-field">
      <input type="checkbox" checked={plotted.includes(path)} onChange={() => onPlot(path)} />
      <code>{name}</code> <span>{significant(value, 6)}</span>
    </label>
  )
}

interface TopicMessageProps {
  readonly link: Link
  readonly topic: string
  /** Such as sensor_msgs/msg/JointState. */
  readonly type: string
}

/** The newest message of a topic as a tree, and the fields that are chosen as live plots. */
export function TopicMessage({ link, topic, type }: TopicMessageProps) {
  const [message, setMessage] = useState<object | null>(null)
  const [unknown, setUnknown] = useState(false)
  const [paused, setPaused] = useState(false)
  const [plotted, setPlotted] = useState<readonly string[]>([])
  const lines = useMemo(() => new Map<string, number[]>(), [topic])
  const w = words.value.lab
  useEffect(() => {
    if (paused) return
    let here = true
    let stop = () => {}
    let last = Number.NEGATIVE_INFINITY
    void readers().then((known) => {
      const reader = known.get(type)
      if (!here) return
      setUnknown(reader === undefined)
      if (reader === undefined) return
      stop = link.subscribe(topic, reader, (newest) => {
        for (const [path, values] of lines) {
          values.push(Number(fieldOf({ message: newest }, path)))
          if (values.length > MOST_SAMPLES) values.shift()
        }
        if (performance.now() - last < EVERY_MS) return
        last = performance.now()
        // the message of a stream is reused by the next one
        setMessage(structuredClone(newest))
      })
    })
    return () => {
      here = false
      stop()
    }
  }, [link, topic, type, paused, lines])
  const plot = (path: string) => {
    if (lines.has(path)) lines.delete(path)
    else lines.set(path, [])
    setPlotted([...lines.keys()])
  }
  if (unknown) return <p class="second small lab-message">{w.unknownType(type)}</p>
  return (
    <div class="lab-message">
      <Button
        icon={paused ? 'play' : 'pause'}
        aria-pressed={paused}
        onClick={() => setPaused(!paused)}
      >
        {paused ? w.goOn : w.holdMessage}
      </Button>
      {plotted.map((path) => {
        const values = lines.get(path) ?? []
        const name = path.slice(path.indexOf('.') + 1)
        return (
          <figure key={path}>
            <figcaption class="tiny">
              <code>{name}</code> {values.length > 0 && significant(values.at(-1) ?? 0, 6)}
              <span class="second">
                {' '}
                {values.length > 0 &&
                  w.span(significant(Math.min(...values), 4), significant(Math.max(...values), 4))}
              </span>
            </figcaption>
            <Sparkline
              label={name}
              preview={{ variable: name, rows: values.map((_, i) => i), columns: 1, values }}
            />
          </figure>
        )
      })}
      {message === null ? (
        <p class="second small">{w.noMessage}</p>
      ) : (
        <Tree name={topic} value={message} path="message" plotted={plotted} onPlot={plot} />
      )}
    </div>
  )
}
