// @vitest-environment jsdom
import { beforeEach, expect, test, vi } from 'vitest'
import { ApiError } from '../../../src/api/api'
import type { CheckFinding } from '../../../src/api/types'
import { UploadFlow } from '../../../src/pages/upload/flow'
import { own } from '../../../src/words/diagnostic'
import { FakeApi, FOUND_CHECK, JOINT_LIMIT } from '../../fake_api'

const UNWRAP = JOINT_LIMIT.fixes[0] as (typeof JOINT_LIMIT.fixes)[number]
let api: FakeApi
let flow: UploadFlow

beforeEach(async () => {
  localStorage.clear()
  api = new FakeApi()
  flow = new UploadFlow(api)
  await flow.loadLibrary()
})

function file(name: string): File {
  return new File(['x'], name)
}

test('a good file is sent, converted for the robot that is chosen, and its motion is there', async () => {
  await flow.choose(file('good.mat'))
  expect(api.requests).toMatchObject([{ robot_model: 'ur5e', end_effector: '' }])
  expect(flow.result.value?.conversion.outcome).toBe('accepted')
  expect(flow.result.value?.motion?.positions.shape).toEqual([801, 6])
  expect(flow.busy.value).toBe(false)
})

test('a fix is applied and the file converted again without being sent again; undo takes it back', async () => {
  await flow.choose(file('bad.mat'))
  const refused = flow.result.value
  expect(refused?.conversion.outcome).toBe('rejected')
  await flow.apply(UNWRAP)
  expect(api.requests.at(-1)).toMatchObject({ unwrap: true })
  expect(new Set(api.requests.map((request) => request.upload)).size).toBe(1)
  expect(flow.result.value?.conversion.outcome).toBe('accepted')
  flow.undo()
  expect(flow.result.value).toBe(refused)
  expect(flow.options.value).toEqual({})
  expect(flow.canUndo.value).toBe(false)
})

test('what the robot touches joins the findings of the motion that is shown', async () => {
  const touch = FOUND_CHECK.findings[0] as CheckFinding
  api.touched = [{ ...touch, first_row: 215, last_row: 240 }]
  await flow.choose(file('good.mat'))
  await vi.waitFor(() => expect(flow.touching.value).toBe(false))
  expect(flow.result.value?.conversion.diagnostics.at(-1)?.code).toBe('collision')
  expect(flow.result.value?.motion?.findings.at(-1)?.first_row).toBe(215)
  api.touched = []
  await flow.chooseRobot('kuka_kr6_r900_sixx')
  await vi.waitFor(() => expect(flow.result.value?.touched).toEqual([]))
  flow.undo()
  expect(flow.touching.value).toBe(false)
  expect(flow.result.value?.conversion.diagnostics.at(-1)?.code).toBe('collision')
})

test('of several matrices the chosen one is converted', async () => {
  await flow.choose(file('which.mat'))
  expect(flow.result.value?.conversion.candidates).toHaveLength(2)
  await flow.chooseVariable('log.q_soll')
  expect(api.requests.at(-1)?.variable).toBe('log.q_soll')
  expect(flow.result.value?.conversion.outcome).toBe('accepted')
})

test('another robot converts again with the same options, and is kept for the next time', async () => {
  await flow.choose(file('bad.mat'))
  await flow.apply(UNWRAP)
  await flow.chooseRobot('kuka_kr6_r900_sixx')
  expect(api.requests.at(-1)).toMatchObject({ robot_model: 'kuka_kr6_r900_sixx', unwrap: true })
  const next = new UploadFlow(api)
  await next.loadLibrary()
  expect(next.robot.value).toBe('kuka_kr6_r900_sixx')
})

test('a robot that the library lost is replaced by one that there is', async () => {
  localStorage.setItem('mrlab.robot', 'gone')
  const next = new UploadFlow(api)
  await next.loadLibrary()
  expect(next.robot.value).toBe('ur5e')
})

test('an error keeps file and choices, and the same can be tried again', async () => {
  const convert = api.convert.bind(api)
  api.convert = async () => {
    throw new ApiError(504, 'no_answer', own('The converter does not answer.'))
  }
  await flow.choose(file('good.mat'))
  expect(flow.error.value).toBe('The converter does not answer.')
  expect(flow.file.value?.name).toBe('good.mat')
  api.convert = convert
  await flow.run()
  expect(flow.error.value).toBe('')
  expect(flow.result.value?.conversion.outcome).toBe('accepted')
})

test('cancelling while the file is sent ends quietly with the file kept', async () => {
  api.upload = (_file, onProgress, signal) =>
    new Promise((_resolve, reject) => {
      onProgress(0.5)
      signal.addEventListener('abort', () => reject(new DOMException('', 'AbortError')))
    })
  const running = flow.choose(file('large.mat'))
  expect(flow.stage.value).toEqual({ kind: 'sending', share: 0.5 })
  flow.cancel()
  await running
  expect(flow.error.value).toBe('')
  expect(flow.busy.value).toBe(false)
  expect(flow.file.value?.name).toBe('large.mat')
})

test('a second file that is dropped while the first is sent wins', async () => {
  const upload = api.upload.bind(api)
  let reject: (reason: unknown) => void = () => {}
  api.upload = (sent, onProgress, signal) => {
    if (sent.name !== 'slow.mat') return upload(sent, onProgress, signal)
    return new Promise((_resolve, fail) => {
      reject = fail
      signal.addEventListener('abort', () => fail(new DOMException('', 'AbortError')))
    })
  }
  const slow = flow.choose(file('slow.mat'))
  await flow.choose(file('good.mat'))
  reject(new DOMException('', 'AbortError'))
  await slow
  expect(flow.result.value?.conversion.outcome).toBe('accepted')
  expect(flow.file.value?.name).toBe('good.mat')
})

test('publishing gives the draft its name', async () => {
  await flow.choose(file('good.mat'))
  await flow.publish('wave', true)
  expect(flow.published.value).toMatchObject({ id: 'ada/wave', shared: true })
})

test('a file that is faster than the list of robots waits for it', async () => {
  const asked: string[] = []
  const convert = api.convert.bind(api)
  api.convert = (request) => {
    asked.push(request.robot_model)
    return convert(request)
  }
  const eager = new UploadFlow(api)
  await eager.choose(new File(['x'], 'wave.mat'))
  expect(asked).toEqual(['ur5e'])
})

test('a motion of a program takes the place of what is shown, and its fixes convert it again', async () => {
  const accepted = await api.convert({ upload: 'sent', robot_model: 'ur5e', end_effector: '' })
  const live = (name: string) => ({
    live: name,
    upload: { upload: name, file_name: `${name}.mat`, size: 1, sha256: '' },
    options: { robot_model: 'ur5e', end_effector: '', id: '', frame_rate: 100, unwrap: false },
    conversion: accepted,
  })
  const shown = (name: string) =>
    vi.waitFor(() => expect(flow.file.value?.name).toBe(`${name}.mat`))
  api.show(live('before'))
  const left = new AbortController()
  const following = flow.follow(left.signal, false)
  await Promise.resolve()
  api.show(live('script_line_3'))
  await shown('script_line_3')
  expect(flow.options.value).toEqual({ frame_rate: 100 })
  expect(flow.result.value?.motion?.robot.model).toBe('ur5e')
  api.show(live('script_line_4'))
  await shown('script_line_4')
  await flow.apply(UNWRAP)
  expect(api.requests.at(-1)).toMatchObject({ upload: 'script_line_4', unwrap: true })
  left.abort()
  await following
})
