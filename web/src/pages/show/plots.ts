const SVG = 'http://www.w3.org/2000/svg'

interface Cursor {
  readonly line: SVGLineElement
  readonly left: number
  readonly width: number
  readonly begin: number
  readonly duration: number
}

/** Give each plot of the page a line that stands at the time shown; a click or a drag seeks.
 * A plot may begin later than the page and be shorter: it has no line at other times.
 * Return what moves the lines to a time, s. */
export function attachCursors(
  duration: number,
  seek: (time: number) => void,
): (time: number) => void {
  const cursors: Cursor[] = []
  for (const plot of document.querySelectorAll<SVGSVGElement>('svg[data-left]')) {
    const left = Number(plot.dataset.left)
    const width = Number(plot.dataset.width)
    const begin = Number(plot.dataset.begin ?? 0)
    const length = Number(plot.dataset.duration ?? duration)
    const line = document.createElementNS(SVG, 'line')
    line.setAttribute('class', 'cursor')
    line.setAttribute('y1', '0')
    line.setAttribute('y2', String(plot.viewBox.baseVal.height))
    plot.append(line)
    cursors.push({ line, left, width, begin, duration: length })
    const at = (event: PointerEvent) => {
      const box = plot.getBoundingClientRect()
      const x = ((event.clientX - box.left) / box.width) * plot.viewBox.baseVal.width
      seek(begin + Math.min(Math.max((x - left) / width, 0), 1) * length)
    }
    plot.addEventListener('pointerdown', (event) => {
      plot.setPointerCapture(event.pointerId)
      at(event)
    })
    plot.addEventListener('pointermove', (event) => {
      if (event.buttons > 0) at(event)
    })
  }
  return (time) => {
    for (const cursor of cursors) {
      const share = cursor.duration > 0 ? (time - cursor.begin) / cursor.duration : 0
      const x = String(cursor.left + share * cursor.width)
      cursor.line.setAttribute('x1', x)
      cursor.line.setAttribute('x2', x)
      cursor.line.setAttribute('visibility', share >= 0 && share <= 1 ? 'visible' : 'hidden')
    }
  }
}
