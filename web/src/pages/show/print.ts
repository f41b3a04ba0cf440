/** Most pictures of the scene on paper. */
const MOST_PICTURES = 6

/** Let paper show all of the page: what is folded is opened, and pictures of the scene at what was
 * done stand in its place. pictureAt: a data: URL, empty where nothing draws. */
export function printWhole(view: HTMLElement, pictureAt: (time: number) => string): void {
  const folded: HTMLDetailsElement[] = []
  const film = document.createElement('figure')
  film.className = 'poster film'
  addEventListener('beforeprint', () => {
    for (const each of document.querySelectorAll('details')) {
      if (each.open) continue
      each.open = true
      folded.push(each)
    }
    for (const time of instants()) {
      const source = pictureAt(time)
      if (source === '') break
      const picture = document.createElement('img')
      picture.src = source
      picture.alt = `${time.toFixed(2)} s`
      const caption = document.createElement('figcaption')
      caption.textContent = picture.alt
      const one = document.createElement('div')
      one.append(picture, caption)
      film.append(one)
    }
    if (film.childElementCount > 0) view.after(film)
  })
  addEventListener('afterprint', () => {
    for (const each of folded.splice(0)) each.open = false
    film.remove()
    film.replaceChildren()
  })
}

/** Return when something was done, s, some of them where there is much; else the beginning. */
function instants(): number[] {
  const done = [...document.querySelectorAll<HTMLElement>('.runs li [data-time]')]
  const times = [...new Set(done.map(({ dataset }) => Number(dataset.time)))]
  const step = Math.ceil(times.length / MOST_PICTURES)
  const some = times.filter((_, i) => i % step === 0)
  return some.length > 0 ? some : [0]
}
