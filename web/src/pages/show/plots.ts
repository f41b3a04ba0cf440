const SVG = 'http://www.w3.org/2000/svg'

/** Give each plot of the page a line that stands at the time shown; a click or a drag seeks.
 * Return what moves the lines to a time, s. */
export function attachCursors(
  duration: number,
  seek: (time: number) => void,
): (time: number) => void {
  const lines: { line: SVGLineElement; left: number; width: number }[] = []
  for (const plot of document.querySelectorAll<SVGSVGElement>('svg[data-left]')) {
    const left = Number(plot.dataset.left)
    const width = Number(plot.dataset.width)
    const line = document.createElementNS(SVG, 'line')
    line.setAttribute('class', 'cursor')
    line.setAttribute('y1', '0')
    line.setAttribute('y2', String(plot.viewBox.baseVal.height))
    plot.append(line)
    lines.push({ line, left, width })
    const at = (event: PointerEvent) => {
      const box = plot.getBoundingClientRect()
      const x = ((event.clientX - box.left) / box.width) * plot.viewBox.baseVal.width
      seek(Math.min(Math.max((x - left) / width, 0), 1) * duration)
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
    for (const { line, left, width } of lines) {
      const x = left + (duration > 0 ? time / duration : 0) * width
      line.setAttribute('x1', String(x))
      line.setAttribute('x2', String(x))
    }
  }
}
