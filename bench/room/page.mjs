import { existsSync, readdirSync, readFileSync } from 'node:fs'
import { createRequire } from 'node:module'
import { join } from 'node:path'
import { gzipSync } from 'node:zlib'
import { ROOT } from './lab.mjs'

const TEST = join(ROOT, 'test')
const IWER = join(ROOT, 'web', 'node_modules', 'iwer', 'build', 'iwer.min.js')
const LIBRARIES = join(ROOT, '.venv', 'lib')
const DRIVER = 'site-packages/playwright/driver/package/index.js'
const BROWSERS = ['/usr/bin/chromium', '/usr/bin/chromium-browser', '/usr/bin/google-chrome']

/** Return the Playwright that came with the tests' requirements. */
function playwright() {
  const found = readdirSync(LIBRARIES)
    .map((python) => join(LIBRARIES, python, DRIVER))
    .find((path) => existsSync(path))
  if (found === undefined) {
    throw new Error('no Playwright in .venv; make test installs it')
  }
  return createRequire(import.meta.url)(found)
}

/** Times each frame callback of the session, and gathers what the room says of its frames. */
function watch() {
  window.samples = { js: [], callback: [], listener: null }
  const request = XRSession.prototype.requestAnimationFrame
  XRSession.prototype.requestAnimationFrame = function (callback) {
    return request.call(this, (time, frame) => {
      const began = performance.now()
      const calls = window.blindCalls
      callback(time, frame)
      const { samples } = window
      samples.callback.push(performance.now() - began)
      samples.glCalls = window.blindCalls - calls
      if (window.room) samples.js.push(window.room.frameMs)
      samples.listener?.(began)
    })
  }
}

/** Open the room, tap Enter, and wait until the first robot is drawn inside. */
export async function openRoom(url, signIn) {
  const { chromium } = playwright()
  const executablePath = BROWSERS.find((path) => existsSync(path))
  const args = ['--no-sandbox', '--disable-gpu', '--enable-precise-memory-info']
  const browser = await chromium.launch({ executablePath, args })
  const context = await browser.newContext({ viewport: { width: 480, height: 360 }, locale: 'en-GB' })
  for (const path of [join(TEST, 'no_webgl.js'), IWER, join(TEST, 'emulated_headset.js')]) {
    await context.addInitScript({ path })
  }
  await context.addInitScript(() => {
    window.headset.device.stereoEnabled = true
  })
  await context.addInitScript(watch)
  const page = await context.newPage()
  page.on('pageerror', (error) => console.error(`the page: ${error.message}`))
  await page.goto(signIn)
  const began = performance.now()
  await page.goto(`${url}/room?inspect`)
  await page.waitForFunction(() => window.room?.handles.size === 4, undefined, { timeout: 120_000 })
  const toLab = performance.now() - began
  const toRobot = await page.evaluate(async () => {
    const began = performance.now()
    const button = [...document.querySelectorAll('button')].find(({ textContent }) =>
      textContent.includes('Enter'),
    )
    button.click()
    const { room } = window
    for (;;) {
      await new Promise((resolve) => setTimeout(resolve, 5))
      const drawn = room.inside.value && window.samples.callback.length > 1
      if (drawn && room.scene.robot('ur5e_1')?.meshesHere === room.scene.robot('ur5e_1').meshCount)
        return performance.now() - began
    }
  })
  const client = await context.newCDPSession(page)
  return { page, client, close: () => browser.close(), toRobot, toLab }
}

/** Return the scripts and styles that the room has loaded, kB of gzip. */
export async function bytesOf(page, url) {
  const paths = await page.evaluate((url) => {
    const loaded = performance.getEntriesByType('resource').map(({ name }) => name)
    return loaded.filter((name) => name.startsWith(url) && /\.(js|css)$/.test(name))
  }, url)
  const files = new Set(paths.map((path) => new URL(path).pathname))
  let bytes = 0
  for (const file of files) bytes += gzipSync(readFileSync(join(ROOT, 'web', 'dist', file))).length
  return bytes / 1000
}
